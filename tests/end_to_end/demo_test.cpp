#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

constexpr int kRefused = 2;

/// What modules/demo.sh says of arguments that it refuses, called from another folder.
class Demo : public ::testing::Test {
 protected:
  std::string refusal_of(const std::string& arguments, const std::string& settings = "") const {
    const RunResult result =
        run({"sh", "-c", "cd " + folder_ + " && " + settings + " " + demo_ + " " + arguments});
    EXPECT_EQ(result.exit_code, kRefused) << result.output;
    return result.output;
  }

  std::string demo_ = repository_file("modules/demo.sh");
  std::string folder_ = temporary_folder("demo");
};

TEST_F(Demo, RefusesWrongArguments) {
  const std::string usage = "; see " + demo_ + " --help\n";
  EXPECT_EQ(refusal_of("--fast"), "demo: --fast: there is no such option" + usage);
  EXPECT_EQ(refusal_of("a b c"), "demo: c: one argument too many" + usage);
}

TEST_F(Demo, RefusesARecordingThatItCannotPlayBeforeItBuilds) {
  const std::string recording = folder_ + "/recording";
  EXPECT_EQ(refusal_of("recording"), "demo: " + recording + ": no such folder or log\n");
  std::filesystem::create_directory(recording);
  EXPECT_EQ(refusal_of("recording"),
            "demo: " + recording +
                ": holds no *_left.* and *_right.* images, no *_color.* and *_depth.png images and "
                "no scans\n");
  // Depth cameras without colour give such folders.
  std::ofstream(recording + "/0_depth.png") << "a picture";
  EXPECT_EQ(refusal_of("recording"), "demo: " + recording +
                                         "/calibration.yml: no such calibration; give it as second "
                                         "argument\n");
  std::ofstream(folder_ + "/clouds.log") << "POINT_CLOUD";
  EXPECT_EQ(refusal_of("clouds.log"),
            "demo: " + folder_ +
                "/clouds.log: holds no images; a log of clouds goes through limbcast-replay\n");
}

TEST_F(Demo, ExplainsItself) {
  const RunResult result = run({demo_, "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.output.find("modules/demo.sh RECORDING"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("DEMO_OUTPUT"), std::string::npos) << result.output;
}

TEST_F(Demo, DeletesNothingThatNoDemoWrote) {
  const std::string mine = folder_ + "/mine";
  std::filesystem::create_directory(mine);
  std::ofstream(mine + "/letter.txt") << "keep";
  EXPECT_EQ(refusal_of("", "DEMO_OUTPUT=mine"),
            "demo: " + mine +
                ": holds what no demo wrote; set DEMO_OUTPUT to a folder that is empty or not "
                "there\n");
  EXPECT_TRUE(std::filesystem::exists(mine + "/letter.txt"));
}

}  // namespace
}  // namespace limbcast::test
