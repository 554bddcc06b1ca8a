#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::HasSubstr;

constexpr int kWrongUsage = 2;

class EveryProgram : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryProgram, ExplainsItselfWithHelp) {
  const RunResult result = run({program(GetParam()), "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("Usage: " + std::string(GetParam())));
  EXPECT_THAT(result.output, HasSubstr("--lcm-url"));
  EXPECT_THAT(result.output, HasSubstr("default"));
}

TEST_P(EveryProgram, TellsItsVersion) {
  const RunResult result = run({program(GetParam()), "--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr(std::string(GetParam()) + " 0.1.0"));
}

TEST_P(EveryProgram, RefusesAnUnknownOptionInOneLine) {
  const RunResult result = run({program(GetParam()), "--no-such-option=1"});
  EXPECT_EQ(result.exit_code, kWrongUsage);
  EXPECT_THAT(result.output, HasSubstr("no-such-option"));
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

TEST_P(EveryProgram, RefusesAMissingConfigurationFile) {
  const RunResult result = run({program(GetParam()), "--config", "/nowhere/robot.conf"});
  EXPECT_EQ(result.exit_code, kWrongUsage) << result.output;
}

TEST(Channels, ThatAModuleWouldReadAndWriteAreRefusedInOneLine) {
  const std::string in = temporary_folder("channels") + "/in.log", out = in + ".out";
  const auto refusal_of = [](const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program(name));
    arguments.insert(arguments.end(), {"--lcm-url", "none"});
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, kWrongUsage);
    return result.output;
  };
  EXPECT_EQ(refusal_of("limbcast-tracker",
                       {"--body-poses-channel", "POSES", "--tracked-poses-channel", "POSES"}),
            "limbcast-tracker: 'tracked-poses-channel' is 'POSES', as 'body-poses-channel' is, so "
            "that [tracker] would read what it writes; give one of them another name\n");
  EXPECT_THAT(refusal_of("limbcast-reconstructor", {"--point-cloud-channel", "STEREO_IMAGES"}),
              HasSubstr("'point-cloud-channel' is 'STEREO_IMAGES', as 'stereo-images-channel' is"));
  EXPECT_THAT(refusal_of("limbcast-segmenter", {"--segments-channel", "POINT_CLOUD"}),
              HasSubstr("'segments-channel' is 'POINT_CLOUD', as 'point-cloud-channel' is"));
  EXPECT_THAT(refusal_of("limbcast-pose-fitter", {"--segments-channel", "BODY_POSES"}),
              HasSubstr("'body-poses-channel' is 'BODY_POSES', as 'segments-channel' is"));
  EXPECT_THAT(refusal_of("limbcast-replay",
                         {in, out, "--tracker", "--tracker.tracked-poses-channel=BODY_POSES"}),
              HasSubstr("so that [tracker] would read what it writes"));
}

TEST(LcmUrl, IsRefusedInOneLineWhereItIsMalformed) {
  const RunResult result = run({program("limbcast-segmenter"), "--lcm-url", "udpm://239.1.2.3"});
  EXPECT_EQ(result.exit_code, kWrongUsage);
  EXPECT_EQ(result.output,
            "limbcast-segmenter: lcm-url 'udpm://239.1.2.3': has no port; write it like "
            "udpm://239.255.76.67:7667?ttl=1\n");
}

INSTANTIATE_TEST_SUITE_P(Programs, EveryProgram,
                         ::testing::Values("limbcast-stereo-camera", "limbcast-depth-camera",
                                           "limbcast-reconstructor", "limbcast-segmenter",
                                           "limbcast-pose-fitter", "limbcast-replay",
                                           "limbcast-export-poses", "limbcast-evaluate",
                                           "limbcast-viewer", "limbcast-doctor",
                                           "limbcast-laser-scanner", "limbcast-tracker",
                                           "limbcast-simulate", "limbcast-status"));

}  // namespace
}  // namespace limbcast::test
