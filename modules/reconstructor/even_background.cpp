#include "modules/reconstructor/even_background.hpp"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace limbcast::reconstructor {
namespace {

/// Connected pixels that are even.
class EvenRegions {
 public:
  EvenRegions(const cv::Mat1b& grey, const cv::Mat1b& even) : grey_(grey) {
    cv::Mat statistics, centres;
    // Pixels that touch at corners alone are two regions': outlines may be one pixel wide.
    const int count = cv::connectedComponentsWithStats(even, names_, statistics, centres, 4);
    for (int i = 1; i < count; ++i) {
      const int* region = statistics.ptr<int>(i);
      boxes_.emplace_back(region[cv::CC_STAT_LEFT], region[cv::CC_STAT_TOP],
                          region[cv::CC_STAT_WIDTH], region[cv::CC_STAT_HEIGHT]);
      areas_px_.push_back(region[cv::CC_STAT_AREA]);
    }
    is_background_.resize(boxes_.size(), false);
  }

  void add_walls(double min_share) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const cv::Rect& box = boxes_[i];
      const bool reaches_border = box.x == 0 || box.y == 0 || box.br().x == names_.cols;
      const bool is_large = areas_px_[i] >= min_share * static_cast<double>(names_.total());
      is_background_[i] = reaches_border || is_large;
    }
  }

  void add_what_is_alike(const EvenBackgroundParams& params) {
    const cv::Mat1b background = this->background();
    const std::vector<double> brightness = this->brightness();
    const cv::Rect image({}, names_.size());
    const cv::Size around(2 * params.beside_px, 2 * params.beside_px);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (is_background_[i] || areas_px_[i] < params.min_alike_px) continue;
      const cv::Rect near =
          (boxes_[i] - cv::Point(params.beside_px, params.beside_px) + around) & image;
      if (cv::countNonZero(background(near)) < params.min_beside_px) continue;
      const double beside = cv::mean(grey_(near), background(near))[0];
      is_background_[i] = std::abs(brightness[i] - beside) <= params.max_difference;
    }
  }

  /// 255 there.
  cv::Mat1b background() const {
    cv::Mat1b result(names_.size(), std::uint8_t{0});
    for (int v = 0; v < names_.rows; ++v)
      for (int u = 0; u < names_.cols; ++u)
        if (const int name = names_(v, u); name > 0 && is_background_[region(name)])
          result(v, u) = 255;
    return result;
  }

 private:
  static std::size_t region(int name) { return static_cast<std::size_t>(name) - 1; }

  /// Of each region, on average [grey levels].
  std::vector<double> brightness() const {
    std::vector<double> result(boxes_.size(), 0.0);
    for (int v = 0; v < names_.rows; ++v)
      for (int u = 0; u < names_.cols; ++u)
        if (const int name = names_(v, u); name > 0) result[region(name)] += grey_(v, u);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] /= areas_px_[i];
    return result;
  }

  const cv::Mat1b& grey_;
  cv::Mat1i names_;  ///< 0: not even
  std::vector<cv::Rect> boxes_;
  std::vector<int> areas_px_;
  std::vector<bool> is_background_;
};

}  // namespace

cv::Mat1b even_background(const cv::Mat1b& grey, const Census& census,
                          const EvenBackgroundParams& params) {
  const cv::Mat1b even = (census.planes[0] | census.planes[1] | census.planes[2]) == 0;
  EvenRegions regions(grey, even);
  regions.add_walls(params.min_share);
  regions.add_what_is_alike(params);
  return regions.background();
}

}  // namespace limbcast::reconstructor
