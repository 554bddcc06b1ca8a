#include "modules/calibrate/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "common/formatted.hpp"
#include "common/joined.hpp"
#include "modules/calibrate/verdict.hpp"

namespace limbcast::calibrate {
namespace {

constexpr int kRegions = 3;  // in a row and in a column
constexpr std::array<const char*, kRegions* kRegions> kRegionNames = {
    "top left", "top",         "top right", "left",        "middle",
    "right",    "bottom left", "bottom",    "bottom right"};

/// Names of the regions of the image where no board was.
std::vector<std::string> empty_regions(const cv::Mat& covered, double min_share) {
  std::vector<std::string> names;
  for (int i = 0; i < kRegions * kRegions; ++i) {
    const int left = covered.cols * (i % kRegions) / kRegions;
    const int right = covered.cols * (i % kRegions + 1) / kRegions;
    const int top = covered.rows * (i / kRegions) / kRegions;
    const int bottom = covered.rows * (i / kRegions + 1) / kRegions;
    if (share_of(covered({left, top, right - left, bottom - top})) < min_share)
      names.emplace_back(kRegionNames[i]);
  }
  return names;
}

int count_views(const std::vector<ViewFit>& figures,
                const std::function<bool(const ViewFit&)>& is) {
  return static_cast<int>(std::count_if(figures.begin(), figures.end(), is));
}

void advise_tilt(const std::vector<ViewFit>& figures, const AdviceParams& params,
                 std::vector<std::string>& advice) {
  const int sideways = count_views(figures, [&](const ViewFit& view) {
    return std::abs(view.tilt_sideways_deg) >= params.tilt_deg;
  });
  const int updown = count_views(figures, [&](const ViewFit& view) {
    return std::abs(view.tilt_updown_deg) >= params.tilt_deg;
  });
  if (sideways < params.tilted_views)
    advice.push_back(
        formatted("turn the board left and right by 20 to 45 degrees (%d of %zu views are)",
                  sideways, figures.size()));
  if (updown < params.tilted_views)
    advice.push_back(
        formatted("tip the board up and down by 20 to 45 degrees (%d of %zu views are)", updown,
                  figures.size()));
}

void advise_distance(const std::vector<ViewFit>& figures, const AdviceParams& params,
                     std::vector<std::string>& advice) {
  const auto [nearest, farthest] = std::minmax_element(
      figures.begin(), figures.end(),
      [](const ViewFit& a, const ViewFit& b) { return a.distance_m < b.distance_m; });
  if (farthest->distance_m >= params.distance_ratio * nearest->distance_m) return;
  advice.push_back(formatted("hold the board nearer and farther: all stood at %.2f to %.2f m",
                             nearest->distance_m, farthest->distance_m));
}

}  // namespace

cv::Mat covered_area(const std::vector<View>& views, Side side, const cv::Size& image_size) {
  cv::Mat covered(image_size, CV_8UC1, cv::Scalar(0));
  for (const View& view : views) {
    const BoardPoints& points = side == Side::kLeft ? view.left : view.right;
    std::vector<cv::Point2f> hull;
    cv::convexHull(points.pixels, hull);
    const std::vector<cv::Point> corners(hull.begin(), hull.end());
    cv::fillConvexPoly(covered, corners, 255);
  }
  return covered;
}

double share_of(const cv::Mat& covered) {
  return cv::countNonZero(covered) / static_cast<double>(covered.total());
}

double least_coverage(const std::vector<View>& views, const cv::Size& image_size) {
  return std::min(share_of(covered_area(views, Side::kLeft, image_size)),
                  share_of(covered_area(views, Side::kRight, image_size)));
}

std::vector<std::string> advise_places(const std::vector<View>& views, const cv::Size& image_size,
                                       const AdviceParams& params) {
  std::vector<std::string> advice;
  for (const auto& [side, name] :
       {std::pair(Side::kLeft, "left"), std::pair(Side::kRight, "right")}) {
    const std::vector<std::string> empty =
        empty_regions(covered_area(views, side, image_size), params.min_region_share);
    if (!empty.empty())
      advice.push_back(formatted("show the board in these parts of the %s image: ", name) +
                       joined(empty));
  }
  return advice;
}

std::vector<std::string> advise(const StereoFit& fit, const cv::Size& image_size,
                                const AdviceParams& params) {
  std::vector<std::string> advice = advise_places(fit.views, image_size, params);
  advise_tilt(fit.figures, params, advice);
  advise_distance(fit.figures, params, advice);
  return advice;
}

bool complete(const std::vector<View>& views, const Board& board, const cv::Size& image_size,
              LensModel model, const CompletionParams& params) {
  const auto taken = static_cast<int>(views.size());
  if (taken >= params.most_views) return true;
  // What needs no fit comes first: a fit takes seconds.
  if (taken < params.enough_views || !advise_places(views, image_size).empty()) return false;
  const StereoFit fit = fit_stereo(views, board, image_size, model);
  return advise(fit, image_size).empty() &&
         judge(fit, least_coverage(fit.views, image_size)).faults.empty();
}

}  // namespace limbcast::calibrate
