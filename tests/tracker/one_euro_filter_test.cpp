#include "modules/tracker/one_euro_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limbcast::tracker {
namespace {

using Eigen::Vector3f;

constexpr double kFrame_s = 0.1;

TEST(OneEuroFilter, HalvesTheNoiseOfAValueAtRest) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise_m(0.0F, 0.01F);
  OneEuroFilter filter({});
  filter.restart(Vector3f::Zero());
  double sum_in = 0.0, sum_out = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vector3f measured(noise_m(random), noise_m(random), noise_m(random));
    filter.update(measured, kFrame_s);
    if (i < 10) continue;
    sum_in += measured.squaredNorm();
    sum_out += filter.value().squaredNorm();
  }
  EXPECT_LT(std::sqrt(sum_out / sum_in), 0.5);
}

TEST(OneEuroFilter, LagsLessThanAFrameBehindSteadyMotion) {
  OneEuroFilter filter({});
  filter.restart(Vector3f::Zero());
  constexpr float kStep_m = 0.1F;  // 1 m/s
  for (int i = 1; i <= 20; ++i)
    filter.update({kStep_m * static_cast<float>(i), 0.0F, 0.0F}, kFrame_s);
  EXPECT_GT(filter.value().x(), 20 * kStep_m - 0.5F * kStep_m);
}

TEST(OneEuroFilter, FollowsMotionThatIsSlowerThanNoise) {
  OneEuroFilter filter({});
  filter.restart(Vector3f::Zero());
  constexpr float kStep_m = 0.01F;  // 0.1 m/s
  for (int i = 1; i <= 50; ++i)
    filter.update({kStep_m * static_cast<float>(i), 0.0F, 0.0F}, kFrame_s);
  EXPECT_NEAR(filter.value().x(), 50 * kStep_m, 0.03F);
}

TEST(OneEuroFilter, IsTheMeanOfItsFirstSamplesAtRest) {
  OneEuroFilter filter({});
  filter.restart({0.000F, 0.0F, 0.0F});
  filter.update({0.003F, 0.0F, 0.0F}, kFrame_s);
  filter.update({0.006F, 0.0F, 0.0F}, kFrame_s);
  EXPECT_NEAR(filter.value().x(), 0.003F, 1e-6F);
}

/// A filter at rest at zero.
OneEuroFilter resting_filter() {
  OneEuroFilter filter({});
  filter.restart(Vector3f::Zero());
  for (int i = 0; i < 10; ++i) filter.update(Vector3f::Zero(), kFrame_s);
  return filter;
}

TEST(OneEuroFilter, IsNotMovedByOneSampleThatIsWrongAtRest) {
  OneEuroFilter filter = resting_filter();
  filter.update({0.02F, 0.0F, -0.02F}, kFrame_s);
  EXPECT_EQ(filter.value(), Vector3f::Zero());
  filter.update(Vector3f::Zero(), kFrame_s);
  EXPECT_EQ(filter.value(), Vector3f::Zero());
}

TEST(OneEuroFilter, FollowsAMotionOutOfRestFromItsSecondSampleOn) {
  OneEuroFilter filter = resting_filter();
  constexpr float kStep_m = 0.1F;  // 1 m/s
  filter.update({kStep_m, 0.0F, 0.0F}, kFrame_s);
  EXPECT_GE(filter.value().x(), 0.0F);
  for (int i = 2; i < 6; ++i) {
    filter.update({kStep_m * static_cast<float>(i), 0.0F, 0.0F}, kFrame_s);
    EXPECT_NEAR(filter.value().x(), kStep_m * static_cast<float>(i), 0.2F * kStep_m) << i;
  }
}

TEST(OneEuroFilter, FollowsASlowMotionOutOfRestFromItsSecondSampleOn) {
  OneEuroFilter filter = resting_filter();
  constexpr float kStep_m = 0.04F;  // 0.4 m/s
  filter.update({kStep_m, 0.0F, 0.0F}, kFrame_s);
  for (int i = 2; i < 6; ++i) {
    filter.update({kStep_m * static_cast<float>(i), 0.0F, 0.0F}, kFrame_s);
    EXPECT_NEAR(filter.value().x(), kStep_m * static_cast<float>(i), 0.5F * kStep_m) << i;
  }
}

TEST(OneEuroFilter, PredictsAlongItsSpeedAndComesToRest) {
  OneEuroFilter filter({});
  filter.restart(Vector3f::Zero());
  constexpr int kUntilSpeedIsKnown = 100;
  for (int i = 1; i <= kUntilSpeedIsKnown; ++i)
    filter.update({0.1F * static_cast<float>(i), 0.0F, 0.0F}, kFrame_s);  // 1 m/s
  constexpr double kDecay_s = 0.2;
  const float begin = filter.value().x();
  float last = begin;
  for (int i = 0; i < 50; ++i) {
    filter.predict(kFrame_s, kDecay_s);
    EXPECT_GE(filter.value().x(), last);
    last = filter.value().x();
  }
  // Sum of 0.1 s * exp(-n / 2), n = 1, 2 ...
  EXPECT_NEAR(last - begin, 0.1 / (std::exp(0.5) - 1.0), 1e-3);
}

}  // namespace
}  // namespace limbcast::tracker
