#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "common/camera/calibration.hpp"
#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::test {

/// An ideal, rectified VGA pair: focal length 500 px, baseline 0.12 m.
inline StereoCalibration ideal_calibration() {
  StereoCalibration calibration;
  calibration.left.camera = {640, 480, 500.0, 500.0, 319.5, 239.5};
  calibration.right = calibration.left;
  calibration.T = {-0.12, 0.0, 0.0};
  return calibration;
}

/// A smooth random texture that can be looked up between pixels: sum of waves of 4 to 20 px.
class Texture {
 public:
  double operator()(double u, double v) const {
    double value = 128.0;
    for (const Wave& wave : waves_) value += 12.0 * std::sin(wave.u * u + wave.v * v + wave.phase);
    return std::min(255.0, std::max(0.0, value));
  }

 private:
  struct Wave {
    double u, v, phase;
  };
  static std::vector<Wave> make_waves() {
    std::vector<Wave> waves;
    std::uint32_t state = 1;
    const auto random = [&state] {
      state = state * 1664525U + 1013904223U;
      return (state >> 8) / 16777216.0;
    };
    for (int i = 0; i < 24; ++i) {
      const double angle = 2.0 * CV_PI * random();
      const double frequency = 2.0 * CV_PI / (4.0 + 16.0 * random());
      waves.push_back({frequency * std::cos(angle), frequency * std::sin(angle), 6.28 * random()});
    }
    return waves;
  }
  std::vector<Wave> waves_ = make_waves();
};

/// Pair that sees a textured surface whose disparity in the left image is `disparity(u, v)`; the
/// right image is the texture itself, so left(u, v) = texture(u - disparity(u, v), v) holds exactly
/// between pixels too.
inline reconstructor::RectifiedPair pair_of(const std::function<double(int, int)>& disparity,
                                            int width = 640, int height = 480) {
  const Texture texture;
  reconstructor::RectifiedPair pair{cv::Mat1b(height, width), cv::Mat1b(height, width)};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      pair.left.at<uchar>(v, u) = cv::saturate_cast<uchar>(texture(u - disparity(u, v), v));
      pair.right.at<uchar>(v, u) = cv::saturate_cast<uchar>(texture(u, v));
    }
  }
  return pair;
}

/// Grey noise with structure of all sizes, as scenes have it.
inline cv::Mat scene_texture() {
  cv::Mat1f sum(480, 640, 0.0F);
  cv::RNG random(7);
  for (const double size_px : {1.5, 5.0, 15.0, 40.0}) {
    cv::Mat1f noise(sum.size());
    random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(noise, noise, {}, size_px);
    sum += noise * (30.0 * size_px);
  }
  cv::Mat grey;
  sum.convertTo(grey, CV_8U, 1.0, 128.0);
  return grey;
}

/// The right camera turned by so many radians; nods and rolls are what bends a mount.
inline StereoCalibration turned(StereoCalibration calibration, double nod_rad, double roll_rad) {
  calibration.R = Eigen::AngleAxisd(nod_rad, Eigen::Vector3d::UnitX()) *
                  Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()) * calibration.R;
  calibration.rectification.reset();
  return calibration;
}

}  // namespace limbcast::test
