#include "modules/reconstructor/image_noise.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace limbcast::reconstructor {
namespace {

/// Every so many rows are looked at.
constexpr int kRowStep = 4;
/// Share of the pixels that counts as dark.
constexpr double kDarkShare = 0.15;
/// The quarter of the differences that is lowest lies below so many of their standard deviations,
/// where they are noise alone.
constexpr double kLowShare = 0.25, kLowShareSigmas = 0.3186;
/// Standard deviation of a difference for each one of the noise: the root of the sum of the mask's
/// squares.
constexpr double kSigmasOfMask = 6.0;
/// Differences beyond are counted as this one.
constexpr int kMaxDifference = 127;

using Counts = std::array<std::int32_t, kMaxDifference + 1>;

/// How often each size of difference occurs at each brightness.
class Differences {
 public:
  explicit Differences(const cv::Mat1b& grey) : counts_(256) {
    for (int v = 1; v + 1 < grey.rows; v += kRowStep)
      count_row(grey[v - 1], grey[v], grey[v + 1], grey.cols);
  }

  /// Standard deviation of the noise of the darkest pixels, so large a share of all.
  double noise_of_darkest(double share) const {
    Counts sum{};
    std::int32_t pixels = 0;
    for (const Counts& at_brightness : counts_) {
      for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += at_brightness[i];
        pixels += at_brightness[i];
      }
      if (pixels >= share * num_pixels_) break;
    }
    return low_quantile(sum, pixels) / (kSigmasOfMask * kLowShareSigmas);
  }

 private:
  void count_row(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                 int width) {
    for (int u = 1; u + 1 < width; ++u) {
      const int corners = above[u - 1] + above[u + 1] + below[u - 1] + below[u + 1];
      const int sides = above[u] + here[u - 1] + here[u + 1] + below[u];
      const int difference = std::abs(corners - 2 * sides + 4 * here[u]);
      const int brightness = (corners + sides + here[u]) / 9;
      ++counts_[static_cast<std::size_t>(brightness)]
               [static_cast<std::size_t>(std::min(difference, kMaxDifference))];
    }
    num_pixels_ += std::max(0, width - 2);
  }

  /// Between whole differences: pixels of one lie evenly half a grey level to either side.
  static double low_quantile(const Counts& counts, std::int32_t pixels) {
    const double wanted = kLowShare * pixels;
    double below = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0 && below + counts[i] >= wanted)
        return std::max(0.0, static_cast<double>(i) - 0.5 + (wanted - below) / counts[i]);
      below += counts[i];
    }
    return 0.0;
  }

  std::vector<Counts> counts_;  ///< of each brightness
  std::int32_t num_pixels_ = 0;
};

}  // namespace

double noise_of(const cv::Mat1b& grey) {
  const Differences differences(grey);
  return std::max(differences.noise_of_darkest(1.0), differences.noise_of_darkest(kDarkShare));
}

QuietPair quieted(const cv::Mat1b& left, const cv::Mat1b& right, const ImageNoiseParams& params) {
  const double noise = std::max(noise_of(left), noise_of(right));
  if (noise <= params.max_noise) return {left, right};
  const double blur_px =
      std::min(params.blur_base_px + params.blur_rate_px * noise, params.max_blur_px);
  QuietPair quiet;
  cv::GaussianBlur(left, quiet.left, {0, 0}, blur_px);
  cv::GaussianBlur(right, quiet.right, {0, 0}, blur_px);
  return quiet;
}

}  // namespace limbcast::reconstructor
