#include "modules/evaluate/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/evaluate/figure.hpp"

namespace limbcast::evaluate {
namespace {

constexpr std::int64_t kFrame_us = 100'000;

BodyPoses at(int number, std::vector<BodyPose> persons) {
  BodyPoses poses = frame(std::move(persons));
  poses.stamp.utime = number * kFrame_us;
  return poses;
}

BodyPose numbered(BodyPose person, std::int32_t id) {
  person.id = id;
  return person;
}

struct Recording {
  std::vector<TruthFrame> truth;
  std::vector<BodyPoses> untracked, tracked;
  void add(const BodyPose& true_person, const BodyPose& seen, const BodyPose& followed) {
    const int number = static_cast<int>(truth.size());
    truth.push_back({at(number, {true_person}), {}});
    untracked.push_back(at(number, {seen}));
    tracked.push_back(at(number, {followed}));
  }
  TrackingTally tally() const { return evaluate_tracking(truth, untracked, tracked); }
};

double value_of(const TrackingTally& tally, const std::string& key) {
  for (const Figure& figure : tracking_figures(tally))
    if (figure.key == key) return figure.value.value_or(std::nan(""));
  return std::nan("");
}

TEST(EvaluateTracking, CountsEachChangeOfAPersonsNumber) {
  Recording recording;
  for (const int id : {4, 4, 5, 5, 4})
    recording.add(standing_figure(), standing_figure(), numbered(standing_figure(), id));
  EXPECT_EQ(recording.tally().identity_switches, 2);
  EXPECT_EQ(recording.tally().followed, 5);
}

TEST(EvaluateTracking, CountsNoSwitchWhereAnotherRecordingBegins) {
  Recording recording;
  recording.add(standing_figure(), standing_figure(), numbered(standing_figure(), 1));
  recording.add(standing_figure(2.0F), standing_figure(2.0F), numbered(standing_figure(2.0F), 2));
  EXPECT_EQ(recording.tally().identity_switches, 0);
}

TEST(EvaluateTracking, FollowsPeopleOfEachSensorByThemselves) {
  Recording recording;
  for (int i = 0; i < 4; ++i) {
    const bool front = i % 2 == 0;
    recording.add(standing_figure(), standing_figure(), numbered(standing_figure(), front ? 1 : 2));
    for (BodyPoses* poses :
         {&recording.truth.back().poses, &recording.untracked.back(), &recording.tracked.back()})
      poses->stamp.sensor = front ? "front" : "rear";
  }
  EXPECT_EQ(recording.tally().identity_switches, 0);
  EXPECT_EQ(recording.tally().followed, 4);
}

TEST(EvaluateTracking, TellsWhatIsLeftOfTheJitterOfJointsAtRest) {
  Recording recording;
  for (int i = 0; i < 10; ++i) {
    const float off_m = i % 2 == 0 ? 0.02F : -0.02F;
    recording.add(standing_figure(), standing_figure(off_m), standing_figure(0.25F * off_m));
  }
  const TrackingTally tally = recording.tally();
  EXPECT_NEAR(value_of(tally, "jitter_rms_untracked_mm"), 20.0, 0.01);
  EXPECT_NEAR(value_of(tally, "jitter_rms_tracked_mm"), 5.0, 0.01);
  EXPECT_NEAR(value_of(tally, "jitter_rms_left"), 25.0, 0.01);
}

TEST(EvaluateTracking, TellsHowMuchRestingJointsChangeFromFrameToFrame) {
  Recording recording;
  for (int i = 0; i < 10; ++i) {
    const float shake_m = i % 2 == 0 ? 0.01F : -0.01F;
    const float drift_m = 0.005F * static_cast<float>(i);
    recording.add(standing_figure(), standing_figure(shake_m), standing_figure(drift_m));
  }
  const TrackingTally tally = recording.tally();
  EXPECT_NEAR(value_of(tally, "jitter_step_rms_untracked_mm"), 20.0, 0.01);
  EXPECT_NEAR(value_of(tally, "jitter_step_rms_tracked_mm"), 5.0, 0.01);
  EXPECT_NEAR(value_of(tally, "jitter_step_rms_left"), 25.0, 0.1);
}

TEST(EvaluateTracking, TellsByHowManyFramesMovingJointsLag) {
  Recording recording;
  constexpr float kStep_m = 0.1F;
  for (int i = 0; i < 10; ++i) {
    const float x_m = kStep_m * static_cast<float>(i);
    recording.add(standing_figure(x_m), standing_figure(x_m),
                  standing_figure(x_m - 0.3F * kStep_m));
  }
  const TrackingTally tally = recording.tally();
  EXPECT_NEAR(value_of(tally, "lag_median_frames"), 0.3, 1e-4);
  EXPECT_NEAR(value_of(tally, "lag_p90_frames"), 0.3, 1e-4);
  EXPECT_TRUE(tally.untracked_joints_mm.empty()) << "nothing rests";
}

TEST(EvaluateTracking, ComparesDirectionsOfRestingArms) {
  Recording recording;
  for (int i = 0; i < 10; ++i) {
    const float off_deg = i % 2 == 0 ? 3.0F : -3.0F;
    recording.add(pointing_figure(), pointing_figure(off_deg), pointing_figure(0.5F * off_deg));
  }
  const TrackingTally tally = recording.tally();
  EXPECT_NEAR(value_of(tally, "pointing_jitter_rms_untracked_degrees"), 3.0, 0.02);
  EXPECT_NEAR(value_of(tally, "pointing_jitter_rms_left"), 50.0, 0.5);
}

TEST(EvaluateTracking, TellsTheLongerLagsToo) {
  Recording recording;
  for (int i = 0; i < 12; ++i) {
    const float x_m = 0.1F * static_cast<float>(i);
    const float lag_m = i == 5 || i == 6 ? 0.1F : 0.02F;
    recording.add(standing_figure(x_m), standing_figure(x_m), standing_figure(x_m - lag_m));
  }
  const TrackingTally tally = recording.tally();
  EXPECT_NEAR(value_of(tally, "lag_median_frames"), 0.2, 1e-4);
  EXPECT_NEAR(value_of(tally, "lag_p90_frames"), 1.0, 1e-4);
}

TEST(EvaluateTracking, LeavesOutFramesInWhichOneOfBothIsMissing) {
  Recording recording;
  for (int i = 0; i < 12; ++i) {
    const float x_m = 0.1F * static_cast<float>(i);
    recording.add(standing_figure(x_m), standing_figure(x_m), standing_figure(x_m - 0.03F));
  }
  recording.untracked[4].persons.clear();
  recording.tracked[7].persons.clear();
  const TrackingTally tally = recording.tally();
  EXPECT_EQ(tally.followed, 11);
  ASSERT_FALSE(tally.lags_frames.empty());
  EXPECT_EQ(tally.lags_frames[0].size(), 8U) << "12 frames without the ends and the two";
  EXPECT_NEAR(value_of(tally, "lag_median_frames"), 0.3, 1e-4);
}

TEST(EvaluateTracking, LeavesOutRestingFramesInWhichOneOfBothIsMissing) {
  Recording recording;
  for (int i = 0; i < 12; ++i)
    recording.add(standing_figure(), standing_figure(0.02F), standing_figure(0.01F));
  recording.untracked[4].persons.clear();
  recording.tracked[7].persons.clear();
  const TrackingTally tally = recording.tally();
  ASSERT_FALSE(tally.tracked_joints_mm.empty());
  EXPECT_EQ(tally.tracked_joints_mm[0].size(), 10U);
  EXPECT_EQ(tally.untracked_joints_mm[0].size(), 10U);
}

TEST(EvaluateTracking, HasNoShareOfAJitterThatWasNotThere) {
  Recording recording;
  for (int i = 0; i < 10; ++i)
    recording.add(standing_figure(), standing_figure(), standing_figure(i % 2 == 0 ? 0.01F : 0.0F));
  const TrackingTally tally = recording.tally();
  EXPECT_EQ(value_of(tally, "jitter_rms_untracked_mm"), 0.0);
  EXPECT_GT(value_of(tally, "jitter_rms_tracked_mm"), 1.0);
  EXPECT_TRUE(std::isnan(value_of(tally, "jitter_rms_left")));
}

TEST(EvaluateTracking, KnowsTruePersonsByTheirNumbersWhateverTheirOrder) {
  Recording recording;
  for (int i = 0; i < 10; ++i) {
    const BodyPose left = numbered(standing_figure(-1.0F), 1);
    const BodyPose right = numbered(standing_figure(1.0F), 2);
    const std::vector<BodyPose> persons =
        i % 2 == 0 ? std::vector<BodyPose>{left, right} : std::vector<BodyPose>{right, left};
    recording.truth.push_back({at(i, persons), {}});
    recording.untracked.push_back(at(i, persons));
    recording.tracked.push_back(at(i, persons));
  }
  EXPECT_EQ(recording.tally().followed, 20);
  EXPECT_EQ(recording.tally().identity_switches, 0);
  EXPECT_FALSE(recording.tally().tracked_joints_mm.empty()) << "both rest";
}

TEST(EvaluateTracking, TakesRecordingsInWhichNobodyIsFollowed) {
  Recording recording;
  recording.truth.push_back({at(0, {standing_figure()}), {}});
  EXPECT_EQ(recording.tally().followed, 0);
  EXPECT_TRUE(std::isnan(value_of(recording.tally(), "lag_median_frames")));
}

}  // namespace
}  // namespace limbcast::evaluate
