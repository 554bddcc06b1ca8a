#include "modules/tracker/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/evaluate/figure.hpp"

namespace limbcast::tracker {
namespace {

using Eigen::Vector3f;
using evaluate::pointing_figure;
using evaluate::standing_figure;

constexpr std::int64_t kFrame_us = 100'000;

BodyPoses frame(int number, std::vector<BodyPose> persons) {
  BodyPoses poses;
  poses.stamp.utime = 1'000'000'000 + number * kFrame_us;
  poses.stamp.sensor = "front";
  poses.persons = std::move(persons);
  return poses;
}

BodyPose moved(BodyPose person, const Vector3f& by_m) {
  for (JointEstimate& joint : person.joints) joint.position_m += by_m;
  return person;
}

/// The same body, taller or smaller about its pelvis.
BodyPose scaled(BodyPose person, float scale) {
  const Vector3f pelvis_m = person[Joint::kPelvis].position_m;
  for (JointEstimate& joint : person.joints)
    joint.position_m = pelvis_m + scale * (joint.position_m - pelvis_m);
  return person;
}

BodyPose noisy(BodyPose person, std::mt19937& random, float sigma_m) {
  std::normal_distribution<float> noise_m(0.0F, sigma_m);
  for (JointEstimate& joint : person.joints)
    joint.position_m += Vector3f(noise_m(random), noise_m(random), noise_m(random));
  return person;
}

BodyPose sides_exchanged(BodyPose person) {
  for (int left = index(Joint::kShoulderLeft); left < kJointCount; left += 2)
    std::swap(person.joints[left], person.joints[left + 1]);
  return person;
}

std::vector<int> ids_of(const BodyPoses& poses) {
  std::vector<int> ids;
  for (const BodyPose& person : poses.persons) ids.push_back(person.id);
  return ids;
}

TEST(Tracker, GivesEachPersonANumberThatStaysWhateverTheirOrder) {
  Tracker tracker;
  const BodyPose a = standing_figure(-1.0F), b = standing_figure(1.0F);
  EXPECT_EQ(ids_of(*tracker.track(frame(0, {a, b}))), (std::vector<int>{1, 2}));
  const BodyPoses second = *tracker.track(frame(1, {b, a}));
  ASSERT_EQ(ids_of(second), (std::vector<int>{1, 2}));
  EXPECT_LT(second.persons[0][Joint::kHead].position_m.x(), 0.0F);
}

TEST(Tracker, KeepsWhoIsWhoWhenTwoCrossAndOneIsHiddenBehindTheOther) {
  Tracker tracker;
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    // 1 m/s towards each other, 0.6 m apart in depth, the far one hidden for half a second.
    const float x_m = -2.0F + 0.1F * static_cast<float>(i);
    const BodyPose near = noisy(standing_figure(x_m), random, 0.02F);
    const BodyPose far = noisy(moved(standing_figure(-x_m), {0.0F, 0.0F, 0.6F}), random, 0.02F);
    const bool hidden = i >= 18 && i < 23;
    const BodyPoses tracked = *tracker.track(
        frame(i, hidden ? std::vector<BodyPose>{near} : std::vector<BodyPose>{near, far}));
    ASSERT_GE(tracked.persons.size(), 1U);
    EXPECT_EQ(tracked.persons[0].id, 1);
    EXPECT_NEAR(tracked.persons[0][Joint::kHead].position_m.x(), x_m, 0.15F) << i;
    if (!hidden) {
      ASSERT_EQ(ids_of(tracked), (std::vector<int>{1, 2})) << "frame " << i;
    }
  }
}

TEST(Tracker, KnowsAPersonAgainWithinTwoSecondsAndNotLater) {
  for (const auto& [missing_frames, expected_id] : {std::pair(19, 1), std::pair(25, 2)}) {
    Tracker tracker;
    int number = 0;
    for (; number < 5; ++number) tracker.track(frame(number, {standing_figure()}));
    for (int i = 0; i < missing_frames; ++i) tracker.track(frame(number++, {}));
    const BodyPoses back = *tracker.track(frame(number, {standing_figure(0.3F)}));
    EXPECT_EQ(ids_of(back), (std::vector<int>{expected_id})) << missing_frames;
  }
}

TEST(Tracker, TellsTwoWhoMetOutOfSightApartByTheirBodies) {
  Tracker tracker;
  const BodyPose tall = standing_figure(-0.3F), small = scaled(standing_figure(0.3F), 0.75F);
  int number = 0;
  for (; number < 10; ++number) tracker.track(frame(number, {tall, small}));
  for (int i = 0; i < 15; ++i) tracker.track(frame(number++, {}));
  const BodyPoses back = *tracker.track(
      frame(number, {moved(tall, {0.6F, 0.0F, 0.0F}), moved(small, {-0.6F, 0.0F, 0.0F})}));
  ASSERT_EQ(ids_of(back), (std::vector<int>{1, 2}));
  EXPECT_GT(back.persons[0][Joint::kHead].position_m.x(), 0.0F) << "the tall one is on the right";
}

TEST(Tracker, BeginsNobodyNewInThePlaceOfSomebody) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i) tracker.track(frame(i, {standing_figure()}));
  const BodyPose on_false_head = moved(standing_figure(), {0.05F, 0.3F, 0.0F});
  EXPECT_EQ(ids_of(*tracker.track(frame(5, {standing_figure(), on_false_head}))),
            (std::vector<int>{1}));
}

TEST(Tracker, PredictsAShortGapAndMarksIt) {
  Tracker tracker;
  for (int i = 0; i < 10; ++i)
    tracker.track(frame(i, {standing_figure(0.05F * static_cast<float>(i))}));
  const BodyPoses gap = *tracker.track(frame(10, {}));
  ASSERT_EQ(ids_of(gap), (std::vector<int>{1}));
  for (const JointEstimate& joint : gap.persons[0].joints) {
    EXPECT_TRUE(joint.valid);
    EXPECT_TRUE(joint.predicted);
    EXPECT_LT(joint.confidence, 1.0F);
    EXPECT_GT(joint.sigma_m, 0.0F);
  }
  EXPECT_GT(gap.persons[0][Joint::kHead].position_m.x(), 0.45F) << "goes on walking";
  for (int i = 11; i < 16; ++i) tracker.track(frame(i, {}));
  EXPECT_TRUE(tracker.track(frame(16, {}))->persons.empty()) << "a long gap is not made up";
}

TEST(Tracker, DoesNotPredictWhatWasSeenOnce) {
  Tracker tracker;
  tracker.track(frame(0, {standing_figure()}));
  EXPECT_TRUE(tracker.track(frame(1, {}))->persons.empty());
}

TEST(Tracker, PredictsASingleJointThatIsLeftOut) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i) tracker.track(frame(i, {standing_figure()}));
  BodyPose without_wrist = standing_figure();
  without_wrist[Joint::kWristLeft] = JointEstimate{};
  const BodyPose pose = tracker.track(frame(5, {without_wrist}))->persons.at(0);
  EXPECT_TRUE(pose[Joint::kWristLeft].predicted);
  EXPECT_FALSE(pose[Joint::kElbowLeft].predicted);
  EXPECT_TRUE(pose[Joint::kWristLeft].position_m.isApprox(
      standing_figure()[Joint::kWristLeft].position_m, 1e-4F));
}

TEST(Tracker, HoldsAJointThatJumpsForOneFrameAndFollowsOneThatStays) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i) tracker.track(frame(i, {standing_figure()}));
  BodyPose jumped = standing_figure();
  jumped[Joint::kWristLeft].position_m += Vector3f(0.0F, 0.6F, 0.0F);
  const auto wrist = [](const std::optional<BodyPoses>& poses) {
    return poses->persons.at(0)[Joint::kWristLeft];
  };
  const JointEstimate held = wrist(tracker.track(frame(5, {jumped})));
  EXPECT_TRUE(held.predicted);
  EXPECT_NEAR(held.position_m.y(), standing_figure()[Joint::kWristLeft].position_m.y(), 0.01F);
  const JointEstimate followed = wrist(tracker.track(frame(6, {jumped})));
  EXPECT_FALSE(followed.predicted);
  EXPECT_TRUE(followed.position_m.isApprox(jumped[Joint::kWristLeft].position_m, 1e-4F));
}

TEST(Tracker, LeavesAJointWhereItJumpedToWhenItIsSeenNoMore) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i) tracker.track(frame(i, {standing_figure()}));
  const auto with_wrist_lower = [](float by_m) {
    BodyPose pose = standing_figure();
    pose[Joint::kWristLeft].position_m.y() += by_m;
    return pose;
  };
  tracker.track(frame(5, {with_wrist_lower(0.6F)}));
  tracker.track(frame(6, {with_wrist_lower(0.4F)}));
  BodyPose hidden = standing_figure();
  hidden[Joint::kWristLeft] = JointEstimate{};
  for (int i = 7; i < 10; ++i) {
    const BodyPose pose = tracker.track(frame(i, {hidden}))->persons.at(0);
    EXPECT_NEAR(pose[Joint::kWristLeft].position_m.y(),
                with_wrist_lower(0.4F)[Joint::kWristLeft].position_m.y(), 0.01F);
  }
}

TEST(Tracker, KeepsLeftAndRightWhenTheFitterExchangesThemForAFewFrames) {
  Tracker tracker;
  const BodyPose right = standing_figure(), wrong = sides_exchanged(standing_figure());
  int number = 0;
  for (; number < 12; ++number) tracker.track(frame(number, {right}));
  for (int i = 0; i < 5; ++i) {
    const BodyPose pose = tracker.track(frame(number++, {wrong}))->persons.at(0);
    EXPECT_LT((pose[Joint::kWristLeft].position_m - right[Joint::kWristLeft].position_m).norm(),
              0.01F);
  }
  for (int i = 0; i < 10; ++i) tracker.track(frame(number++, {wrong}));
  const BodyPose pose = tracker.track(frame(number, {wrong}))->persons.at(0);
  EXPECT_LT((pose[Joint::kWristLeft].position_m - wrong[Joint::kWristLeft].position_m).norm(),
            0.01F)
      << "what all frames say for a second is believed";
}

TEST(Tracker, AveragesTheDirectionOfAnArmThatRests) {
  Tracker tracker;
  std::mt19937 random(5);
  std::normal_distribution<float> noise_deg(0.0F, 2.0F);
  double in = 0.0, out = 0.0;
  for (int i = 0; i < 100; ++i) {
    const float off_deg = noise_deg(random);
    const BodyPose pose = tracker.track(frame(i, {pointing_figure(off_deg)}))->persons.at(0);
    ASSERT_EQ(pose.pointing.size(), 1U);
    EXPECT_NEAR(pose.pointing[0].direction.norm(), 1.0F, 1e-5F);
    if (i < 10) continue;
    const double tracked_deg =
        std::atan2(pose.pointing[0].direction.y(), pose.pointing[0].direction.x()) * 57.2957795;
    in += off_deg * off_deg;
    out += tracked_deg * tracked_deg;
  }
  EXPECT_LT(std::sqrt(out / in), 0.5);
}

TEST(Tracker, BridgesAFrameInWhichTheArmWasNotSaidToPoint) {
  Tracker tracker;
  for (int i = 0; i < 5; ++i) tracker.track(frame(i, {pointing_figure()}));
  const BodyPose pose = tracker.track(frame(5, {standing_figure()}))->persons.at(0);
  ASSERT_EQ(pose.pointing.size(), 1U);
  EXPECT_LT(pose.pointing[0].confidence, 1.0F);
  for (int i = 6; i < 12; ++i) tracker.track(frame(i, {standing_figure()}));
  EXPECT_TRUE(tracker.track(frame(12, {standing_figure()}))->persons.at(0).pointing.empty());
}

TEST(Tracker, SaysNothingToAFrameThatComesLate) {
  Tracker tracker;
  tracker.track(frame(5, {standing_figure()}));
  EXPECT_FALSE(tracker.track(frame(4, {standing_figure()})));
  EXPECT_FALSE(tracker.track(frame(5, {standing_figure()})));
  EXPECT_EQ(ids_of(*tracker.track(frame(6, {standing_figure()}))), (std::vector<int>{1}));
}

TEST(Tracker, BeginsAnewWhenTheClockJumps) {
  Tracker tracker;
  tracker.track(frame(1000, {standing_figure()}));
  EXPECT_EQ(ids_of(*tracker.track(frame(0, {standing_figure()}))), (std::vector<int>{2}));
  EXPECT_EQ(ids_of(*tracker.track(frame(5000, {standing_figure()}))), (std::vector<int>{3}));
}

TEST(Tracker, TakesPersonsOfWhomNoJointIsKnown) {
  Tracker tracker;
  const BodyPoses tracked = *tracker.track(frame(0, {BodyPose{}}));
  ASSERT_EQ(tracked.persons.size(), 1U);
  for (const JointEstimate& joint : tracked.persons[0].joints) EXPECT_FALSE(joint.valid);
}

}  // namespace
}  // namespace limbcast::tracker
