#include "modules/reconstructor/census.hpp"

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "common/simd.hpp"

namespace limbcast::reconstructor {
namespace {

constexpr int kRadius = 3;
/// Differences in brightness up to this are taken for noise [grey levels], so that bare walls get
/// no random bits but the disparity of what is around: valid pixels beside people 66 -> 74 %.
constexpr int kNoise = 2;

/// Every other pixel of a window of 7 x 7: as good as all of one of 9 x 7
/// at a third of the time.
std::vector<cv::Point> neighbours() {
  std::vector<cv::Point> result;
  for (int y = -kRadius; y <= kRadius; ++y)
    for (int x = -kRadius; x <= kRadius; ++x)
      if ((x + y) % 2 == 0 && (x != 0 || y != 0)) result.emplace_back(x, y);
  return result;
}

LIMBCAST_SIMD void set_bit_where_above(const std::uint8_t* neighbour, const std::uint8_t* threshold,
                                       std::uint8_t bit, int count, std::uint8_t* plane) {
  for (int i = 0; i < count; ++i)
    plane[i] = static_cast<std::uint8_t>(plane[i] | (neighbour[i] > threshold[i] ? bit : 0));
}

}  // namespace

Census census_of(const cv::Mat1b& grey) {
  static const std::vector<cv::Point> kNeighbours = neighbours();
  CV_Assert(kNeighbours.size() == Census::kNumBits);
  const cv::Mat1b threshold = grey + kNoise;  // saturates
  cv::Mat1b padded;
  cv::copyMakeBorder(grey, padded, kRadius, kRadius, kRadius, kRadius, cv::BORDER_REPLICATE);
  Census census;
  for (cv::Mat1b& plane : census.planes) plane = cv::Mat1b(grey.size(), uchar{0});
  for (int v = 0; v < grey.rows; ++v) {
    for (std::size_t i = 0; i < kNeighbours.size(); ++i) {
      const cv::Point offset = kNeighbours[i];
      const std::uint8_t* neighbour = padded[v + kRadius + offset.y] + kRadius + offset.x;
      set_bit_where_above(neighbour, threshold[v], static_cast<std::uint8_t>(1U << (i % 8)),
                          grey.cols, census.planes.at(i / 8)[v]);
    }
  }
  return census;
}

}  // namespace limbcast::reconstructor
