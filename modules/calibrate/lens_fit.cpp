#include "modules/calibrate/lens_fit.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "common/camera/opencv_conversion.hpp"
#include "modules/calibrate/fisheye_fit.hpp"

namespace limbcast::calibrate {
namespace {

SeenPoints seen_points(const std::vector<View>& views, const Board& board,
                       const BoardPoints View::*side) {
  SeenPoints seen;
  for (const View& view : views) {
    seen.points.push_back(points_of(board, (view.*side).ids));
    seen.pixels.push_back((view.*side).pixels);
  }
  return seen;
}

Lens fit_pinhole(const SeenPoints& seen, const cv::Size& size, Distortion distortion) {
  cv::Mat K;
  cv::Mat D;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::Mat deviations;
  cv::calibrateCamera(seen.points, seen.pixels, size, K, D, rotations, translations, deviations,
                      cv::noArray(), cv::noArray(), flags_of(distortion));
  const auto deviation = [&](int i) { return deviations.at<double>(i); };
  Lens lens;
  lens.calibration = pinhole_of(K, D, size);
  lens.uncertainty = {std::max(deviation(0), deviation(1)), std::max(deviation(2), deviation(3))};
  for (std::size_t view = 0; view < rotations.size(); ++view)
    lens.boards.push_back({rotations[view], translations[view]});
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

bool is_fisheye(Distortion distortion) {
  return distortion == Distortion::kFisheye || distortion == Distortion::kFisheyeWithoutK3;
}

int flags_of(Distortion distortion) {
  return distortion == Distortion::kWithK3 ? 0 : cv::CALIB_FIX_K3;
}

LensCalibration pinhole_of(const cv::Matx33d& K, const cv::Mat& D, const cv::Size& size) {
  LensCalibration lens;
  lens.camera = {size.width, size.height, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
  lens.distortion.assign(D.begin<double>(), D.end<double>());
  return lens;
}

Lenses fit_lenses(const std::vector<View>& views, const Board& board, const cv::Size& size,
                  Distortion distortion, const FitParams& params) {
  const auto fit_lens = [&](const BoardPoints View::*side) {
    const SeenPoints seen = seen_points(views, board, side);
    return is_fisheye(distortion) ? fit_fisheye(seen, size, distortion, params)
                                  : fit_pinhole(seen, size, distortion);
  };
  return {fit_lens(&View::left), fit_lens(&View::right)};
}

Pose find_pose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& pixels,
               const LensCalibration& lens, const std::optional<Pose>& guess,
               const FitParams& params) {
  if (lens.model == LensModel::kFisheye) return fisheye_pose(points, pixels, lens, guess, params);
  Pose pose = guess.value_or(Pose{});
  cv::solvePnP(points, pixels, camera_matrix(lens.camera), lens.distortion, pose.rotation,
               pose.translation, guess.has_value());
  return pose;
}

double focal_sigma(const Lenses& lenses) {
  const auto share = [](const Lens& lens) {
    return lens.uncertainty.focal_px / lens.calibration.camera.fx;
  };
  return std::max(share(lenses.left), share(lenses.right));
}

}  // namespace limbcast::calibrate
