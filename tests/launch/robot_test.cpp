#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "common/lcm_io/lcm_url.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::launch {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

std::string launch_file(const std::string& path) {
  return test::repository_file("modules/launch/" + path);
}

std::string text_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Values of `key = "value";` in a procman configuration.
std::vector<std::string> values_of(const std::string& text, const std::string& key) {
  const std::regex form(key + " = \"([^\"]*)\";");
  std::vector<std::string> values;
  for (std::sregex_iterator match(text.begin(), text.end(), form), end; match != end; ++match)
    values.push_back((*match)[1]);
  return values;
}

TEST(ProcmanRobot, StartsProgramsWithOptionsThatTheyUnderstand) {
  const auto commands = values_of(text_of(launch_file("robot/limbcast.pmd")), "exec");
  ASSERT_FALSE(commands.empty());
  for (const std::string& command : commands) {
    if (command.rfind("limbcast-", 0) != 0) continue;
    const auto result = test::run({"sh", "-c", test::program(command) + " --version"});
    EXPECT_EQ(result.exit_code, 0) << command << ": " << result.output;
  }
}

TEST(ProcmanRobot, HasTheThreeHostsOfTheExample) {
  const auto hosts = values_of(text_of(launch_file("robot/limbcast.pmd")), "host");
  EXPECT_THAT(std::set<std::string>(hosts.begin(), hosts.end()),
              UnorderedElementsAre("camera", "vision", "operator"));
}

std::string url_in(const std::string& settings) {
  const std::string text = text_of(launch_file(settings));
  std::smatch match;
  const std::regex form("\nLCM_DEFAULT_URL=\"(.*)\"\n");
  return std::regex_search(text, match, form) ? match[1].str() : "";
}

TEST(Settings, KeepMessagesOnTheHostUnlessTheExampleRobotSharesThem) {
  const auto shipped = lcm_io::parse_multicast_url(url_in("settings/lcm.conf"));
  ASSERT_TRUE(shipped);
  EXPECT_EQ(shipped->ttl, 0);
  EXPECT_GT(shipped->recv_buf_size, 0) << "lcm-logger asks for no more than the URL does";
  for (const char* host : {"camera", "vision", "operator"}) {
    const auto url =
        lcm_io::parse_multicast_url(url_in(std::string("robot/") + host + "/lcm.conf"));
    ASSERT_TRUE(url) << host;
    EXPECT_EQ(url->ttl, 1);
    EXPECT_GT(url->recv_buf_size, 0) << host;
  }
}

class ChainSettings : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(ChainSettings, IsUnderstoodByTheProgramThatReadsIt) {
  const auto& [name, file] = GetParam();
  // An unusable URL ends the program once it has read its settings.
  const auto result =
      test::run({test::program(name), "--config", launch_file(file), "--lcm-url", "nonsense://"});
  EXPECT_THAT(result.output, HasSubstr("lcm-url 'nonsense://'"));
}

TEST(SettingsFile, OfTheCameraIsUnderstoodUpToTheCalibrationThatItNames) {
  const auto result = test::run({test::program("limbcast-stereo-camera"), "--config",
                                 launch_file("robot/camera/front.conf")});
  EXPECT_THAT(result.output, HasSubstr("/etc/limbcast/front.yml"));
}

INSTANTIATE_TEST_SUITE_P(Robot, ChainSettings,
                         ::testing::ValuesIn(std::vector<std::pair<std::string, std::string>>{
                             {"limbcast-reconstructor", "robot/vision/robot.conf"},
                             {"limbcast-segmenter", "robot/vision/robot.conf"},
                             {"limbcast-pose-fitter", "robot/vision/robot.conf"},
                             {"limbcast-tracker", "robot/vision/robot.conf"},
                             {"limbcast-segmenter", "settings/robot.conf"}}));

}  // namespace
}  // namespace limbcast::launch
