#include "common/lcm_io/calibration_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/camera/rotation_check.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/plausible.hpp"

namespace limbcast::lcm_io {
namespace {

constexpr std::array<int, 6> kDistortionCounts = {0, 4, 5, 8, 12, 14};
constexpr double kLengthTolerance = 1e-3;  // of a unit vector

template <class Matrix>
void write_rows(const Matrix& matrix, double* out) {
  for (int row = 0; row < matrix.rows(); ++row)
    for (int column = 0; column < matrix.cols(); ++column) *out++ = matrix(row, column);
}

template <class Matrix>
Matrix read_rows(const double* in) {
  Matrix matrix;
  for (int row = 0; row < matrix.rows(); ++row)
    for (int column = 0; column < matrix.cols(); ++column) matrix(row, column) = *in++;
  require(matrix.allFinite(), "calibration: a number is not finite");
  return matrix;
}

Eigen::Matrix3d read_rotation(const double* in) {
  const auto matrix = read_rows<Eigen::Matrix3d>(in);
  require(deviation_from_rotation(matrix) <= kRotationTolerance, "calibration: a rotation is none");
  return matrix;
}

}  // namespace

lens_t to_message(const LensCalibration& lens) {
  lens_t message{};
  message.width = lens.camera.width;
  message.height = lens.camera.height;
  message.fx = lens.camera.fx;
  message.fy = lens.camera.fy;
  message.cx = lens.camera.cx;
  message.cy = lens.camera.cy;
  message.distortion = lens.distortion;
  if (lens.model == LensModel::kFisheye) message.distortion.resize(lens_t::NUM_FISHEYE, 0.0);
  message.num_distortion = static_cast<std::int32_t>(message.distortion.size());
  return message;
}

LensCalibration from_message(const lens_t& message) {
  require(message.width > 0 && message.height > 0 && message.width <= kMaxImageSide &&
              message.height <= kMaxImageSide,
          "calibration: image size is out of range");
  const PinholeCamera camera{message.width, message.height, message.fx,
                             message.fy,    message.cx,     message.cy};
  require(is_plausible(camera),
          "calibration: focal length or principal point is none of a robot's camera");
  const std::vector<double>& distortion = message.distortion;
  require(
      std::all_of(distortion.begin(), distortion.end(), [](double k) { return std::isfinite(k); }),
      "calibration: a distortion coefficient is not finite");
  if (distortion.size() == static_cast<std::size_t>(lens_t::NUM_FISHEYE)) {
    const auto known_end = distortion.begin() + kFisheyeCoefficients;
    require(std::all_of(known_end, distortion.end(), [](double k) { return k == 0.0; }),
            "calibration: k5 and k6 of a fisheye lens must be 0");
    return {camera, {distortion.begin(), known_end}, LensModel::kFisheye};
  }
  require(std::find(kDistortionCounts.begin(), kDistortionCounts.end(), message.num_distortion) !=
              kDistortionCounts.end(),
          "calibration: number of distortion coefficients is none of OpenCV's");
  return {camera, distortion};
}

mounting_t to_message(const Mounting& mounting) {
  mounting_t message{};
  message.has_down = mounting.down ? 1 : 0;
  if (mounting.down) write_rows(*mounting.down, message.down);
  message.sensor_height_m =
      mounting.sensor_height_m.value_or(std::numeric_limits<double>::quiet_NaN());
  return message;
}

Mounting from_message(const mounting_t& message) {
  Mounting mounting;
  if (message.has_down != 0) {
    mounting.down = read_rows<Eigen::Vector3d>(message.down);
    require(std::abs(mounting.down->norm() - 1.0) < kLengthTolerance,
            "mounting: 'down' is no unit vector");
  }
  require(!std::isinf(message.sensor_height_m), "mounting: 'sensor_height_m' is infinite");
  if (!std::isnan(message.sensor_height_m)) mounting.sensor_height_m = message.sensor_height_m;
  return mounting;
}

stereo_calibration_t to_message(const StereoCalibration& calibration, std::int64_t utime,
                                const std::string& sensor) {
  stereo_calibration_t message{};
  message.utime = utime;
  message.sensor = sensor;
  message.left = to_message(calibration.left);
  message.right = to_message(calibration.right);
  write_rows(calibration.R, message.R);
  write_rows(calibration.T, message.T);
  message.has_rectification = calibration.rectification ? 1 : 0;
  if (calibration.rectification) {
    write_rows(calibration.rectification->R1, message.R1);
    write_rows(calibration.rectification->R2, message.R2);
    write_rows(calibration.rectification->P1, message.P1);
    write_rows(calibration.rectification->P2, message.P2);
  }
  message.mounting = to_message(calibration.mounting);
  return message;
}

StereoCalibration from_message(const stereo_calibration_t& message) {
  StereoCalibration calibration;
  calibration.left = from_message(message.left);
  calibration.right = from_message(message.right);
  require(calibration.left.model == calibration.right.model,
          "calibration: one lens is a fisheye, the other is not");
  calibration.R = read_rotation(message.R);
  calibration.T = read_rows<Eigen::Vector3d>(message.T);
  if (message.has_rectification != 0) {
    using Projection = Eigen::Matrix<double, 3, 4>;
    calibration.rectification = {read_rotation(message.R1), read_rotation(message.R2),
                                 read_rows<Projection>(message.P1),
                                 read_rows<Projection>(message.P2)};
  }
  calibration.mounting = from_message(message.mounting);
  return calibration;
}

}  // namespace limbcast::lcm_io
