#include "common/lcm_io/calibration_codec.hpp"

#include <gtest/gtest.h>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(CalibrationCodec, CarriesRectificationAndRejectsWhatIsNoRotation) {
  StereoCalibration calibration;
  calibration.left.camera = calibration.right.camera = {640, 480, 520.0, 521.0, 320.0, 240.0};
  calibration.left.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
  calibration.T = {-0.12, 0.0, 0.0};
  calibration.rectification = Rectification{};
  calibration.rectification->R1 = calibration.rectification->R2 = Eigen::Matrix3d::Identity();
  calibration.rectification->P1.setZero();
  calibration.rectification->P2.setConstant(2.0);
  calibration.mounting.down = Eigen::Vector3d(0.0, 1.0, 0.0);
  const stereo_calibration_t message = to_message(calibration, 7, "front");
  const StereoCalibration back = from_message(message);
  EXPECT_EQ(back.left.distortion, calibration.left.distortion);
  EXPECT_EQ(back.T, calibration.T);
  EXPECT_EQ(back.rectification->P2, calibration.rectification->P2);
  EXPECT_EQ(*back.mounting.down, *calibration.mounting.down);
  EXPECT_FALSE(back.mounting.sensor_height_m.has_value());

  stereo_calibration_t bad = message;
  bad.R[0] = 2.0;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = message;
  bad.left.fx = -1.0;
  EXPECT_THROW(from_message(bad), MessageError);
}

TEST(CalibrationCodec, CarriesFisheyeLensesByTheNumberOfTheirCoefficients) {
  StereoCalibration calibration;
  calibration.left = {
      {640, 480, 224.0, 225.0, 320.0, 240.0}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};
  calibration.right = calibration.left;
  calibration.right.distortion[3] = 0.0;
  const stereo_calibration_t message = to_message(calibration, 7, "front");
  EXPECT_EQ(message.left.num_distortion, lens_t::NUM_FISHEYE);
  EXPECT_EQ(message.left.distortion, (std::vector<double>{-0.01, 0.03, -0.02, 0.004, 0.0, 0.0}));
  const StereoCalibration back = from_message(message);
  EXPECT_EQ(back.left.model, LensModel::kFisheye);
  EXPECT_EQ(back.left.distortion, calibration.left.distortion);
  EXPECT_EQ(back.right.distortion, calibration.right.distortion);

  calibration.left.model = LensModel::kPinhole;
  EXPECT_EQ(from_message(to_message(calibration.left)).model, LensModel::kPinhole);
}

}  // namespace
}  // namespace limbcast::lcm_io
