#include "modules/calibrate/outlying_points.hpp"

#include <algorithm>
#include <cstddef>

#include "common/camera/lens_projection.hpp"
#include "common/median.hpp"

namespace limbcast::calibrate {
namespace {

/// What one image shows of a board, and what is known of it by the lens.
class BoardImage {
 public:
  BoardImage(const BoardPoints& seen, const Board& board, const LensCalibration& lens,
             const FitParams& params)
      : pixels_(seen.pixels.begin(), seen.pixels.end()), lens_(lens), params_(params) {
    for (const cv::Point3f& point : points_of(board, seen.ids)) points_.emplace_back(point);
  }

  /// How far each point stands from where the lens shows it on a board that stands so [px].
  std::vector<double> errors_px(const Pose& pose) const {
    std::vector<cv::Point2d> shown;
    project_points(points_, pose.rotation, pose.translation, lens_, shown);
    std::vector<double> errors;
    for (std::size_t i = 0; i < shown.size(); ++i)
      errors.push_back(cv::norm(shown[i] - pixels_[i]));
    return errors;
  }

  /// How the board stands by these of its points.
  Pose pose_by(const std::vector<std::size_t>& indices, const Pose& guess) const {
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (const std::size_t i : indices) {
      points.push_back(points_[i]);
      pixels.push_back(pixels_[i]);
    }
    return find_pose(points, pixels, lens_, guess, params_);
  }

  std::size_t size() const { return pixels_.size(); }

 private:
  std::vector<cv::Point3d> points_;
  std::vector<cv::Point2d> pixels_;
  const LensCalibration& lens_;
  const FitParams& params_;
};

struct Outlying {
  std::size_t index;
  double error_px;
};

/// The points that those which stay put elsewhere, the worst first. Each is judged by a pose that
/// it had no share in, as it draws the pose of all towards itself: at a corner of the board by half
/// of its own error.
std::vector<Outlying> outlying_in(const BoardImage& image, Pose pose, const FitParams& params) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < image.size(); ++i) rest.push_back(i);
  const auto most = std::max<std::size_t>(
      1, static_cast<std::size_t>(params.max_outlying_share * static_cast<double>(image.size())));
  std::vector<Outlying> outlying;
  while (true) {
    std::vector<double> errors_px = image.errors_px(pose);
    const auto worst =
        std::max_element(rest.begin(), rest.end(),
                         [&](std::size_t a, std::size_t b) { return errors_px[a] < errors_px[b]; });
    const std::size_t index = *worst;
    rest.erase(worst);
    pose = image.pose_by(rest, pose);
    errors_px = image.errors_px(pose);
    std::vector<double> errors_of_rest_px;
    for (const std::size_t i : rest) errors_of_rest_px.push_back(errors_px[i]);
    const double limit_px =
        std::max(params.outlying_px, params.outlying_factor * median(errors_of_rest_px));
    if (errors_px[index] <= limit_px) return outlying;
    if (outlying.size() == most) return {};
    outlying.push_back({index, errors_px[index]});
  }
}

BoardPoints without(const BoardPoints& seen, const std::vector<Outlying>& outlying) {
  BoardPoints rest;
  for (std::size_t i = 0; i < seen.ids.size(); ++i) {
    if (std::any_of(outlying.begin(), outlying.end(),
                    [i](const Outlying& point) { return point.index == i; }))
      continue;
    rest.ids.push_back(seen.ids[i]);
    rest.pixels.push_back(seen.pixels[i]);
  }
  return rest;
}

bool same_points(const std::vector<OutlyingPoint>& a, const std::vector<OutlyingPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const OutlyingPoint& one, const OutlyingPoint& other) {
                      return one.view == other.view && one.side == other.side && one.id == other.id;
                    });
}

}  // namespace

GoodPoints without_outlying_points(const std::vector<View>& views, const Board& board,
                                   const Lenses& lenses, const FitParams& params) {
  GoodPoints good{views, {}};
  const auto sift = [&](std::size_t view, Side side, const Lens& lens, BoardPoints& points) {
    const BoardImage image(points, board, lens.calibration, params);
    const std::vector<Outlying> outlying = outlying_in(image, lens.boards[view], params);
    for (const Outlying& point : outlying)
      good.left_out.push_back({views[view].name, side, points.ids[point.index], point.error_px});
    if (!outlying.empty()) points = without(points, outlying);
  };
  for (std::size_t i = 0; i < views.size(); ++i) {
    sift(i, Side::kLeft, lenses.left, good.views[i].left);
    sift(i, Side::kRight, lenses.right, good.views[i].right);
  }
  return good;
}

GoodFit fit_good_points(const std::vector<View>& views, const Board& board, const cv::Size& size,
                        Distortion distortion, const FitParams& params) {
  GoodFit fit{{views, {}}, fit_lenses(views, board, size, distortion, params)};
  for (int round = 0; round < params.max_point_rounds; ++round) {
    GoodPoints good = without_outlying_points(views, board, fit.lenses, params);
    const bool settled = same_points(good.left_out, fit.points.left_out);
    fit.points = std::move(good);
    if (settled) break;
    fit.lenses = fit_lenses(fit.points.views, board, size, distortion, params);
  }
  return fit;
}

}  // namespace limbcast::calibrate
