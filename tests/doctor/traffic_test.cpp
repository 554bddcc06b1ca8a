#include "modules/doctor/traffic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limbcast::doctor {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kCloudType = 11, kForeignType = 12;
const KnownChannels kKnown = {{"POINT_CLOUD", kCloudType}};

ModuleReport report(const std::string& module, const std::string& host, std::int64_t lost = 0) {
  return {module, host, 100, 1'000'000, 1'000'200, lost, "running", ""};
}

auto problem(const std::string& check, const std::string& text) {
  return AllOf(Field(&Finding::level, Level::kProblem), Field(&Finding::check, check),
               Field(&Finding::text, HasSubstr(text)));
}

TEST(CheckChannels, NamesAForeignTypeOnOneOfOurChannels) {
  Traffic traffic;
  traffic.duration_s = 1.0;
  traffic.channels["POINT_CLOUD"] = {2, 200, 100, {kCloudType}};
  EXPECT_THAT(check_channels(traffic, kKnown),
              Not(Contains(Field(&Finding::level, Level::kProblem))));
  traffic.channels["POINT_CLOUD"].fingerprints.insert(kForeignType);
  EXPECT_THAT(check_channels(traffic, kKnown),
              Contains(problem("channel POINT_CLOUD", "another type")));
}

TEST(CheckChannels, TellsOtherTrafficWithItsRate) {
  Traffic traffic;
  traffic.duration_s = 2.0;
  traffic.channels["ODOMETRY"] = {10, 5'000'000, 500'000, {kForeignType}};
  const Findings findings = check_channels(traffic, kKnown);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].level, Level::kNote);
  EXPECT_EQ(findings[0].text, "2.50 MB/s on ODOMETRY");
}

TEST(CheckModules, NamesWhatIsMissingInAChainThatRuns) {
  Traffic traffic;
  traffic.reports = {report("stereo_camera", "a"), report("reconstructor", "b"),
                     report("pose_fitter", "b")};
  EXPECT_THAT(check_modules(traffic, {}), Contains(problem("module segmenter", "not heard")));
}

TEST(CheckModules, MissesNoReconstructorAndNoCameraBesideASourceOfClouds) {
  for (const std::string source : {"laser_scanner", "simulate"}) {
    Traffic traffic;
    traffic.reports = {report(source, "a"), report("segmenter", "a"), report("pose_fitter", "a")};
    EXPECT_THAT(check_modules(traffic, {}), Each(Field(&Finding::level, Level::kGood))) << source;
    traffic.reports.push_back(report("depth_camera", "a"));
    EXPECT_THAT(check_modules(traffic, {}), Contains(problem("module reconstructor", "not heard")))
        << source;
  }
}

TEST(CheckModules, OnlyNotesThatNothingRunsYet) {
  const Findings findings = check_modules({}, {});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].level, Level::kNote);
  EXPECT_THAT(check_modules({}, {"tracker"}), Contains(problem("module tracker", "not heard")));
}

TEST(CheckModules, NamesAllModulesWhereAnUnknownOneIsMissed) {
  EXPECT_THAT(check_modules({}, {"segmentr"}),
              Contains(problem("module segmentr",
                               "limbcast has none of this name, only stereo_camera, depth_camera, "
                               "laser_scanner, simulate, reconstructor, segmenter, pose_fitter, "
                               "tracker")));
  Traffic traffic;
  traffic.reports = {report("planner", "vision")};
  EXPECT_THAT(check_modules(traffic, {"planner"}), Each(Field(&Finding::level, Level::kGood)));
}

TEST(CheckModules, NamesAModuleThatFailsOrLosesFrames) {
  Traffic traffic;
  traffic.reports = {report("segmenter", "b", 5), report("segmenter", "b", 9)};
  traffic.reports[1].state = "failing";
  traffic.reports[1].last_error = "POINT_CLOUD: empty";
  const Findings findings = check_modules(traffic, {"segmenter"});
  EXPECT_THAT(findings, Contains(problem("module segmenter on b", "POINT_CLOUD: empty")));
  EXPECT_THAT(findings, Contains(problem("module segmenter on b", "lost 4 frames")));
}

TEST(CheckModules, NotesAModuleOfTheChainThatRunsTwice) {
  Traffic traffic;
  traffic.reports = {report("segmenter", "b"), report("segmenter", "c")};
  EXPECT_THAT(check_modules(traffic, {"segmenter"}),
              Contains(Field(&Finding::text, HasSubstr("runs 2 times: b c"))));
}

TEST(CheckModules, NotesATrackerThatRunsTwice) {
  Traffic traffic;
  traffic.reports = {report("tracker", "b"), report("tracker", "c")};
  EXPECT_THAT(check_modules(traffic, {"tracker"}),
              Contains(Field(&Finding::text, HasSubstr("runs 2 times: b c"))));
}

TEST(CheckClocks, JudgesByTheMessageThatTookTheShortestWay) {
  Traffic traffic;
  traffic.reports = {report("segmenter", "b"), report("segmenter", "b")};
  traffic.reports[0].received_utime += 500'000;
  EXPECT_THAT(check_clocks(traffic, "a"), Contains(Field(&Finding::level, Level::kGood)));
}

TEST(CheckClocks, NamesAHostWhoseClockIsWrongAndNotThisOne) {
  Traffic traffic;
  traffic.reports = {report("segmenter", "a"), report("segmenter", "b")};
  traffic.reports[0].sent_utime += 60'000'000;
  traffic.reports[1].sent_utime += 60'000'000;
  const Findings findings = check_clocks(traffic, "a");
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(findings, Contains(problem("clock of b", "59999.8 ms ahead")));
}

TEST(LargestMessage, IsThatOfAllChannels) {
  Traffic traffic;
  traffic.channels["A"].largest = 5;
  traffic.channels["B"].largest = 7;
  EXPECT_EQ(largest_message(traffic), 7);
  EXPECT_EQ(largest_message({}), 0);
}

}  // namespace
}  // namespace limbcast::doctor
