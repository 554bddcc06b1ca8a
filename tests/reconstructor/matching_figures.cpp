#include "tests/reconstructor/matching_figures.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace limbcast::test {
namespace {

constexpr float kSameSurfacePx = 1.5F;

double median(std::vector<float> values) {
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_of_absolute(const std::vector<float>& values, double center) {
  std::vector<float> absolute(values.size());
  std::transform(values.begin(), values.end(), absolute.begin(),
                 [&](float value) { return std::abs(value - static_cast<float>(center)); });
  return median(std::move(absolute));
}

double share(long part, long whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : std::nan("");
}

cv::Mat disc(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

}  // namespace

void MatchingFigures::add(const cv::Mat1f& disparity_px, const TrueFrame& frame) {
  const cv::Mat1b people = frame.person > 0;
  if (cv::countNonZero(people) == 0) return;
  add_inside(disparity_px, frame, people);
  add_silhouette(disparity_px, frame, people);
}

void MatchingFigures::add_inside(const cv::Mat1f& disparity_px, const TrueFrame& frame,
                                 const cv::Mat1b& people) {
  cv::Mat1b inside, thick, thin;
  cv::erode(people, inside, disc(4), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(people, thick, cv::MORPH_OPEN, disc(8));
  cv::subtract(people, thick, thin);
  cv::Mat1f window_sum(people.size(), 0.0F), window_count(people.size(), 0.0F);
  for (int v = 0; v < people.rows; ++v) {
    for (int u = 0; u < people.cols; ++u) {
      if (!people(v, u)) continue;
      const float truth = frame.disparity_px(v, u), found = disparity_px(v, u);
      const float error = found - truth;
      const bool is_valid = found > 0.0F, is_good = is_valid && std::abs(error) <= kSameSurfacePx;
      ++pixels_;
      valid_ += is_valid;
      bad_ += is_valid && std::abs(error) > 2.0F;
      good_ += is_good;
      thin_ += thin(v, u) > 0;
      thin_good_ += thin(v, u) > 0 && is_good;
      if (!inside(v, u) || !is_valid || std::abs(error) > 2.0F) continue;
      errors_px_.push_back(error);
      const float fraction = truth - std::floor(truth);
      errors_by_fraction_px_.at(static_cast<std::size_t>(fraction * 16.0F)).push_back(error);
      window_sum(v, u) = error;
      window_count(v, u) = 1.0F;
    }
  }
  cv::boxFilter(window_sum, window_sum, -1, {15, 15}, {-1, -1}, false);
  cv::boxFilter(window_count, window_count, -1, {15, 15}, {-1, -1}, false);
  for (int v = 7; v < people.rows; v += 15)
    for (int u = 7; u < people.cols; u += 15)
      if (window_count(v, u) > 110.0F)
        window_errors_px_.push_back(window_sum(v, u) / window_count(v, u));
}

void MatchingFigures::add_silhouette(const cv::Mat1f& disparity_px, const TrueFrame& frame,
                                     const cv::Mat1b& people) {
  constexpr float kBandPx = 20.0F;
  const cv::Mat1b background = people == 0;
  cv::Mat1f distance;
  cv::Mat1i nearest;
  cv::distanceTransform(background, distance, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<float> truth_of_label(people.total() + 1, 0.0F);
  for (int v = 0; v < people.rows; ++v)
    for (int u = 0; u < people.cols; ++u)
      if (people(v, u)) truth_of_label[nearest(v, u)] = frame.disparity_px(v, u);
  for (int v = 0; v < people.rows; ++v) {
    for (int u = 0; u < people.cols; ++u) {
      const float found = disparity_px(v, u);
      if (people(v, u) || found <= 0.0F || distance(v, u) > kBandPx) continue;
      const bool is_right = std::abs(found - frame.disparity_px(v, u)) <= kSameSurfacePx;
      const bool is_at_person = std::abs(found - truth_of_label[nearest(v, u)]) <= kSameSurfacePx;
      fat_ += !is_right && is_at_person;
    }
  }
}

double MatchingFigures::valid_share() const { return share(valid_, pixels_); }
double MatchingFigures::bad_share() const { return share(bad_, valid_); }
double MatchingFigures::median_error_px() const { return median_of_absolute(errors_px_, 0.0); }
double MatchingFigures::mad_px() const {
  return median_of_absolute(errors_px_, median(errors_px_));
}
double MatchingFigures::window_error_px() const {
  return 1.4826 * median_of_absolute(window_errors_px_, median(window_errors_px_));
}
double MatchingFigures::locking_px() const {
  double low = 1e9, high = -1e9;
  for (const auto& errors : errors_by_fraction_px_) {
    const double bias = median(errors);
    low = std::min(low, bias);
    high = std::max(high, bias);
  }
  return high - low;
}
double MatchingFigures::precision() const { return share(good_, good_ + fat_); }
double MatchingFigures::recall() const { return share(good_, pixels_); }
double MatchingFigures::thin_recall() const { return share(thin_good_, thin_); }

}  // namespace limbcast::test
