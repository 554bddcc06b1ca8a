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

const cv::Mat& of(const SeenAreas& seen, Side side) {
  return side == Side::kLeft ? seen.left : seen.right;
}

/// Of the pixels that the lens sees.
double share_of(const cv::Mat& covered, const cv::Mat& seen) {
  return cv::countNonZero(covered & seen) / static_cast<double>(cv::countNonZero(seen));
}

/// Names of the regions of what the lens sees where no board was.
std::vector<std::string> empty_regions(const cv::Mat& covered, const cv::Mat& seen,
                                       double min_share) {
  const cv::Rect all = cv::boundingRect(seen);
  std::vector<std::string> names;
  for (int i = 0; i < kRegions * kRegions; ++i) {
    const cv::Point begin(all.x + all.width * (i % kRegions) / kRegions,
                          all.y + all.height * (i / kRegions) / kRegions);
    const cv::Point end(all.x + all.width * (i % kRegions + 1) / kRegions,
                        all.y + all.height * (i / kRegions + 1) / kRegions);
    const cv::Rect region(begin, end);
    // Boards have straight sides and must be whole in both images: of a region that the image
    // circle cuts they reach the less, the less of it there is.
    const double lit_share = cv::countNonZero(seen(region)) / static_cast<double>(region.area());
    if (share_of(covered(region), seen(region)) < min_share * lit_share)
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

double coverage(const std::vector<View>& views, Side side, const SeenAreas& seen) {
  const cv::Mat& area = of(seen, side);
  return share_of(covered_area(views, side, area.size()), area);
}

double least_coverage(const std::vector<View>& views, const SeenAreas& seen) {
  return std::min(coverage(views, Side::kLeft, seen), coverage(views, Side::kRight, seen));
}

std::vector<std::string> advise_places(const std::vector<View>& views, const SeenAreas& seen,
                                       const AdviceParams& params) {
  std::vector<std::string> advice;
  for (const auto& [side, name] :
       {std::pair(Side::kLeft, "left"), std::pair(Side::kRight, "right")}) {
    const std::vector<std::string> empty = empty_regions(
        covered_area(views, side, of(seen, side).size()), of(seen, side), params.min_region_share);
    if (!empty.empty())
      advice.push_back(formatted("show the board in these parts of the %s image: ", name) +
                       joined(empty));
  }
  return advice;
}

std::vector<std::string> advise(const StereoFit& fit, const SeenAreas& seen,
                                const AdviceParams& params) {
  std::vector<std::string> advice = advise_places(fit.views, seen, params);
  advise_tilt(fit.figures, params, advice);
  advise_distance(fit.figures, params, advice);
  return advice;
}

bool complete(const std::vector<View>& views, const Board& board, const SeenAreas& seen,
              LensModel model, const CompletionParams& params) {
  const auto taken = static_cast<int>(views.size());
  if (taken >= params.most_views) return true;
  // What needs no fit comes first: a fit takes seconds.
  if (taken < params.enough_views || !advise_places(views, seen).empty()) return false;
  const StereoFit fit = fit_stereo(views, board, seen.left.size(), model);
  return advise(fit, seen).empty() && judge(fit, least_coverage(fit.views, seen)).faults.empty();
}

}  // namespace limbcast::calibrate
