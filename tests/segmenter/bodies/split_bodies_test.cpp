#include "modules/segmenter/bodies/split_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "modules/segmenter/seeds/seed_place.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/simulated_person.hpp"

namespace limbcast::segmenter {
namespace {

constexpr int kSide_px = 200;
constexpr float kBody_m = 2.5F;
constexpr std::int16_t kUpper = 0, kLower = 1;
/// Pixels of the trunk that is bent down, with the head, and of the hips and legs.
const cv::Rect kUpperPx(40, 50, 70, 40), kLowerPx(110, 50, 40, 130);
const Eigen::Vector2f kHeadPx(45.0F, 70.0F), kBackPx(130.0F, 55.0F), kKneePx(130.0F, 140.0F),
    kAnklePx(130.0F, 170.0F), kElbowPx(60.0F, 80.0F);

/// Somebody who bends down, as two segments, each with what the network of depths sees of it.
class SplitBody : public ::testing::Test {
 protected:
  SplitBody() {
    PinholeCamera camera;
    camera.width = camera.height = kSide_px;
    camera.fx = camera.fy = 250.0;
    camera.cx = camera.cy = 0.5 * (kSide_px - 1);
    cloud_.width = cloud_.height = kSide_px;
    cloud_.camera = camera;
    cloud_.points_m.resize(static_cast<std::size_t>(kSide_px) * kSide_px);
    labels_.assign(cloud_.points_m.size(), kNobody);
    draw(kUpperPx, kUpper);
    draw(kLowerPx, kLower);
    segments_.resize(2);
    segments_[kUpper].seed_m = at(kHeadPx);
    segments_[kLower].seed_m = at(kBackPx);
    poses_.assign(2, pose_that_sees_nothing());
    see(kUpper, Joint::kHead, behind_surface(at(kHeadPx)), 0.9F);
    see(kUpper, Joint::kElbowLeft, at(kElbowPx), 0.9F);
    see(kUpper, Joint::kKneeLeft, at(kKneePx), 0.9F);
    see(kUpper, Joint::kAnkleLeft, at(kAnklePx), 0.9F);
    see(kLower, Joint::kKneeLeft, at(kKneePx), 0.9F);
    see(kLower, Joint::kHead, behind_surface(at(kBackPx)), 0.1F);
  }

  Eigen::Vector3f at(const Eigen::Vector2f& px) const {
    return cloud_.camera->back_project(px.x(), px.y(), kBody_m);
  }
  void draw(const cv::Rect& part, std::int16_t label) {
    for (int v = part.y; v < part.br().y; ++v) {
      for (int u = part.x; u < part.br().x; ++u) {
        const auto i = static_cast<std::size_t>(v) * kSide_px + u;
        cloud_.points_m[i] = at({static_cast<float>(u), static_cast<float>(v)});
        labels_[i] = label;
      }
    }
  }
  static PoseInDepths pose_that_sees_nothing() {
    PoseInDepths pose;
    pose.person_score = 0.99F;
    pose.places_m.fill({0.0F, 0.0F, kBody_m});
    pose.visibilities.fill(0.0F);
    pose.spreads_m.fill(0.02F);
    return pose;
  }
  void see(std::int16_t label, Joint joint, const Eigen::Vector3f& place_m, float visibility) {
    poses_[label]->places_m[index(joint)] = place_m;
    poses_[label]->visibilities[index(joint)] = visibility;
  }
  bool joins() {
    return join_split_bodies(look_at(cloud_, params_), poses_, params_.split_bodies, segments_,
                             labels_);
  }
  bool puts_seeds() { return put_seeds_to_heads(poses_, params_.split_bodies, segments_, labels_); }

  Params params_;
  Cloud cloud_;
  std::vector<std::int16_t> labels_;
  std::vector<Segment> segments_;
  PosesInDepths poses_;
};

TEST_F(SplitBody, IsOneSegmentFromTheHeadOnWhereItsLimbsAreInTheOther) {
  EXPECT_TRUE(joins());
  EXPECT_TRUE(segments_[kUpper].valid());
  EXPECT_EQ(segments_[kLower].rejected_by, SegmentFilter::kSamePerson);
  EXPECT_EQ(std::count(labels_.begin(), labels_.end(), kLower), 0);
  EXPECT_EQ(std::count(labels_.begin(), labels_.end(), kUpper), kUpperPx.area() + kLowerPx.area());
}

TEST_F(SplitBody, IsNoneWhereTheOtherSegmentHasAHeadOfItsOwn) {
  see(kLower, Joint::kHead, behind_surface(at(kBackPx)), 0.4F);
  EXPECT_FALSE(joins());
  EXPECT_TRUE(segments_[kLower].valid());
}

TEST_F(SplitBody, IsOneWhereTheBackLooksLikeAHeadToo) {
  see(kLower, Joint::kHead, behind_surface(at(kBackPx)), 0.6F);
  EXPECT_FALSE(joins()) << "two joints";
  see(kUpper, Joint::kHipLeft, at(kBackPx), 0.9F);
  see(kUpper, Joint::kHipRight, at(kBackPx), 0.9F);
  poses_[kLower]->visibilities[index(Joint::kHead)] = 0.8F;
  EXPECT_FALSE(joins()) << "seen as plainly as the head";
  poses_[kLower]->visibilities[index(Joint::kHead)] = 0.6F;
  EXPECT_TRUE(joins());
}

TEST_F(SplitBody, IsOneWhereTheOthersHeadIsSeenElsewhere) {
  see(kLower, Joint::kHead, behind_surface(at(kHeadPx)), 0.9F);
  see(kLower, Joint::kElbowLeft, at(kElbowPx), 0.9F);
  poses_[kLower]->visibilities[index(Joint::kHead)] = 0.5F;
  EXPECT_TRUE(joins());
  EXPECT_TRUE(segments_[kUpper].valid()) << "whose seed is at the head";
}

TEST_F(SplitBody, IsNoneWhereAllLimbsButOneAreInTheirOwnSegment) {
  see(kUpper, Joint::kKneeLeft, at(kElbowPx), 0.9F);
  EXPECT_FALSE(joins());
}

TEST_F(SplitBody, IsNoneWhereTheLimbsInTheOtherAreHidden) {
  see(kUpper, Joint::kKneeLeft, at(kKneePx), 0.2F);
  EXPECT_FALSE(joins());
}

TEST_F(SplitBody, IsNotAskedForWhereNoHeadIsSeen) {
  for (const float visibility : {0.2F, 0.9F}) {
    see(kUpper, Joint::kHead, behind_surface(at(kHeadPx)), visibility);
    poses_[kUpper]->spreads_m[index(Joint::kHead)] = visibility > 0.5F ? 0.1F : 0.02F;
    EXPECT_FALSE(joins()) << visibility;
  }
}

TEST_F(SplitBody, IsNoneOfTwoWhoBeganFarFromOneAnother) {
  params_.split_bodies.max_seeds_apart_m = 0.5F;
  EXPECT_FALSE(joins());
}

TEST_F(SplitBody, IsLeftAsItIsWhereTheNetworkIsSwitchedOff) {
  poses_.assign(2, std::nullopt);
  EXPECT_FALSE(joins());
  EXPECT_FALSE(puts_seeds());
}

TEST_F(SplitBody, HasItsSeedPutToTheHeadThatIsSeenElsewhere) {
  segments_[kUpper].rejected_by = SegmentFilter::kNotHeadShaped;
  segments_[kLower].seed_kind = SeedKind::kBody;
  see(kLower, Joint::kHead, behind_surface(at(kHeadPx)), 0.9F);
  EXPECT_TRUE(puts_seeds());
  EXPECT_LT((segments_[kLower].seed_m - at(kHeadPx)).norm(), 1e-4F);
  EXPECT_EQ(segments_[kLower].seed_kind, SeedKind::kHeadShape) << "it is in sight";
  EXPECT_FALSE(puts_seeds()) << "once more";
}

TEST_F(SplitBody, IsOneWhereTheOthersHeadIsSeenWhereItBegan) {
  see(kLower, Joint::kHead, behind_surface(at(kHeadPx)), 0.9F);
  EXPECT_TRUE(puts_seeds());
  EXPECT_EQ(segments_[kLower].rejected_by, SegmentFilter::kSamePerson);
  EXPECT_EQ(std::count(labels_.begin(), labels_.end(), kUpper), kUpperPx.area() + kLowerPx.area());
}

TEST_F(SplitBody, IsNoneWhereTheOthersHeadIsBesideIt) {
  see(kLower, Joint::kHead, behind_surface(at(kHeadPx)) + Eigen::Vector3f(0.2F, 0.0F, 0.0F), 0.9F);
  EXPECT_TRUE(puts_seeds());
  EXPECT_TRUE(segments_[kLower].valid());
}

TEST_F(SplitBody, KeepsItsSeedWhereTheHeadIsSeenHardlyOrNear) {
  see(kLower, Joint::kHead, behind_surface(at(kHeadPx)), 0.3F);
  see(kUpper, Joint::kHead, behind_surface(at(kHeadPx)) + Eigen::Vector3f(0.15F, 0.0F, 0.0F), 0.9F);
  EXPECT_FALSE(puts_seeds());
}

/// Somebody in full sight before a depth camera, who bends so deep that the back is uppermost.
class PersonWhoBendsDown : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    const auto params = person_in_sight(simulate::SensorKind::kDepth, "bow");
    const simulate::SimulatedFrame frame = simulate::simulate_frame(params, GetParam(), 0);
    cloud_ = depth_cloud(params, frame);
    const auto& joints_m = frame.scenario.persons.at(0).skeleton.joints;
    head_m_ = joints_m[index(Joint::kHead)].cast<float>();
    shoulder_m_ = joints_m[index(Joint::kShoulderLeft)].cast<float>();
  }
  Cloud cloud_;
  Eigen::Vector3f head_m_, shoulder_m_;
};

TEST_P(PersonWhoBendsDown, IsOneSegmentThatBeginsAtTheHead) {
  const Segments found = segment(cloud_);
  ASSERT_FALSE(found.segments.empty());
  const auto near = [&](const Segment& segment) {
    return segment.valid() && (segment.seed_m - head_m_).norm() < 1.0F;
  };
  EXPECT_EQ(std::count_if(found.segments.begin(), found.segments.end(), near), 1);
  const auto person = std::find_if(found.segments.begin(), found.segments.end(), near);
  ASSERT_NE(person, found.segments.end());
  EXPECT_LT((behind_surface(person->seed_m) - head_m_).norm(), 0.15F);
}

TEST_P(PersonWhoBendsDown, IsCutOutFromWhereItIsToldToBegin) {
  const Segments cut = Segmenter().cut_out_people(cloud_, {shoulder_m_});
  ASSERT_EQ(cut.segments.size(), 1U);
  EXPECT_LT((cut.segments[0].seed_m - shoulder_m_).norm(), 0.2F);
}

INSTANTIATE_TEST_SUITE_P(Simulated, PersonWhoBendsDown, ::testing::Values(7, 11, 15, 30));

}  // namespace
}  // namespace limbcast::segmenter
