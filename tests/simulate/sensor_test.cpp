#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "common/units.hpp"
#include "modules/simulate/depth_sensor.hpp"
#include "modules/simulate/laser.hpp"

namespace limbcast::simulate {
namespace {

const PinholeCamera kCamera{320, 240, 260.0, 260.0, 159.5, 119.5};

cv::Mat wall(float depth_m) { return {kCamera.height, kCamera.width, CV_32F, cv::Scalar(depth_m)}; }

/// A wall at 4 m with a board of 100 columns at 2 m before it.
cv::Mat board_before_wall() {
  cv::Mat depth = wall(4.0F);
  depth.colRange(120, 220).setTo(2.0F);
  return depth;
}

double deviation(const cv::Mat& values, const cv::Mat& mask) {
  cv::Scalar mean;
  cv::Scalar sigma;
  cv::meanStdDev(values, mean, sigma, mask);
  return sigma[0];
}

TEST(SmoothNoise, HasUnitDeviationAndIsAlikeOverItsPatch) {
  Rng rng(1);

  const cv::Mat noise = smooth_noise(200, 200, 2.0, rng);

  EXPECT_NEAR(deviation(noise, {}), 1.0, 1e-3);
  const auto likeness = [&](int shift) {
    return cv::mean(noise.colRange(0, 200 - shift).mul(noise.colRange(shift, 200)))[0];
  };
  // White noise smoothed with sigma s is alike over a shift d by exp(-d^2 / (4 s^2)).
  EXPECT_NEAR(likeness(2), std::exp(-4.0 / 16.0), 0.05);
  EXPECT_NEAR(likeness(12), 0.0, 0.1);
}

TEST(StereoSensor, NoiseOfTheDisparityIsAsAsked) {
  StereoSensorParams params;
  params.weak_texture = 1.0;
  params.hole_share = params.blunder_share = 0.0;
  const double fb = kCamera.fx * params.baseline_m;

  const cv::Mat sensed = sense_stereo(wall(3.0F), kCamera, params, Rng(2));

  const cv::Mat disparity = fb / sensed;
  EXPECT_NEAR(deviation(disparity, sensed > 0.0F), params.sigma_px, 0.05 * params.sigma_px);
  EXPECT_GT(cv::countNonZero(sensed), 0.97 * sensed.total());
}

TEST(StereoSensor, MakesHolesWhereTheRightCameraDoesNotSee) {
  StereoSensorParams params;
  params.fattening_px = 0.0;
  params.hole_share = params.blunder_share = params.occlusion_filled = 0.0;
  const double fb = kCamera.fx * params.baseline_m;

  const cv::Mat sensed = sense_stereo(board_before_wall(), kCamera, params, Rng(3));

  // Left of the board's edge, as wide as the disparities differ: fb / 2 - fb / 4 = 7.8 px.
  const cv::Mat shadow = sensed.colRange(120 - static_cast<int>(fb / 4.0) + 1, 119);
  EXPECT_LT(cv::countNonZero(shadow), 0.02 * shadow.total());
  EXPECT_GT(cv::countNonZero(sensed.colRange(222, 300)), 0.98 * 78 * kCamera.height);
}

TEST(StereoSensor, FattensWhatIsInFront) {
  StereoSensorParams params;
  params.fattening_px = 4.0;
  params.hole_share = params.blunder_share = 0.0;

  const cv::Mat sensed = sense_stereo(board_before_wall(), kCamera, params, Rng(4));

  const auto share_in_front = [&](int column) {
    return cv::countNonZero(sensed.col(column) < 3.0F) / 240.0;
  };
  EXPECT_GT(share_in_front(220), 0.5);
  EXPECT_LT(share_in_front(226), 0.02);
}

TEST(StereoSensor, SeesNothingNearerThanItsSearchRange) {
  StereoSensorParams params;
  params.disparities = 16;

  const cv::Mat sensed = sense_stereo(wall(1.0F), kCamera, params, Rng(5));  // 31 px

  EXPECT_LT(cv::countNonZero(sensed), 0.01 * sensed.total());
}

TEST(DepthSensor, NoiseGrowsWithTheDistanceAsPublished) {
  DepthSensorParams params;
  params.step_px = params.flying_share = params.speckle_share = 0.0;
  const cv::Mat facing = wall(1.0F);
  for (const float depth : {1.0F, 3.0F, 5.0F}) {
    const cv::Mat sensed = sense_depth(wall(depth), facing, kCamera, params, Rng(6));
    const double expected = 0.0012 + 0.0019 * (depth - 0.4) * (depth - 0.4);
    EXPECT_NEAR(deviation(sensed, sensed > 0.0F), expected, 0.05 * expected);
  }
}

TEST(DepthSensor, PutsSomePixelsBetweenFrontAndBack) {
  DepthSensorParams params;
  params.flying_share = 0.5;

  const cv::Mat sensed = sense_depth(board_before_wall(), wall(1.0F), kCamera, params, Rng(7));

  cv::Mat between;
  cv::inRange(sensed, 2.2, 3.8, between);
  EXPECT_GT(cv::countNonZero(between), 50);
  EXPECT_EQ(cv::countNonZero(between.colRange(0, 100)), 0);
}

TEST(DepthSensor, SeesNothingBeyondItsRangeOrAlongASurface) {
  DepthSensorParams params;

  EXPECT_EQ(cv::countNonZero(sense_depth(wall(7.0F), wall(1.0F), kCamera, params, Rng(8))), 0);
  EXPECT_EQ(cv::countNonZero(sense_depth(wall(2.0F), wall(0.01F), kCamera, params, Rng(8))), 0);
}

constexpr int kRings = 16, kReturns = 201;

LaserParams over_the_wall() {
  LaserParams params;
  params.rings = kRings;
  params.lost_share = 0.0;
  params.min_azimuth_deg = -20.0;
  params.max_azimuth_deg = 20.0;
  params.min_elevation_deg = -10.0;
  params.max_elevation_deg = 10.0;
  return params;
}

/// By how much each point's range before a wall 4 m away is wrong [m], ring after ring.
std::vector<double> range_errors_m(const LaserParams& params) {
  World world;
  Solid solid;
  solid.half_m = {50.0F, 50.0F, 0.1F};
  solid.frame_from_solid.translation() = Eigen::Vector3f(0, 0, 4.1F);
  world.solids.push_back(solid);
  std::vector<double> errors_m;
  for (const Eigen::Vector3f& point : scan(world, params, Rng(9)).points_m)
    errors_m.push_back((point.z() - 4.0) * point.norm() / point.z());
  if (errors_m.size() != std::size_t{kRings} * kReturns)
    throw std::runtime_error("returns are missing");
  return errors_m;
}

/// Without other noise.
LaserParams with_rings_off(double range_sigma_m, double azimuth_sigma_deg) {
  LaserParams params = over_the_wall();
  params.range_sigma_m = 0.0;
  params.ring_range_sigma_m = range_sigma_m;
  params.ring_azimuth_sigma_deg = azimuth_sigma_deg;
  return params;
}

double root_mean_square(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST(Laser, MeasuresAWallWithItsNoise) {
  const LaserParams params = over_the_wall();

  EXPECT_NEAR(root_mean_square(range_errors_m(params)), params.range_sigma_m, 0.001);
}

TEST(Laser, ARingsRangesAreOffTogether) {
  const LaserParams params = with_rings_off(0.03, 0.0);

  const std::vector<double> errors_m = range_errors_m(params);

  std::vector<double> of_rings_m;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    if (i % kReturns == 0) of_rings_m.push_back(errors_m[i]);
    EXPECT_NEAR(errors_m[i], of_rings_m.back(), 0.001);
  }
  EXPECT_NEAR(root_mean_square(of_rings_m), params.ring_range_sigma_m, 0.015);
}

TEST(Laser, ARingsAzimuthsAreOffTogether) {
  const LaserParams params = with_rings_off(0.0, 1.0);

  const std::vector<double> errors_m = range_errors_m(params);

  // A ray that goes by its azimuth's error e to the right of where it is told to meets a wall 4 m
  // away by 4 m tan(azimuth) e farther away (cos(elevation) = 1 nearly).
  std::vector<double> of_rings_deg;
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    const double right_m = errors_m[ring * kReturns + kReturns - 1],
                 left_m = errors_m[ring * kReturns];
    const double slope_m = 2.0 * 4.0 * std::tan(radians(20.0)) / std::cos(radians(20.0));
    of_rings_deg.push_back((right_m - left_m) / slope_m * kDegreesPerRadian<double>);
  }
  EXPECT_NEAR(root_mean_square(of_rings_deg), params.ring_azimuth_sigma_deg, 0.5);
}

TEST(Laser, KeepsItsGridWhereItIsOrganised) {
  LaserParams params;
  params.rings = 8;
  params.organised = true;

  const LaserScan result = scan(World{}, params, Rng(10));

  EXPECT_EQ(result.width, 901);
  EXPECT_EQ(result.height, 8);
  EXPECT_TRUE(std::isnan(result.points_m.front().x()));
}

}  // namespace
}  // namespace limbcast::simulate
