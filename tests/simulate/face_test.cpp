#include "modules/simulate/face.hpp"

#include <gtest/gtest.h>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3f;

const Vector3f kSkinColor(120.0F, 150.0F, 200.0F), kBrowColor(20.0F, 30.0F, 40.0F);
/// Where the pupil, the brow, the mouth and the cheek of an own left half lie; x, y in statures.
constexpr float kPupil[] = {0.018F, -0.0065F}, kBrow[] = {0.0185F, 0.0066F},
                kMouth[] = {0.004F, -0.0438F}, kCheek[] = {0.028F, -0.030F};
constexpr float kFront = 0.05F, kFinePixel = 0.0003F;

Vector3f painted(const float (&place)[2], float z = kFront, float footprint = kFinePixel) {
  return face_color(kSkinColor, kBrowColor, {place[0], place[1], z}, footprint);
}

TEST(Face, HasPupilsBrowsAndAMouthDarkerThanItsSkin) {
  for (const auto& place : {kPupil, kBrow, kMouth})
    EXPECT_LT(face_color(kSkinColor, kBrowColor, {place[0], place[1], kFront}, kFinePixel).sum(),
              0.6F * kSkinColor.sum());
  EXPECT_EQ(painted(kCheek), kSkinColor);
}

TEST(Face, IsNotPaintedOnTheBackOfTheHead) { EXPECT_EQ(painted(kPupil, -kFront), kSkinColor); }

TEST(Face, IsTheSameOnBothHalves) {
  const float mirrored[] = {-kPupil[0], kPupil[1]};
  EXPECT_EQ(painted(mirrored), painted(kPupil));
}

TEST(Face, FadesWhereAPixelIsLargerThanTheMouth) {
  constexpr float kCoarsePixel = 0.012F;
  const float fine = painted(kMouth).sum();
  const float coarse = painted(kMouth, kFront, kCoarsePixel).sum();
  EXPECT_GT(coarse, 1.6F * fine);
  EXPECT_LT(coarse, kSkinColor.sum());
}

}  // namespace
}  // namespace limbcast::simulate
