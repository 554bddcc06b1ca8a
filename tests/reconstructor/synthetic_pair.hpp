#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
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

}  // namespace limbcast::test
