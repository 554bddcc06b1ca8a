// Heads by their shape, and the patches that the classifier reads, on figures drawn into a depth
// image.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "common/units.hpp"
#include "modules/segmenter/classifiers/head_classifier.hpp"
#include "modules/segmenter/classifiers/head_patch.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {
namespace {

constexpr int kViewWidth = 320, kViewHeight = 240;
constexpr float kViewFocal_px = 260.0F, kWall_m = 6.0F;

/// A camera's lattice that looks level at a bare wall.
class Picture {
 public:
  Picture() {
    lattice_.width = kViewWidth;
    lattice_.height = kViewHeight;
    lattice_.focal_px = kViewFocal_px;
    lattice_.frame.level_from_sensor << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    lattice_.depth_m.assign(kViewWidth * kViewHeight, kWall_m);
  }

  /// A flat head and shoulders, `right_m` and `down_m` of the optical axis.
  Picture& draw_person(float right_m, float depth_m, float down_m = 0.0F, float trunk_m = 0.63F) {
    for_each_pixel([&](float x, float y, float& z) {
      const float right = x * depth_m - right_m, down = y * depth_m - down_m;
      const bool head = std::hypot(right / 0.08F, down / 0.12F) < 1.0F;
      const bool trunk = std::abs(right) < 0.22F && down > 0.17F && down < 0.17F + trunk_m;
      if (head || trunk) z = std::min(z, depth_m);
    });
    return *this;
  }
  /// A board that ends at `right_m` and hides what lies left of it.
  Picture& draw_board(float right_m, float depth_m) {
    for_each_pixel([&](float x, float, float& z) {
      if (x * depth_m < right_m) z = std::min(z, depth_m);
    });
    return *this;
  }
  Lattice lattice(const DepthNoise& noise = {}) const {
    Lattice lattice = lattice_;
    lattice.depth_noise = noise;
    for (int v = 0; v < kViewHeight; ++v) {
      for (int u = 0; u < kViewWidth; ++u)
        lattice.level_m.push_back(
            lattice.frame.to_level(ray(u, v) * lattice.depth_m[lattice.index(u, v)]));
    }
    return lattice;
  }

 private:
  static Eigen::Vector3f ray(int u, int v) {
    return {(static_cast<float>(u) + 0.5F - 0.5F * kViewWidth) / kViewFocal_px,
            (static_cast<float>(v) + 0.5F - 0.5F * kViewHeight) / kViewFocal_px, 1.0F};
  }
  template <class Draw>
  void for_each_pixel(const Draw& draw) {
    for (int v = 0; v < kViewHeight; ++v) {
      for (int u = 0; u < kViewWidth; ++u)
        draw(ray(u, v).x(), ray(u, v).y(), lattice_.depth_m[lattice_.index(u, v)]);
    }
  }

  Lattice lattice_;
};

bool finds_head_at(const Lattice& lattice, float right_m, float depth_m) {
  for (const HeadCandidate& head : find_heads(lattice, {})) {
    if ((head.surface_m - Eigen::Vector3f(right_m, depth_m, 0.0F)).norm() < 0.10F) return true;
  }
  return false;
}

TEST(HeadShape, FindsAHeadNearAndFar) {
  for (const float depth_m : {1.5F, 3.0F, 4.5F})
    EXPECT_TRUE(finds_head_at(Picture().draw_person(0.2F, depth_m).lattice(), 0.2F, depth_m))
        << depth_m << " m";
}

TEST(HeadShape, FindsNoneOnABareWall) { EXPECT_TRUE(find_heads(Picture().lattice(), {}).empty()); }

TEST(HeadShape, FindsAHeadOfWhichAThirdIsHiddenBySomethingNearer) {
  const Lattice lattice = Picture().draw_person(0.0F, 3.0F).draw_board(-0.018F, 2.0F).lattice();
  EXPECT_TRUE(finds_head_at(lattice, 0.0F, 3.0F));
}

TEST(HeadShape, FindsAHeadAmongManyThingsThatLookMoreLikeOne) {
  Picture picture;
  int things = 0;
  for (float down_m = -2.0F; down_m < 2.0F; down_m += 0.6F) {
    for (float right_m = -2.8F; right_m < 2.9F; right_m += 0.46F, ++things)
      picture.draw_person(right_m, 5.0F, down_m, 0.22F);
  }
  ASSERT_GT(things, 80);
  // Its shoulders are out of sight.
  EXPECT_TRUE(finds_head_at(picture.draw_person(0.2F, 4.0F, 0.0F, 0.0F).lattice(), 0.2F, 4.0F));
}

TEST(HeadShape, RefusesAHeadWhereTheSensorsNoiseIsLargerThanItsRelief) {
  const DepthNoise rough{0.0F, 0.01F};
  EXPECT_TRUE(finds_head_at(Picture().draw_person(0.0F, 2.0F).lattice(rough), 0.0F, 2.0F));
  EXPECT_FALSE(finds_head_at(Picture().draw_person(0.0F, 4.0F).lattice(rough), 0.0F, 4.0F));
}

/// Values of a patch's first grid at a column and a row: distance, and whether it was measured.
std::pair<float, float> fine_sample(const std::vector<float>& patch, int column, int row) {
  const float* sample = patch.data() + 2 * (row * kPatchGrids[0].columns + column);
  return {sample[0], sample[1]};
}

PatchPlace place_at(float u, float v, float depth_m) {
  PatchPlace place;
  place.u = u;
  place.v = v;
  place.depth_m = place.away_m = depth_m;
  return place;
}

TEST(HeadPatch, TellsDepthsAgainstTheHeadsOwn) {
  const Lattice lattice = Picture().draw_person(0.0F, 2.0F).lattice();
  const std::vector<float> patch = sample_patch(lattice, place_at(160, 120, 2.0F));
  ASSERT_EQ(patch.size(), static_cast<std::size_t>(kPatchSize));
  const int middle = kPatchGrids[0].columns / 2, row = kPatchGrids[0].rows / 2;
  EXPECT_EQ(fine_sample(patch, middle, row), std::make_pair(0.0F, 1.0F));
  EXPECT_EQ(fine_sample(patch, 0, row), std::make_pair(1.0F, 1.0F)) << "the wall, far behind";
}

TEST(HeadPatch, TellsHolesFromWhatLiesOutsideTheImage) {
  Lattice lattice = Picture().draw_person(0.0F, 2.0F).lattice();
  lattice.depth_m[lattice.index(1, 120)] = 0.0F;
  const std::vector<float> patch = sample_patch(lattice, place_at(1, 120, 2.0F));
  const int middle = kPatchGrids[0].columns / 2, row = kPatchGrids[0].rows / 2;
  EXPECT_EQ(fine_sample(patch, middle, row), std::make_pair(0.0F, 0.0F));
  EXPECT_EQ(fine_sample(patch, 0, row), std::make_pair(0.0F, -1.0F));
}

/// What a camera that is pitched up sees of an upright wall.
Lattice wall_from_below(float up_rad, float away_m) {
  Lattice lattice = Picture().lattice();
  const Eigen::Matrix3f level_from_level_camera = lattice.frame.level_from_sensor;
  lattice.frame.level_from_sensor =
      Eigen::AngleAxisf(up_rad, Eigen::Vector3f::UnitX()) * level_from_level_camera;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Eigen::Vector3f ray =
        level_from_level_camera.transpose() * lattice.level_m[i] / lattice.depth_m[i];
    lattice.depth_m[i] = away_m / lattice.frame.to_level(ray).y();
    lattice.level_m[i] = lattice.frame.to_level(lattice.depth_m[i] * ray);
  }
  return lattice;
}

TEST(HeadPatch, TellsAnUprightWallAsFlatHoweverTheCameraIsPitched) {
  const Lattice lattice = wall_from_below(radians(20.0F), 2.0F);
  const auto middle = static_cast<std::uint32_t>(lattice.index(160, 120));
  const std::vector<float> patch = sample_patch(lattice, place_of_point(lattice, middle, false));
  for (int row = 0; row < kPatchGrids[0].rows; ++row) {
    const auto [farther, measured] = fine_sample(patch, kPatchGrids[0].columns / 2, row);
    EXPECT_EQ(measured, 1.0F);
    EXPECT_NEAR(farther, 0.0F, 1e-4F);
  }
}

TEST(HeadPatch, SwapsTheSidesOfAMirroredPlace) {
  const Lattice lattice = Picture().draw_person(0.0F, 2.0F).draw_board(-0.05F, 1.5F).lattice();
  PatchPlace place = place_at(160, 120, 2.0F);
  const std::vector<float> straight = sample_patch(lattice, place);
  place.mirrored = true;
  const std::vector<float> mirrored = sample_patch(lattice, place);
  const int last = kPatchGrids[0].columns - 1, row = kPatchGrids[0].rows / 2;
  EXPECT_NE(fine_sample(straight, 0, row), fine_sample(straight, last, row));
  EXPECT_EQ(fine_sample(straight, 0, row), fine_sample(mirrored, last, row));
}

TEST(HeadClassifier, DoubtsACornerOfTheWall) {
  const Lattice lattice = Picture().lattice();
  HeadCandidate candidate;
  candidate.u = 20;
  candidate.v = 20;
  candidate.surface_m = lattice.level_m[lattice.index(20, 20)];
  candidate.center_m = head_center(lattice, candidate.surface_m);
  EXPECT_LT(HeadClassifier().head_odds(lattice, candidate), ClassifierParams{}.min_head_odds);
}

}  // namespace
}  // namespace limbcast::segmenter
