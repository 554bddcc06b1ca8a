#include "modules/calibrate/fisheye_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <tuple>

#include "common/camera/lens_projection.hpp"
#include "common/camera/opencv_conversion.hpp"
#include "common/shortest_turn.hpp"
#include "common/units.hpp"
#include "modules/calibrate/least_squares.hpp"

namespace limbcast::calibrate {
namespace {

/// How a lens is written as unknowns: focal lengths fx fy, principal point cx cy, and the
/// coefficients that are sought.
struct LensUnknowns {
  cv::Size size;  ///< of the image [px]
  int num_coefficients;

  LensUnknowns(const cv::Size& image_size, Distortion distortion)
      : size(image_size),
        num_coefficients(distortion == Distortion::kFisheye ? kFisheyeCoefficients : 2) {}

  int count() const { return 4 + num_coefficients; }
  Eigen::VectorXd of(const LensCalibration& lens) const {
    Eigen::VectorXd x(count());
    x << lens.camera.fx, lens.camera.fy, lens.camera.cx, lens.camera.cy,
        Eigen::Map<const Eigen::VectorXd>(lens.distortion.data(), num_coefficients);
    return x;
  }
  LensCalibration lens(const Eigen::VectorXd& x) const {
    LensCalibration result{{size.width, size.height, x[0], x[1], x[2], x[3]},
                           {x.data() + 4, x.data() + count()},
                           LensModel::kFisheye};
    result.distortion.resize(kFisheyeCoefficients, 0.0);
    return result;
  }
};

PoseVector vector_of(const Pose& pose) {
  PoseVector vector;
  vector << Eigen::Map<const Eigen::Vector3d>(pose.rotation.ptr<double>()),
      Eigen::Map<const Eigen::Vector3d>(pose.translation.ptr<double>());
  return vector;
}

Pose pose_of(const PoseVector& vector) {
  return {(cv::Mat_<double>(3, 1) << vector[0], vector[1], vector[2]),
          (cv::Mat_<double>(3, 1) << vector[3], vector[4], vector[5])};
}

Pose composed(const Pose& first, const Pose& second) {
  Pose pose;
  cv::composeRT(first.rotation, first.translation, second.rotation, second.translation,
                pose.rotation, pose.translation);
  return pose;
}

/// Points and pixels of one view.
struct SeenView {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
};

std::vector<SeenView> views_of(const SeenPoints& seen) {
  std::vector<SeenView> views;
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    views.push_back({{seen.points[i].begin(), seen.points[i].end()},
                     {seen.pixels[i].begin(), seen.pixels[i].end()}});
  return views;
}

/// Differences in u and v between where the lens shows the points and where it was seen to.
Eigen::VectorXd errors_of(const SeenView& view, const LensCalibration& lens, const Pose& pose) {
  std::vector<cv::Point2d> shown;
  project_points(view.points, pose.rotation, pose.translation, lens, shown);
  Eigen::VectorXd errors(2 * shown.size());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    errors[row++] = shown[i].x - view.pixels[i].x;
    errors[row++] = shown[i].y - view.pixels[i].y;
  }
  return errors;
}

/// A fisheye that shows angles as they are, of this field across the longer side of its image.
LensCalibration even_fisheye(double field_rad, const cv::Size& size) {
  const double focal_px = std::max(size.width, size.height) / field_rad;
  return {{size.width, size.height, focal_px, focal_px, 0.5 * size.width, 0.5 * size.height},
          std::vector<double>(kFisheyeCoefficients, 0.0),
          LensModel::kFisheye};
}

/// Directions to the pixels, as if the lens showed angles as they are.
std::vector<Eigen::Vector3d> even_rays(const std::vector<cv::Point2d>& pixels,
                                       const PinholeCamera& camera) {
  std::vector<Eigen::Vector3d> rays;
  for (const cv::Point2d& pixel : pixels) {
    const Eigen::Vector2d angle((pixel.x - camera.cx) / camera.fx,
                                (pixel.y - camera.cy) / camera.fy);
    const Eigen::Vector2d across = std::sin(angle.norm()) * angle.normalized();
    rays.emplace_back(across.x(), across.y(), std::cos(angle.norm()));
  }
  return rays;
}

/// A pose to begin with: that which a pinhole camera sees that looks at the middle of the points,
/// so that none is far off its axis.
Pose first_pose(const SeenView& view, const LensCalibration& lens) {
  const std::vector<Eigen::Vector3d> rays = even_rays(view.pixels, lens.camera);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& ray : rays) middle += ray;
  const Eigen::Matrix3d turn =
      shortest_turn<double>(middle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<cv::Point2d> tangents;
  for (const Eigen::Vector3d& ray : rays) {
    const Eigen::Vector3d turned = turn * ray;
    tangents.emplace_back(turned.x() / turned.z(), turned.y() / turned.z());
  }
  Pose turned;
  cv::solvePnP(view.points, tangents, cv::Matx33d::eye(), cv::noArray(), turned.rotation,
               turned.translation);
  Pose back;
  cv::Rodrigues(to_cv(Eigen::Matrix3d(turn.transpose())), back.rotation);
  return composed(turned, back);
}

/// What is sought of a lens, from that one on.
Unknowns first_unknowns(const std::vector<SeenView>& views, const LensUnknowns& form,
                        const LensCalibration& lens) {
  Unknowns unknowns{form.of(lens), {}};
  for (const SeenView& view : views) unknowns.poses.push_back(vector_of(first_pose(view, lens)));
  return unknowns;
}

double squares_of(const Residuals& residuals, const Unknowns& unknowns) {
  double sum = 0.0;
  for (std::size_t view = 0; view < unknowns.poses.size(); ++view)
    sum += residuals(unknowns.shared, unknowns.poses[view], view).squaredNorm();
  return sum;
}

/// Of the fields that such lenses have, the one that fits best.
Unknowns best_start(const std::vector<SeenView>& views, const LensUnknowns& form,
                    const Residuals& residuals, const FitParams& params) {
  Unknowns best;
  double least = std::numeric_limits<double>::infinity();
  for (double field_deg = params.smallest_fisheye_deg; field_deg <= params.largest_fisheye_deg;
       field_deg += params.fisheye_step_deg) {
    Unknowns start = first_unknowns(views, form, even_fisheye(radians(field_deg), form.size));
    const double squares = squares_of(residuals, start);
    if (!best.poses.empty() && !(squares < least)) continue;
    least = squares;
    best = std::move(start);
  }
  return best;
}

double rms(const Eigen::VectorXd& errors) {
  return errors.norm() / std::sqrt(0.5 * static_cast<double>(errors.size()));
}

}  // namespace

Lens fit_fisheye(const SeenPoints& seen, const cv::Size& size, Distortion distortion,
                 const FitParams& params) {
  const LensUnknowns form(size, distortion);
  const std::vector<SeenView> views = views_of(seen);
  const Residuals residuals = [&](const Eigen::VectorXd& shared, const PoseVector& pose,
                                  std::size_t view) {
    return errors_of(views[view], form.lens(shared), pose_of(pose));
  };
  const LeastSquares found = least_squares(residuals, best_start(views, form, residuals, params),
                                           params.max_iterations, params.min_change);
  const Eigen::VectorXd& deviations = found.deviations;
  Lens lens;
  lens.calibration = form.lens(found.unknowns.shared);
  lens.uncertainty = {deviations.head<2>().maxCoeff(), deviations.segment<2>(2).maxCoeff()};
  for (const PoseVector& pose : found.unknowns.poses) lens.boards.push_back(pose_of(pose));
  return lens;
}

PairFit refine_fisheyes(const Lenses& lenses, const Pose& right_from_left, const SeenPoints& left,
                        const SeenPoints& right, Distortion distortion, const FitParams& params) {
  const PinholeCamera& camera = lenses.left.calibration.camera;
  const LensUnknowns form({camera.width, camera.height}, distortion);
  const std::vector<SeenView> left_views = views_of(left);
  const std::vector<SeenView> right_views = views_of(right);
  const auto pair_of = [&](const Eigen::VectorXd& shared) {
    return std::tuple(form.lens(shared.head(form.count())),
                      form.lens(shared.segment(form.count(), form.count())),
                      pose_of(shared.tail<PoseVector::SizeAtCompileTime>()));
  };
  const Residuals residuals = [&](const Eigen::VectorXd& shared, const PoseVector& board,
                                  std::size_t view) {
    const auto [left_lens, right_lens, turn] = pair_of(shared);
    const Eigen::VectorXd in_left = errors_of(left_views[view], left_lens, pose_of(board));
    const Eigen::VectorXd in_right =
        errors_of(right_views[view], right_lens, composed(pose_of(board), turn));
    return (Eigen::VectorXd(in_left.size() + in_right.size()) << in_left, in_right).finished();
  };
  Unknowns start;
  start.shared.resize(2 * form.count() + PoseVector::SizeAtCompileTime);
  start.shared << form.of(lenses.left.calibration), form.of(lenses.right.calibration),
      vector_of(right_from_left);
  for (const Pose& board : lenses.left.boards) start.poses.push_back(vector_of(board));
  const Unknowns found =
      least_squares(residuals, start, params.max_iterations, params.min_change).unknowns;

  const auto [left_lens, right_lens, turn] = pair_of(found.shared);
  PairFit pair{left_lens, right_lens, {}, found.shared.tail<3>(), {}};
  cv::Matx33d R;
  cv::Rodrigues(turn.rotation, R);
  cv::cv2eigen(R, pair.R);
  for (std::size_t view = 0; view < found.poses.size(); ++view) {
    const Eigen::VectorXd errors = residuals(found.shared, found.poses[view], view);
    const Eigen::Index half = errors.size() / 2;  // as many points in either image
    pair.errors_px.emplace_back(rms(errors.head(half)), rms(errors.tail(half)));
  }
  return pair;
}

Pose fisheye_pose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& pixels,
                  const LensCalibration& lens, const std::optional<Pose>& guess,
                  const FitParams& params) {
  const SeenView view{points, pixels};
  const Pose start = guess ? *guess : first_pose(view, lens);
  const Residuals residuals = [&](const Eigen::VectorXd&, const PoseVector& pose, std::size_t) {
    return errors_of(view, lens, pose_of(pose));
  };
  return pose_of(least_squares(residuals, {Eigen::VectorXd(0), {vector_of(start)}},
                               params.max_iterations, params.min_change)
                     .unknowns.poses.front());
}

}  // namespace limbcast::calibrate
