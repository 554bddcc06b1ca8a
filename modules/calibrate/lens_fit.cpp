#include "modules/calibrate/lens_fit.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>

namespace limbcast::calibrate {
namespace {

Lens fit_lens(const std::vector<const BoardPoints*>& views, const Board& board,
              const cv::Size& size, Distortion distortion) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardPoints* view : views) {
    points.push_back(points_of(board, view->ids));
    pixels.push_back(view->pixels);
  }
  Lens lens;
  cv::Mat deviations;
  cv::calibrateCamera(points, pixels, size, lens.K, lens.D, lens.rotations, lens.translations,
                      deviations, cv::noArray(), cv::noArray(), flags_of(distortion));
  const auto deviation = [&](int i) { return deviations.at<double>(i); };
  lens.uncertainty = {std::max(deviation(0), deviation(1)), std::max(deviation(2), deviation(3))};
  return lens;
}

}  // namespace

cv::Point3f point_in_squares(const Board& board, int id) {
  return board.point_m(id) / board.square_m;
}

std::vector<cv::Point3f> points_of(const Board& board, const std::vector<int>& ids) {
  std::vector<cv::Point3f> points;
  points.reserve(ids.size());
  for (const int id : ids) points.push_back(point_in_squares(board, id));
  return points;
}

int flags_of(Distortion distortion) {
  return distortion == Distortion::kWithK3 ? 0 : cv::CALIB_FIX_K3;
}

Lenses fit_lenses(const std::vector<View>& views, const Board& board, const cv::Size& size,
                  Distortion distortion) {
  std::vector<const BoardPoints*> seen_left;
  std::vector<const BoardPoints*> seen_right;
  for (const View& view : views) {
    seen_left.push_back(&view.left);
    seen_right.push_back(&view.right);
  }
  return {fit_lens(seen_left, board, size, distortion),
          fit_lens(seen_right, board, size, distortion)};
}

double focal_sigma(const Lenses& lenses) {
  const auto share = [](const Lens& lens) {
    return lens.uncertainty.focal_px / lens.K.at<double>(0, 0);
  };
  return std::max(share(lenses.left), share(lenses.right));
}

}  // namespace limbcast::calibrate
