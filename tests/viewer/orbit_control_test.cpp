#include "modules/viewer/orbit_control.hpp"

#include <gtest/gtest.h>

namespace limbcast::viewer {
namespace {

TEST(OrbitControl, GoesWhereItIsTold) {
  OrbitControl control({60.0F, 10.0F});
  control.apply(Look::kRight);
  EXPECT_GT(control.orbit().azimuth_deg, 60.0F);
  control.apply(Look::kLeft);
  EXPECT_FLOAT_EQ(control.orbit().azimuth_deg, 60.0F);
  control.apply(Look::kUp);
  EXPECT_GT(control.orbit().elevation_deg, 10.0F);
  control.apply(Look::kDown);
  EXPECT_FLOAT_EQ(control.orbit().elevation_deg, 10.0F);
  control.apply(Look::kNearer);
  EXPECT_GT(control.orbit().zoom, 1.0F);
  control.apply(Look::kFarther);
  EXPECT_FLOAT_EQ(control.orbit().zoom, 1.0F);
}

TEST(OrbitControl, TurnsWhatIsNearWithTheMouse) {
  OrbitControl control({0.0F, 0.0F});
  // What is near goes to the right and down when the eye goes to the left and up.
  control.drag(0.125F, 0.25F);
  EXPECT_FLOAT_EQ(control.orbit().azimuth_deg, -45.0F);
  EXPECT_FLOAT_EQ(control.orbit().elevation_deg, 45.0F);
}

TEST(OrbitControl, GoesNearerByNotchesOfTheWheelAndPartsOfThem) {
  OrbitControl control({}), pressed({});
  pressed.apply(Look::kNearer);
  control.turn_wheel(0.5F);
  control.turn_wheel(0.5F);
  EXPECT_FLOAT_EQ(control.orbit().zoom, pressed.orbit().zoom);
  control.turn_wheel(-1.0F);
  EXPECT_FLOAT_EQ(control.orbit().zoom, 1.0F);
  control.turn_wheel(99.0F);
  EXPECT_FLOAT_EQ(control.orbit().zoom, kMaxZoom);
}

TEST(OrbitControl, GoesRoundAndRoundButNotOverTheTop) {
  OrbitControl control({0.0F, 0.0F});
  control.drag(-0.75F, 5.0F);
  EXPECT_FLOAT_EQ(control.orbit().azimuth_deg, -90.0F);
  EXPECT_FLOAT_EQ(control.orbit().elevation_deg, 90.0F);
  control.drag(0.0F, -9.0F);
  EXPECT_FLOAT_EQ(control.orbit().elevation_deg, -90.0F);
}

TEST(OrbitControl, GoesNeitherIntoThePeopleNorOutOfSight) {
  OrbitControl control({});
  for (int i = 0; i < 99; ++i) control.apply(Look::kNearer);
  EXPECT_FLOAT_EQ(control.orbit().zoom, kMaxZoom);
  for (int i = 0; i < 99; ++i) control.apply(Look::kFarther);
  EXPECT_FLOAT_EQ(control.orbit().zoom, kMinZoom);
}

TEST(OrbitControl, GoesBackToWhereItStarted) {
  OrbitControl control({10.0F, 20.0F, 2.0F});
  control.drag(0.3F, 0.1F);
  control.apply(Look::kNearer);
  control.apply(Look::kAsAtStart);
  EXPECT_FLOAT_EQ(control.orbit().azimuth_deg, 10.0F);
  EXPECT_FLOAT_EQ(control.orbit().elevation_deg, 20.0F);
  EXPECT_FLOAT_EQ(control.orbit().zoom, 2.0F);
}

}  // namespace
}  // namespace limbcast::viewer
