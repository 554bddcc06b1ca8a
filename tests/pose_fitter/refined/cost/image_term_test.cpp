#include "modules/pose_fitter/refined/cost/image_term.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// A body that faces the camera, and a network that sees each of its joints where it is.
class ImageTerm : public ::testing::Test {
 protected:
  ImageTerm() { observation_.looks = {look_of(body_, ImageNetwork::kBlazePose)}; }

  static ImageLook look_of(const BodyState& body, ImageNetwork network) {
    ImageLook look;
    look.network = network;
    look.weight = 2.0;
    look.person_score = 0.9;
    for (int joint = 0; joint < kJointCount; ++joint)
      look.joints[joint] = {marked_place(body, joint, network).normalized(), 1.0,
                            marked_place(body, joint, network).z() - hips_depth_m(body)};
    return look;
  }
  /// It tells depths, as DepthPose does.
  void tell_depths() {
    observation_.looks = {look_of(body_, ImageNetwork::kDepthPose)};
    look().depth_weight = 0.5;
  }

  Real cost(const BodyState& body, unsigned parts = kAllParts) const {
    equations_->clear(false);
    add_image_term(body, observation_, parts, params_, *equations_);
    return equations_->cost;
  }
  BodyState with_wrist_moved(const Vec3& by) const {
    BodyState body = body_;
    body.points[kWrist] += by;
    return body;
  }
  void take_left_for_right() {
    for (int joint = kShoulder; joint < kJointCount; joint += 2)
      std::swap(look().joints[joint], look().joints[joint + 1]);
  }

  ImageLook& look() { return observation_.looks.front(); }
  ImageEvidence evidence_of(const BodyState& body) const {
    return image_evidence(body, observation_, params_).front();
  }

  const BodyState body_ = testing::standing_body(2.5, 0.0);
  const RefinedParams params_{};
  Observation observation_;
  const std::unique_ptr<NormalEquations> equations_ = std::make_unique<NormalEquations>();
};

TEST_F(ImageTerm, CostsNothingOnTheRays) { EXPECT_NEAR(cost(body_), 0.0, 1e-9); }

TEST_F(ImageTerm, CostsNothingAlongARay) {
  const Vec3 ray = marked_place(body_, kWrist, look().network).normalized();
  EXPECT_NEAR(cost(with_wrist_moved(0.3 * ray)), 0.0, 1e-9);
}

TEST_F(ImageTerm, CostsMoreTheFartherAJointStandsFromTheDepthThatIsTold) {
  tell_depths();
  EXPECT_NEAR(cost(body_), 0.0, 1e-9);
  const Vec3 ray = body_.points[kWrist].normalized();
  const Real near = cost(with_wrist_moved(0.05 * ray)), far = cost(with_wrist_moved(-0.10 * ray));
  EXPECT_GT(near, 0.0);
  EXPECT_GT(far, near);
  const Real limit = 0.5 * look().depth_weight * std::pow(params_.image_limit_sigmas, 2);
  EXPECT_LT(cost(with_wrist_moved(2.0 * ray)), limit);
}

TEST_F(ImageTerm, CostsNothingWhereTheWholeBodyIsFartherThanTheHipsThatTheDepthsAreToldFrom) {
  tell_depths();
  BodyState farther = body_;
  for (Vec3& point : farther.points) point.z() += 0.3;
  for (int joint = 0; joint < kJointCount; ++joint)
    look().joints[joint].ray = farther.points[joint].normalized();
  EXPECT_NEAR(cost(farther), 0.0, 1e-9);
}

TEST_F(ImageTerm, TellsTheSolverHowFarAwayToGo) {
  tell_depths();
  look().weight = 0.0;
  const BodyState moved_off = with_wrist_moved({0.0, 0.0, 0.02});
  equations_->clear(true);
  add_image_term(moved_off, observation_, kAllParts, params_, *equations_);
  // Wrist nearer or hips farther: both as the cost falls.
  constexpr Real kStep = 1e-5;
  for (const int point : {static_cast<int>(kWrist), static_cast<int>(kHip)}) {
    Step step = Step::Zero();
    step[3 * point + 2] = kStep;
    const Real told = equations_->gradient.dot(step);
    EXPECT_NE(told, 0.0);
    EXPECT_NEAR(cost(moved(moved_off, step)) - cost(moved_off), told, 1e-2 * std::abs(told));
  }
}

TEST_F(ImageTerm, CostsMoreTheFartherAJointStandsOffItsRay) {
  const Real near = cost(with_wrist_moved({0.05, 0.0, 0.0}));
  const Real far = cost(with_wrist_moved({0.10, 0.0, 0.0}));
  EXPECT_GT(near, 0.0);
  EXPECT_GT(far, near);
}

TEST_F(ImageTerm, CostsNoMoreThanItsLimitForAJointThatIsMarkedElsewhere) {
  const Real limit = 0.5 * look().weight * params_.image_limit_sigmas * params_.image_limit_sigmas;
  const Real cost_m = cost(with_wrist_moved({1.0, 0.0, 0.0}));
  EXPECT_LT(cost_m, limit);
  EXPECT_GT(cost_m, 0.9 * limit);
}

TEST_F(ImageTerm, CountsAJointAsSurelyAsItIsSeen) {
  const BodyState moved = with_wrist_moved({0.1, 0.0, 0.0});
  const Real sure = cost(moved);
  look().joints[kWrist].visibility = 0.25;
  EXPECT_NEAR(cost(moved), 0.25 * sure, 1e-9);
}

TEST_F(ImageTerm, CountsAMarkOfUnsurePlaceLessBesideItAndNoLessFarOff) {
  tell_depths();
  const auto costs = [&](Real off_m) {
    look().joints[kWrist].spread = 1.0;
    const Real sure = cost(with_wrist_moved({off_m, 0.0, off_m}));
    look().joints[kWrist].spread = 3.0;
    return cost(with_wrist_moved({off_m, 0.0, off_m})) / sure;
  };
  constexpr Real kNear_m = 0.003, kFar_m = 5.0;
  EXPECT_NEAR(costs(kNear_m), 1.0 / 9.0, 0.01);
  EXPECT_NEAR(costs(kFar_m), 1.0, 0.02);
}

TEST_F(ImageTerm, LeavesOutThePartsThatAreNotFitted) {
  EXPECT_NEAR(cost(with_wrist_moved({0.1, 0.0, 0.0}), kWithoutArms), 0.0, 1e-9);
}

TEST_F(ImageTerm, TellsTheSolverWhereToGo) {
  const BodyState moved_off = with_wrist_moved({0.02, 0.01, 0.0});
  equations_->clear(true);
  add_image_term(moved_off, observation_, kAllParts, params_, *equations_);
  // Along the gradient the cost falls as it tells.
  constexpr Real kStep = 1e-5;
  Step step = Step::Zero();
  step.segment<3>(3 * kWrist) = -kStep * equations_->gradient.segment<3>(3 * kWrist).normalized();
  const Real told = equations_->gradient.dot(step);
  EXPECT_NEAR(cost(moved(moved_off, step)) - cost(moved_off), told, 1e-2 * std::abs(told));
}

TEST_F(ImageTerm, CostsAFixedSumWhereTheImageTakesLeftForRight) {
  EXPECT_FALSE(takes_sides_otherwise(body_, look(), kAllParts, params_));
  take_left_for_right();
  EXPECT_TRUE(takes_sides_otherwise(body_, look(), kAllParts, params_));
  EXPECT_NEAR(cost(body_), params_.image_swap_cost, 1e-9);
}

TEST_F(ImageTerm, TellsHowClearlyTheSidesAgree) {
  EXPECT_NEAR(evidence_of(body_).sides_agreement, 1.0, 1e-9);
  take_left_for_right();
  EXPECT_NEAR(evidence_of(body_).sides_agreement, -1.0, 1e-9);
}

TEST_F(ImageTerm, MarksTheShoulderOfAHangingArmHigher) {
  BodyState raised = body_;
  raised.points[kElbow] = raised.points[kShoulder] + 0.3 * raised.rotation.col(1);
  for (const ImageNetwork network : {ImageNetwork::kBlazePose, ImageNetwork::kMoveNet}) {
    const Vec3 change =
        marked_place(raised, kShoulder, network) - marked_place(body_, kShoulder, network);
    EXPECT_LT(change.dot(raised.rotation.col(1)), -0.015);
    EXPECT_EQ(marked_place(raised, kShoulder + 1, network),
              marked_place(body_, kShoulder + 1, network));
  }
}

TEST_F(ImageTerm, TellsHowFarTheBodyAgrees) {
  const ImageEvidence agrees = evidence_of(body_);
  EXPECT_TRUE(agrees.told);
  EXPECT_FALSE(agrees.sides_swapped);
  EXPECT_NEAR(agrees.person_score, 0.9, 1e-9);
  EXPECT_NEAR(agrees.disagreement[kWrist], 0.0, 1e-9);
  const ImageEvidence differs = evidence_of(with_wrist_moved({0.5, 0.0, 0.0}));
  EXPECT_GT(differs.disagreement[kWrist], 0.9);
  EXPECT_NEAR(differs.disagreement[kElbow], 0.0, 1e-9);
}

TEST_F(ImageTerm, TakesWhichNetworkTheBodyAgreesWithWhereTheyDiffer) {
  const BodyState other = with_wrist_moved({0.5, 0.0, 0.0}),
                  between = with_wrist_moved({0.25, 0.0, 0.0});
  observation_.looks.push_back(look_of(other, ImageNetwork::kMoveNet));
  EXPECT_LT(cost(body_), cost(between));
  EXPECT_LT(cost(other), cost(between));
}

TEST_F(ImageTerm, CountsTheSidesOfEachNetworkByItself) {
  observation_.looks.push_back(look_of(body_, ImageNetwork::kMoveNet));
  take_left_for_right();
  EXPECT_NEAR(cost(body_), params_.image_swap_cost, 1e-9);
  const auto evidence = image_evidence(body_, observation_, params_);
  EXPECT_TRUE(evidence[0].sides_swapped);
  EXPECT_FALSE(evidence[1].sides_swapped);
}

TEST_F(ImageTerm, TellsWhatTheNetworkOfDepthsSeesByItself) {
  observation_.looks.push_back(
      look_of(with_wrist_moved({0.5, 0.0, 0.0}), ImageNetwork::kDepthPose));
  const auto evidence = image_evidence(body_, observation_, params_);
  EXPECT_FALSE(evidence[1].told);
  EXPECT_TRUE(evidence[2].told);
  EXPECT_NEAR(evidence[0].disagreement[kWrist], 0.0, 1e-9);
  EXPECT_GT(evidence[2].disagreement[kWrist], 0.9);
  // It was trained on the joints' centres.
  for (int joint = 0; joint < kJointCount; ++joint)
    EXPECT_EQ(marked_place(body_, joint, ImageNetwork::kDepthPose), body_.points[joint]);
}

TEST_F(ImageTerm, OfAHiddenJointIsNoEvidenceThoughItCounts) {
  SeenJoint& wrist = look().joints[kWrist];
  wrist.visibility = 0.25;
  wrist.told_visibility = 0.01;
  EXPECT_GT(cost(with_wrist_moved({0.5, 0.0, 0.0})), 0.0);
  EXPECT_NEAR(evidence_of(body_).visibility[kWrist], 0.01, 1e-9);
}

TEST_F(ImageTerm, TellsWhereAnArmPointsByTheNetworkThatTellsDepths) {
  const auto left_axis = [&] {
    return seen_arm_axis(body_, observation_, 0, image_evidence(body_, observation_, params_));
  };
  EXPECT_FALSE(left_axis()) << "none tells depths";
  const BodyState seen = with_wrist_moved({0.2, -0.3, -0.4});
  tell_depths();
  observation_.looks.insert(observation_.looks.begin(), look_of(body_, ImageNetwork::kBlazePose));
  observation_.looks.back() = look_of(seen, ImageNetwork::kDepthPose);
  observation_.looks.back().depth_weight = 0.5;
  const Vec3 axis = seen.points[kWrist] - seen.points[kShoulder];
  EXPECT_LT((left_axis().value() - axis).norm(), 1e-9);
  auto& joints = observation_.looks.back().joints;
  for (int joint = kShoulder; joint < kJointCount; joint += 2)
    std::swap(joints[joint], joints[joint + 1]);
  EXPECT_LT((left_axis().value() - axis).norm(), 1e-9) << "it takes left for right";
}

TEST_F(ImageTerm, TellsNothingWithoutAnImage) {
  observation_.looks.clear();
  EXPECT_EQ(cost(with_wrist_moved({0.5, 0.0, 0.0})), 0.0);
  EXPECT_FALSE(evidence_of(body_).told);
}

}  // namespace
}  // namespace limbcast::pose_fitter::refined
