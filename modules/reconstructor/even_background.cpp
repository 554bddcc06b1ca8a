#include "modules/reconstructor/even_background.hpp"

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace limbcast::reconstructor {
namespace {

constexpr int kNotEven = 0;
constexpr std::uint8_t kBackground = 255;

/// Connected pixels that are even, by the names that cv::connectedComponents gives them.
class EvenRegions {
 public:
  EvenRegions(const cv::Mat1b& grey, const cv::Mat1b& even) : grey_(grey) {
    cv::Mat centres;
    // Pixels that touch at corners alone are two regions': outlines may be one pixel wide.
    const int count = cv::connectedComponentsWithStats(even, names_, statistics_, centres, 4);
    shows_.resize(static_cast<std::size_t>(count), 0);
  }

  void add_walls(double min_share) {
    for (int name = kNotEven + 1; name < count(); ++name) {
      const cv::Rect box = this->box(name);
      const bool reaches_border = box.x == 0 || box.y == 0 || box.br().x == names_.cols;
      const bool is_large = area_px(name) >= min_share * static_cast<double>(names_.total());
      if (reaches_border || is_large) shows_[name] = kBackground;
    }
  }

  void add_what_is_alike(const EvenBackgroundParams& params) {
    const cv::Mat1b background = this->background();
    const std::vector<std::int64_t> sums = sums_of_brightness();
    const cv::Rect image({}, names_.size());
    const cv::Size around(2 * params.beside_px, 2 * params.beside_px);
    for (int name = kNotEven + 1; name < count(); ++name) {
      if (shows_[name] == kBackground || area_px(name) < params.min_alike_px) continue;
      const cv::Rect near =
          (box(name) - cv::Point(params.beside_px, params.beside_px) + around) & image;
      if (cv::countNonZero(background(near)) < params.min_beside_px) continue;
      const double beside = cv::mean(grey_(near), background(near))[0];
      const double brightness =
          static_cast<double>(sums[name]) / static_cast<double>(area_px(name));
      if (std::abs(brightness - beside) <= params.max_difference) shows_[name] = kBackground;
    }
  }

  /// kBackground there, else 0.
  cv::Mat1b background() const {
    cv::Mat1b result(names_.size());
    for (int v = 0; v < names_.rows; ++v) {
      const int* names = names_[v];
      std::uint8_t* row = result[v];
      for (int u = 0; u < names_.cols; ++u) row[u] = shows_[names[u]];
    }
    return result;
  }

 private:
  int count() const { return static_cast<int>(shows_.size()); }
  int area_px(int name) const { return statistics_(name, cv::CC_STAT_AREA); }
  cv::Rect box(int name) const {
    const int* region = statistics_[name];
    return {region[cv::CC_STAT_LEFT], region[cv::CC_STAT_TOP], region[cv::CC_STAT_WIDTH],
            region[cv::CC_STAT_HEIGHT]};
  }

  /// Of each region's pixels [grey levels].
  std::vector<std::int64_t> sums_of_brightness() const {
    std::vector<std::int64_t> sums(shows_.size(), 0);
    for (int v = 0; v < names_.rows; ++v) {
      const int* names = names_[v];
      const std::uint8_t* grey = grey_[v];
      for (int u = 0; u < names_.cols; ++u) sums[names[u]] += grey[u];
    }
    return sums;
  }

  const cv::Mat1b& grey_;
  cv::Mat1i names_, statistics_;
  std::vector<std::uint8_t> shows_;  ///< by name: kBackground or 0
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
