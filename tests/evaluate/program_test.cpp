#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limbcast/body_poses_t.hpp>
#include <nlohmann/json.hpp>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "tests/common/run_program.hpp"
#include "tests/evaluate/figure.hpp"

namespace limbcast::evaluate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::shell_quoted;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Outcome evaluate_program(const std::vector<std::string>& arguments) {
  return run_program("limbcast-evaluate", arguments);
}

BodyPoses stamped(BodyPoses poses) {
  poses.stamp.sensor = "front";
  return poses;
}

/// A recording before limbcast-replay: its truth, but no poses.
void write_truth_log(const std::string& path) {
  lcm_io::LogWriter log(path);
  log.write(0, "GROUND_TRUTH", lcm_io::to_message(stamped(frame({pointing_figure()}, 0))));
  log.close();
}

/// Two frames, the second with a direction that is 30 degrees off.
void write_log(const std::string& path, bool with_truth) {
  lcm_io::LogWriter log(path);
  for (int i = 0; i < 2; ++i) {
    if (with_truth)
      log.write(i, "GROUND_TRUTH", lcm_io::to_message(stamped(frame({pointing_figure()}, i))));
    const float off_deg = i == 0 ? 0.0F : 30.0F;
    log.write(i, "BODY_POSES", lcm_io::to_message(stamped(frame({pointing_figure(off_deg)}, i))));
  }
  log.close();
}

nlohmann::json json_of(const std::string& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

TEST(EvaluateProgram, JudgesALogByTheTruthInIt) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  const Outcome outcome = evaluate_program({folder / "out.log", "--json", folder / "a.json",
                                            "--picture", folder / "a.png", "--worst", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("postures right [%]"));
  EXPECT_THAT(outcome.out, HasSubstr("direction off 30.00"));
  EXPECT_EQ(json_of(folder / "a.json")["figures"]["pointing_right_percent"]["value"], 50.0);
  EXPECT_GT(std::filesystem::file_size(folder / "a.png"), 1000U);
}

TEST(EvaluateProgram, TellsTheMainFiguresInOneLine) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  const Outcome outcome = evaluate_program({folder / "out.log", "--brief"});
  EXPECT_THAT(outcome.out,
              StartsWith("accuracy on 2 frames: postures right 50.0 %, wrong reported 50.0 %,"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST(EvaluateProgram, JudgesExportedPosesByAFolder) {
  const TemporaryFolder folder;
  folder.write("truth/a_gt.json", R"({"utime":5,"persons":[{"body":"D4_x","joints":{"head":[0,0,2]},
                                     "visible":{"head":true}}]})");
  folder.write(
      "poses.jsonl",
      R"({"utime":5,"persons":[{"id":1,"error":0,"joints":{"head":[0.03,0,2]},"pointing":null}]})");
  const Outcome outcome = evaluate_program({"--poses", folder / "poses.jsonl", "--truth",
                                            folder / "truth", "--json", folder / "a.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(json_of(folder / "a.json")["joints"]["head"]["mean_error_cm"]["value"].get<double>(),
              3.0, 1e-4);
}

TEST(EvaluateProgram, WarnsWherePosesAndTruthShareNoFrame) {
  const TemporaryFolder folder;
  folder.write("truth/a_gt.json", R"({"utime":5,"persons":[]})");
  folder.write("poses.jsonl", R"({"utime":6,"persons":[]})");
  const Outcome outcome =
      evaluate_program({"--poses", folder / "poses.jsonl", "--truth", folder / "truth"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("belong together"));
}

TEST(EvaluateProgram, SaysWhatIsWrongWithItsInput) {
  const TemporaryFolder folder;
  write_log(folder / "bare.log", false);
  write_truth_log(folder / "in.log");
  folder.write("empty.log", "");
  folder.write("foreign.log", "a text, no log");
  folder.write("poses.jsonl", "{}\n");
  folder.write("truth/a_gt.json", R"({"utime":5,"persons":[]})");
  const auto expect_usage_error = [](const std::vector<std::string>& arguments,
                                     const std::string& text) {
    const Outcome outcome = evaluate_program(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_THAT(outcome.err, StartsWith("limbcast-evaluate: "));
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect_usage_error({}, "give either a log or --poses");
  expect_usage_error({folder / "none.log"}, "no such file");
  expect_usage_error({folder / "empty.log"}, "is empty");
  expect_usage_error({folder / "foreign.log"}, "is no LCM log");
  expect_usage_error({folder / "bare.log"}, "carries no truth");
  expect_usage_error({folder / "in.log"},
                     "holds no poses on BODY_POSES but on GROUND_TRUTH; choose such a channel, or "
                     "limbcast-replay adds them (tracked ones with --tracker)");
  expect_usage_error({folder / "in.log", "--truth", folder / "truth"}, "limbcast-replay adds them");
  expect_usage_error({folder / "bare.log", "--bodies", "D4"}, "--bodies needs --truth");
  expect_usage_error({"--poses", folder / "poses.jsonl"}, "--poses needs --truth");
  expect_usage_error({"--poses", folder / "poses.jsonl", "--truth", folder / "truth"},
                     "line 1: 'utime' is missing");
  expect_usage_error({folder / "bare.log", "--truth", folder / "none"}, "cannot be read");
  expect_usage_error({folder / "bare.log", "--frobnicate", "1"}, "frobnicate");
}

TEST(EvaluateProgram, RefusesFilesThatItCannotWriteBeforeItReadsAnything) {
  const auto refusal_of = [](const std::string& option, const std::string& path) {
    const Outcome outcome = evaluate_program({"/none.log", option, path});
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(refusal_of("--json", "/none/a.json"), HasSubstr("no folder /none; make it"));
  EXPECT_THAT(refusal_of("--picture", "/none/a.png"), HasSubstr("no folder /none; make it"));
  EXPECT_THAT(evaluate_program({"/none.log", "--json", "a.png", "--picture", "a.png"}).err,
              HasSubstr("a.png: is what --json writes; choose another --picture"));
  EXPECT_THAT(refusal_of("--picture", "a.odt"),
              HasSubstr("a.odt: pictures are written as .png or .jpg"));
}

TEST(EvaluateProgram, RefusesToWriteOverWhatItReads) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  folder.write("poses.jsonl", R"({"utime":5,"persons":[]})");
  folder.write("truth/a_gt.json", R"({"utime":5,"persons":[]})");
  const std::vector<std::string> log = {folder / "out.log"};
  const std::vector<std::string> poses = {"--poses", folder / "poses.jsonl", "--truth",
                                          folder / "truth"};
  const auto expect_refusal = [](std::vector<std::string> arguments, const std::string& option,
                                 const std::string& path) {
    const auto size = std::filesystem::file_size(path);
    arguments.insert(arguments.end(), {option, path});
    const Outcome outcome = evaluate_program(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "limbcast-evaluate: " + path + ": is what is read; choose another " + option + "\n");
    EXPECT_EQ(std::filesystem::file_size(path), size);
  };
  expect_refusal(log, "--json", folder / "out.log");
  expect_refusal(log, "--picture", folder / "out.log");
  expect_refusal(poses, "--json", folder / "poses.jsonl");
  expect_refusal(poses, "--json", folder / "truth/a_gt.json");
}

TEST(EvaluateProgram, SaysThatItsReportCouldNotBeWritten) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  const std::string program = std::string(LIMBCAST_BIN_DIR) + "/limbcast-evaluate";
  const int status = std::system((shell_quoted(program) + " " + shell_quoted(folder / "out.log") +
                                  " >/dev/full 2>" + shell_quoted(folder / "err"))
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  std::ifstream err(folder / "err");
  std::string line;
  std::getline(err, line);
  EXPECT_EQ(line, "limbcast-evaluate: cannot write to stdout (No space left on device)");
}

TEST(EvaluateProgram, WritesJsonBehindTheReportWhereBothGoToStdout) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  const std::string program = std::string(LIMBCAST_BIN_DIR) + "/limbcast-evaluate";
  ASSERT_EQ(std::system((shell_quoted(program) + " " + shell_quoted(folder / "out.log") +
                         " --brief --json /dev/stdout >" + shell_quoted(folder / "all"))
                            .c_str()),
            0);
  std::ifstream all(folder / "all");
  std::string line;
  std::getline(all, line);
  EXPECT_THAT(line, StartsWith("accuracy on 2 frames:"));
  EXPECT_EQ(nlohmann::json::parse(all)["frames"], 2);
}

TEST(EvaluateProgram, JudgesALogOfARoomWithoutPeople) {
  const TemporaryFolder folder;
  lcm_io::LogWriter log(folder / "out.log");
  for (const char* channel : {"GROUND_TRUTH", "BODY_POSES"})
    log.write(0, channel, lcm_io::to_message(stamped(frame({}, 0))));
  log.close();
  const Outcome outcome = evaluate_program({folder / "out.log"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST(EvaluateProgram, CountsOnceWhatTwoLoggersHeard) {
  const TemporaryFolder folder;
  lcm_io::LogWriter log(folder / "out.log");
  for (const char* channel : {"GROUND_TRUTH", "GROUND_TRUTH", "BODY_POSES", "BODY_POSES"})
    log.write(0, channel, lcm_io::to_message(stamped(frame({pointing_figure()}, 0))));
  log.close();
  EXPECT_THAT(evaluate_program({folder / "out.log", "--brief"}).out,
              StartsWith("accuracy on 1 frames: "));
}

TEST(EvaluateProgram, GoesOnWithATornLog) {
  const TemporaryFolder folder;
  write_log(folder / "out.log", true);
  std::filesystem::resize_file(folder / "out.log",
                               std::filesystem::file_size(folder / "out.log") - 10);
  const Outcome outcome = evaluate_program({folder / "out.log"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("is torn"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 frames with truth, 1 of them not reported"));
}

}  // namespace
}  // namespace limbcast::evaluate
