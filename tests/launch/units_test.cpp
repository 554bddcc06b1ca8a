#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "tests/support/child_process.hpp"

namespace limbcast::launch {
namespace {

namespace fs = std::filesystem;
using test::run;
using ::testing::HasSubstr;
using ::testing::Not;

/// The largest exposure that `systemd-analyze security` may find, of 100.
constexpr const char* kLargestExposure = "25";

/// A root file system with limbcast and as much of systemd as its tools look at.
class Units : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = test::temporary_folder("units");
    for (const char* component : {"tools", "settings"}) {
      const auto installed =
          run({"env", "DESTDIR=" + root_.string(), LIMBCAST_CMAKE, "--install", LIMBCAST_BUILD_DIR,
               "--prefix", "/usr", "--component", component});
      ASSERT_EQ(installed.exit_code, 0) << installed.output;
    }
    for (const char* program : {"lcm-logger", "ip", "sh"}) {
      const auto copied =
          run({"sh", "-c", "cp -L \"$(command -v $0)\" $1", program, (root_ / "usr/bin").string()});
      ASSERT_EQ(copied.exit_code, 0) << copied.output;
    }
    fs::create_directories(root_ / "etc/systemd/system");
    run({"sh", "-c", "cp /lib/systemd/system/*.target /lib/systemd/system/*.slice $0",
         unit_folder().string()});
  }
  void SetUp() override {
    if (run({"systemd-analyze", "--version"}).exit_code != 0)
      GTEST_SKIP() << "systemd-analyze is missing: apt-get install systemd";
  }
  static fs::path unit_folder() { return root_ / "usr/lib/systemd/system"; }
  static std::vector<std::string> units() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(unit_folder()))
      if (entry.path().filename().string().rfind("limbcast", 0) == 0)
        names.push_back(entry.path().filename());
    return names;
  }
  static std::string text_of(const std::string& unit) {
    std::ifstream in(unit_folder() / unit);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string root_option() { return "--root=" + root_.string(); }

  static fs::path root_;
};

fs::path Units::root_;

TEST_F(Units, AreSoundForSystemd) {
  std::vector<std::string> command = {"systemd-analyze", "verify", "--man=no", root_option()};
  for (const std::string& unit : units()) command.push_back(unit);
  const auto result = run(command);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.output, "");
}

TEST_F(Units, ExposeLittleOfTheHost) {
  for (const std::string& unit : units()) {
    if (fs::path(unit).extension() != ".service") continue;
    const auto result = run({"systemd-analyze", "security", "--offline=true", root_option(),
                             std::string("--threshold=") + kLargestExposure, unit});
    EXPECT_EQ(result.exit_code, 0) << result.output;
  }
}

TEST_F(Units, AreEnabledForASensorAndStartedWithTheTarget) {
  const auto result = run({"systemctl", root_option(), "enable", "limbcast.target",
                           "limbcast-stereo-camera@front", "limbcast-segmenter"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const fs::path wants = root_ / "etc/systemd/system";
  for (const char* link : {"multi-user.target.wants/limbcast.target",
                           "limbcast.target.wants/limbcast-stereo-camera@front.service",
                           "limbcast.target.wants/limbcast-segmenter.service"})
    EXPECT_TRUE(fs::is_symlink(wants / link)) << link;
}

TEST_F(Units, AreStartedAgainWithinLimitsAndStopWithTheTarget) {
  for (const std::string& unit : units()) {
    if (fs::path(unit).extension() != ".service" || unit == "limbcast-route@.service") continue;
    for (const char* setting :
         {"\nPartOf=limbcast.target\n", "\nEnvironmentFile=/etc/limbcast/lcm.conf\n",
          "\nRestart=on-failure\n", "\nStartLimitIntervalSec=60\nStartLimitBurst=10\n",
          "\nMemoryMax=1G\n"})
      EXPECT_THAT(text_of(unit), HasSubstr(setting)) << unit;
  }
}

TEST_F(Units, ReadTheSettingsOfTheRobotOrOfTheirSensor) {
  EXPECT_THAT(text_of("limbcast-segmenter.service"),
              HasSubstr("\nExecStart=limbcast-segmenter --config /etc/limbcast/robot.conf\n"));
  EXPECT_THAT(text_of("limbcast-segmenter@.service"),
              HasSubstr("\nExecStart=limbcast-segmenter --config /etc/limbcast/%i.conf\n"));
  // A restart does not mend wrong settings.
  EXPECT_THAT(text_of("limbcast-segmenter.service"), HasSubstr("\nRestartPreventExitStatus=2\n"));
}

TEST_F(Units, TryACameraAgainUntilItIsThere) {
  constexpr int kTriesWithinLimit = 10, kLimit_s = 60;
  for (const char* unit : {"limbcast-stereo-camera.service", "limbcast-stereo-camera@.service",
                           "limbcast-depth-camera.service", "limbcast-depth-camera@.service"}) {
    const std::string text = text_of(unit);
    // An absent camera is wrong input.
    EXPECT_THAT(text, Not(HasSubstr("RestartPreventExitStatus"))) << unit;
    std::smatch delay_s;
    ASSERT_TRUE(std::regex_search(text, delay_s, std::regex("\nRestartSec=([0-9]+)\n"))) << unit;
    EXPECT_GT(kTriesWithinLimit * std::stoi(delay_s[1]), kLimit_s) << unit << " gives up";
  }
}

/// What the shell of limbcast-route@DEVICE.service runs.
std::string route_script(const std::string& unit, const std::string& device) {
  std::smatch match;
  if (!std::regex_search(unit, match, std::regex("\nExecStart=sh -c '([^']*)'\n"))) return "";
  const std::string shell = std::regex_replace(match[1].str(), std::regex(R"(\$\$)"), "$$");
  return std::regex_replace(shell, std::regex("%i"), device);
}

TEST_F(Units, SetTheRouteWheneverItsDeviceComesUp) {
  if (run({"unshare", "--net", "true"}).exit_code != 0) GTEST_SKIP() << "needs network namespaces";
  const std::string script = route_script(text_of("limbcast-route@.service"), "eth1");
  ASSERT_NE(script, "");
  // Where the unit sleeps, the device takes its next turn.
  const std::string turns = R"sh(
    sleep() {
      turn=$((turn + 1))
      echo "turn $turn: $(ip route show 224.0.0.0/4)"
      case $turn in
        1) ip link set eth1 up ;;
        2) ip link set eth1 down; ip link set eth1 up ;;
        3) exit 0 ;;
      esac
    }
    ip link add eth1 type veth peer name far
  )sh";
  const auto result = run({"unshare", "--net", "sh", "-c", turns + script});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, ::testing::MatchesRegex("turn 1: \n"
                                                     "turn 2: 224.0.0.0/4 dev eth1[^\n]*\n"
                                                     "turn 3: 224.0.0.0/4 dev eth1[^\n]*\n"));
}

}  // namespace
}  // namespace limbcast::launch
