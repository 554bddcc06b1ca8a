#include "modules/pose_fitter/refined/cost/cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/pose_fitter/refined/refined_body.hpp"

namespace limbcast::pose_fitter {
namespace {

using refined::BodyState;
using testing::kDegree;

/// Marks what is seen of the person within a hand's length of `center_m` as skin-coloured.
void paint_skin(Segment& segment, const Eigen::Vector3d& center_m) {
  constexpr float kHandM = 0.08F;
  RangeImage& image = *segment.range_image;
  image.is_skin.assign(image.depth_m.size(), 0);
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v) * image.camera.width + u;
      const Eigen::Vector3f point_m =
          image.camera.back_project(static_cast<float>(u), static_cast<float>(v), image.depth_m[i]);
      if ((point_m - center_m.cast<float>()).norm() < kHandM) image.is_skin[i] = 1;
    }
  }
}

class SkinTerm : public ::testing::Test {
 protected:
  static constexpr int kSide = 0;

  /// A body whose left arm points `degrees` below the horizontal.
  static BodyState pointing_down(double degrees) {
    BodyState body = testing::standing_body(2.5, 0.0);
    const double angle_rad = degrees * kDegree;
    testing::point_with(body, kSide, {std::cos(angle_rad), std::sin(angle_rad), -0.1});
    return body;
  }
  /// Of the pointing hand alone.
  refined::NormalEquations equations_at(const BodyState& body) const {
    const refined::Cones cones = make_cones_of(body);
    refined::Workspace workspace;
    workspace.cones.clear();
    refined::NormalEquations equations;
    equations.clear(true);
    add_skin_term(cones, *observation_, refined::arm_bit(kSide), workspace, equations);
    workspace.cones.add_to(body, equations);
    return equations;
  }

  const BodyState body_ = pointing_down(0.0);
  Segment segment_ = testing::seen(body_);
  std::optional<refined::Observation> observation_ =
      refined::observe(segment_, testing::stamp(), RefinedParams{});
};

TEST_F(SkinTerm, LeavesAHandWhereItIsWithoutColour) {
  EXPECT_EQ(equations_at(pointing_down(10.0)).cost, 0.0);
}

TEST_F(SkinTerm, PullsAHandToTheSkinAndLetsItGoFarFromAny) {
  paint_skin(segment_, body_.points[refined::kHand + kSide]);
  observation_ = refined::observe(segment_, testing::stamp(), RefinedParams{});
  ASSERT_TRUE(observation_);
  const BodyState beside = pointing_down(15.0);

  const refined::NormalEquations here = equations_at(beside);

  EXPECT_LT(equations_at(body_).cost, 0.1);
  EXPECT_GT(here.cost, 1.0);
  // 15 degrees have moved the hand by about 15 cm.
  const refined::Step uphill = here.gradient.normalized();
  EXPECT_LT(equations_at(moved(beside, -0.03 * uphill)).cost, here.cost);
  EXPECT_GT(equations_at(moved(beside, 0.03 * uphill)).cost, here.cost);
  // A sleeve or a glove is no worse than this, however far the next skin.
  EXPECT_LT(equations_at(pointing_down(80.0)).cost, 3.2);
  EXPECT_LT(equations_at(pointing_down(80.0)).gradient.norm(), 0.1 * here.gradient.norm());
}

TEST_F(SkinTerm, NeedsMoreThanStrayPixels) {
  constexpr int kEnough = 20;
  RangeImage& image = *segment_.range_image;
  image.is_skin.assign(image.depth_m.size(), 0);
  int painted = 0;
  for (std::size_t i = 0; painted < kEnough; ++i) {
    if (image.labels[i] != PixelLabel::kPerson) continue;
    image.is_skin[i] = 1;
    if (++painted < kEnough - 1) continue;
    observation_ = refined::observe(segment_, testing::stamp(), RefinedParams{});
    ASSERT_TRUE(observation_);
    EXPECT_EQ(equations_at(body_).cost > 0.0, painted == kEnough) << painted;
  }
}

}  // namespace
}  // namespace limbcast::pose_fitter
