#include <gtest/gtest.h>

#include <optional>

#include "modules/pose_fitter/refined/cost/cost.hpp"
#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using refined::BodyState;

/// Somebody whose left arm is held out beside the body.
class FreeSpaceTerm : public ::testing::Test {
 protected:
  static constexpr int kSide = 0;
  static constexpr float kWallM = 2.0F;  ///< behind the arm

  static BodyState arm_held_out() {
    BodyState body = testing::standing_body(2.5, 0.0);
    testing::point_with(body, kSide, {1.0, 0.1, -0.1});
    return body;
  }

  /// As seen where the forearm's pixels, but not the hand's, are not the person's, and lie so far
  /// behind it.
  Segment forearm_cut_off(float behind_m) const {
    constexpr float kBesideJointsPx = 4.0F;
    Segment segment = testing::seen(body_);
    RangeImage& image = *segment.range_image;
    const auto column = [&](int point) {
      return image.camera.project(body_.points[point + kSide].cast<float>()).x();
    };
    const float from_u = column(refined::kElbow) + kBesideJointsPx,
                to_u = column(refined::kWrist) - kBesideJointsPx;
    for (int v = 0; v < image.camera.height; ++v) {
      for (int u = 0; u < image.camera.width; ++u) {
        const std::size_t i = static_cast<std::size_t>(v) * image.camera.width + u;
        const auto column_u = static_cast<float>(u);
        if (column_u < from_u || column_u > to_u || image.labels[i] != PixelLabel::kPerson)
          continue;
        image.labels[i] = PixelLabel::kOther;
        image.depth_m[i] += behind_m;
      }
    }
    return segment;
  }

  /// Of the arm alone, where it is.
  double cost_in(const Segment& segment) const {
    const auto observation = refined::observe(segment, testing::stamp(), RefinedParams{});
    const refined::Cones cones = make_cones_of(body_);
    refined::Workspace workspace;
    workspace.cones.clear();
    refined::NormalEquations equations;
    equations.clear(true);
    add_free_space_term(cones, *observation, refined::arm_bit(kSide),
                        RefinedParams{}.silhouette_weight, workspace, equations);
    return equations.cost;
  }

  const BodyState body_ = arm_held_out();
};

TEST_F(FreeSpaceTerm, CostsNothingOfAnArmInSight) { EXPECT_LT(cost_in(testing::seen(body_)), 1.0); }

TEST_F(FreeSpaceTerm, CostsMuchWhereTheSensorSawThroughTheArm) {
  EXPECT_GT(cost_in(forearm_cut_off(kWallM)), 20.0);
}

TEST_F(FreeSpaceTerm, CostsLittleWhereTheArmIsThereAndTakenForSomethingElse) {
  const double seen_through = cost_in(forearm_cut_off(kWallM));
  for (const float behind_m : {-0.3F, 0.0F, 0.2F})
    EXPECT_LT(cost_in(forearm_cut_off(behind_m)), 0.25 * seen_through) << behind_m << " m behind";
}

}  // namespace
}  // namespace limbcast::pose_fitter
