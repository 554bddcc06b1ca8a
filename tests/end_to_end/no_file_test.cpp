#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

using ::testing::StartsWith;

constexpr int kWrongInput = 2;

/// A command that reads a file: "@name" stands for a path in the test's folder, and what of it is
/// called "pipe" for one to which nobody writes, so that a program that opens it waits for ever.
using Command = std::vector<std::string>;

class PipeInPlaceOfAFile : public ::testing::TestWithParam<Command> {
 protected:
  PipeInPlaceOfAFile() {
    std::ofstream(folder_ + "/stereo.yml")
        << "image_width: 64\nimage_height: 48\nK1: [50, 0, 32, 0, 50, 24, 0, 0, 1]\n"
           "K2: [50, 0, 32, 0, 50, 24, 0, 0, 1]\nR: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
           "T: [-0.12, 0, 0]\n";
    std::ofstream(folder_ + "/a_gt.json") << R"({"utime": 1, "persons": []})";
  }
  std::string folder_ = temporary_folder("pipe");
};

TEST_P(PipeInPlaceOfAFile, EndsTheProgramAtOnceInOneLine) {
  std::vector<std::string> command = {program(GetParam().front())};
  std::string pipe;
  for (auto word = GetParam().begin() + 1; word != GetParam().end(); ++word) {
    command.push_back(word->front() == '@' ? folder_ + "/" + word->substr(1) : *word);
    if (word->rfind("@pipe", 0) == 0) pipe = command.back();
  }
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  const RunResult result = run(command);
  EXPECT_EQ(result.exit_code, kWrongInput) << result.output;
  EXPECT_THAT(result.output, StartsWith(GetParam().front() + ": " + pipe + ": is a pipe; give a "));
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, PipeInPlaceOfAFile,
    ::testing::Values(
        Command{"limbcast-stereo-camera", "--source", "@pipe", "--calibration", "@stereo.yml"},
        Command{"limbcast-stereo-camera", "--source", "@pipe.log", "--calibration", "@stereo.yml"},
        Command{"limbcast-stereo-camera", "--source", "@", "--calibration", "@pipe.yml"},
        Command{"limbcast-depth-camera", "--source", "@", "--calibration", "@pipe.yml"},
        Command{"limbcast-laser-scanner", "--source", "@pipe.pcd", "--log", "@in.log"},
        Command{"limbcast-laser-scanner", "--source", "@pipe.pcap", "--log", "@in.log"},
        Command{"limbcast-laser-scanner", "--source", "@pipe.log", "--log", "@in.log"},
        Command{"limbcast-replay", "@pipe.log", "@out.log"},
        Command{"limbcast-replay", "--config", "@pipe.conf", "@in.log", "@out.log"},
        Command{"limbcast-export-poses", "@pipe.log"}, Command{"limbcast-evaluate", "@pipe.log"},
        Command{"limbcast-evaluate", "--poses", "@pipe.jsonl", "--truth", "@"},
        Command{"limbcast-viewer", "@pipe.log"}, Command{"limbcast-log", "info", "@pipe.log"},
        Command{"limbcast-calibrate", "--source", "@pipe", "--output", "@c.yml"},
        Command{"limbcast-calibrate", "check", "--source", "@", "--calibration", "@pipe.yml"}));

}  // namespace
}  // namespace limbcast::test
