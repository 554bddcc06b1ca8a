#include "modules/segmenter/bodies/lost_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

namespace limbcast::segmenter {
namespace {

constexpr int kArmImageWidth = 320, kArmImageHeight = 240;
constexpr float kArm_m = 2.5F, kBehindArm_m = 4.0F;
constexpr std::int16_t kOwner = 0;
/// Pixels of the trunk, and of the arm beside it, which starts behind a gap.
const cv::Rect kTrunkPx(140, 60, 40, 150), kArmPx(186, 90, 50, 8);

/// Somebody before a wall whose stretched arm has no segment.
class LostArm : public ::testing::Test {
 protected:
  LostArm() {
    PinholeCamera camera;
    camera.width = kArmImageWidth;
    camera.height = kArmImageHeight;
    camera.fx = camera.fy = 260.0;
    camera.cx = 0.5 * (kArmImageWidth - 1);
    camera.cy = 0.5 * (kArmImageHeight - 1);
    cloud_.width = kArmImageWidth;
    cloud_.height = kArmImageHeight;
    cloud_.camera = camera;
    cloud_.points_m.resize(static_cast<std::size_t>(kArmImageWidth) * kArmImageHeight);
    cloud_.colors.resize(cloud_.points_m.size());
    labels_.assign(cloud_.points_m.size(), kNobody);
    draw(cv::Rect(0, 0, kArmImageWidth, kArmImageHeight), kBehindArm_m);
    draw(kTrunkPx, kArm_m);
    draw(kArmPx, kArm_m);
    set_labels(kTrunkPx, kOwner);

    Segment person;
    person.seed_m = cloud_.camera->back_project(160.0F, 65.0F, kArm_m);
    person.image_poses.push_back(
        {1.0F,
         {{Joint::kElbowLeft, {200.0F, 94.0F}, 1.0F}, {Joint::kWristLeft, {226.0F, 94.0F}, 1.0F}}});
    segments_.push_back(person);
  }

  void draw(const cv::Rect& part, float depth_m) {
    for (int v = part.y; v < part.br().y; ++v) {
      for (int u = part.x; u < part.br().x; ++u)
        cloud_.points_m[at(u, v)] =
            cloud_.camera->back_project(static_cast<float>(u), static_cast<float>(v), depth_m);
    }
  }
  void set_labels(const cv::Rect& part, std::int16_t label) {
    for (int v = part.y; v < part.br().y; ++v) {
      for (int u = part.x; u < part.br().x; ++u) labels_[at(u, v)] = label;
    }
  }
  static std::size_t at(int u, int v) { return static_cast<std::size_t>(v) * kArmImageWidth + u; }

  /// How many of the points are in which segment after the arms were looked for.
  long count(std::int16_t label) const {
    const auto labels = add_lost_arms(look_at(cloud_, params_), segments_, labels_, params_);
    return std::count(labels.begin(), labels.end(), label);
  }

  Cloud cloud_;
  std::vector<std::int16_t> labels_;
  std::vector<Segment> segments_;
  const Params params_{};
};

TEST_F(LostArm, IsThePersonsWhoseForearmTheImageMarksThere) {
  EXPECT_EQ(count(kOwner), kTrunkPx.area() + kArmPx.area());
}

TEST_F(LostArm, IsTakenWhereTheDepthsLeftItUnsure) {
  set_labels(kArmPx, kUnsure);
  EXPECT_EQ(count(kOwner), kTrunkPx.area() + kArmPx.area());
}

TEST_F(LostArm, IsWhereTheSecondNetworkSeesItIfTwoLooked) {
  ImagePose elsewhere = segments_[0].image_poses[0];
  for (ImageJoint& joint : elsewhere.joints) joint.px.y() += 60.0F;
  segments_[0].image_poses.push_back(elsewhere);
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
}

TEST_F(LostArm, IsNoneOfSomebodyElse) {
  constexpr std::int16_t kOther = 1;
  segments_.push_back(segments_[0]);
  segments_[1].image_poses.clear();
  set_labels(kArmPx, kOther);
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
  EXPECT_EQ(count(kOther), kArmPx.area());
}

TEST_F(LostArm, IsNoLargerSurface) {
  draw(cv::Rect(186, 60, 80, 80), kArm_m);
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
}

TEST_F(LostArm, IsNotFartherAwayThanAnArmReaches) {
  draw(kArmPx, kArm_m + params_.lost_arms.max_head_distance_m);
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
}

TEST_F(LostArm, IsNoneWhereTheElbowIsOutOfSight) {
  segments_[0].image_poses[0].joints[0].visibility = 0.4F;
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
}

TEST_F(LostArm, IsNoneOfARejectedCandidate) {
  segments_[0].rejected_by = SegmentFilter::kSamePerson;
  EXPECT_EQ(count(kOwner), kTrunkPx.area());
}

/// The same arm, which has a segment of its own.
class ArmTakenForAHead : public LostArm {
 protected:
  static constexpr std::int16_t kArm = 1;

  ArmTakenForAHead() {
    set_labels(kArmPx, kArm);
    Segment arm;
    arm.seed_m = cloud_.camera->back_project(215.0F, 94.0F, kArm_m);
    segments_.push_back(arm);
    seen_ = segments_[0].image_poses[0];
    seen_->joints.push_back({Joint::kHead, {160.0F, 65.0F}, 1.0F});
  }

  bool is_joined() {
    const PersonLook look = [&](const std::vector<std::int16_t>& labels, std::int16_t person) {
      ++looks_;
      EXPECT_EQ(person, kOwner);
      EXPECT_EQ(std::count(labels.begin(), labels.end(), kArm), 0) << "it would be painted over";
      return seen_;
    };
    join_arms_taken_for_heads(look_at(cloud_, params_), look, params_.lost_arms, segments_,
                              labels_);
    const bool rejected = segments_[kArm].rejected_by == SegmentFilter::kSamePerson;
    EXPECT_EQ(segments_[kArm].valid(), !rejected);
    EXPECT_EQ(std::count(labels_.begin(), labels_.end(), kOwner),
              kTrunkPx.area() + (rejected ? kArmPx.area() : 0));
    return rejected;
  }

  std::optional<ImagePose> seen_;
  int looks_ = 0;
};

TEST_F(ArmTakenForAHead, IsJoinedToThePersonWhoseArmTheImageMarksThere) {
  EXPECT_TRUE(is_joined());
  EXPECT_EQ(looks_, 1) << "the trunk is too large to be an arm";
}

TEST_F(ArmTakenForAHead, IsLeftWhereTheImageMarksNoArm) {
  for (ImageJoint& joint : seen_->joints) joint.px.y() += 30.0F;
  seen_->joints.back().px.y() -= 30.0F;
  EXPECT_FALSE(is_joined());
}

TEST_F(ArmTakenForAHead, IsLeftWhereTheImageMarksTheHeadElsewhere) {
  seen_->joints.back().px.x() += 40.0F;
  EXPECT_FALSE(is_joined());
}

TEST_F(ArmTakenForAHead, IsLeftWhereTheImageShowsNobody) {
  seen_.reset();
  EXPECT_FALSE(is_joined());
}

TEST_F(ArmTakenForAHead, IsNotAskedForWhereTheSegmentIsAsLargeAsAPerson) {
  const cv::Rect person(186, 60, 60, 30);
  draw(person, kArm_m);
  set_labels(person, kArm);
  EXPECT_FALSE(is_joined());
  EXPECT_EQ(looks_, 0);
}

TEST_F(ArmTakenForAHead, IsNotAskedForWhereTheTwoAreApart) {
  segments_[kArm].seed_m.x() += params_.lost_arms.max_seeds_apart_m;
  EXPECT_FALSE(is_joined());
  EXPECT_EQ(looks_, 0);
}

}  // namespace
}  // namespace limbcast::segmenter
