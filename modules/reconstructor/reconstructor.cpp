#include "modules/reconstructor/reconstructor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "common/cloud/ground_plane.hpp"
#include "common/formatted.hpp"
#include "modules/reconstructor/matcher.hpp"
#include "modules/reconstructor/near_look.hpp"
#include "modules/reconstructor/row_alignment.hpp"
#include "modules/reconstructor/triangulation.hpp"

namespace limbcast::reconstructor {
namespace {

/// What is nearer is looked for first, in small images: people stand farther away, mostly.
constexpr double kUsualNearest_m = 1.0;

cv::Rect region_of_interest(const ReconstructorOptions& options, const PinholeCamera& camera) {
  const cv::Rect image(0, 0, camera.width, camera.height);
  const cv::Rect wanted(
      options.roi_x, options.roi_y,
      options.roi_width > 0 ? options.roi_width : std::max(0, camera.width - options.roi_x),
      options.roi_height > 0 ? options.roi_height : std::max(0, camera.height - options.roi_y));
  const cv::Rect roi = wanted & image;
  // Less than the matcher's windows see nothing.
  constexpr int kLeastSide_px = 32;
  if (std::min(roi.width, roi.height) < kLeastSide_px)
    throw std::invalid_argument(formatted(
        "region of interest holds %d x %d px of the image of %d x %d, at least %d x %d are needed; "
        "see roi-x, roi-y, roi-width and roi-height",
        roi.width, roi.height, camera.width, camera.height, kLeastSide_px, kLeastSide_px));
  return roi;
}

DepthToCloudParams limits_of(const ReconstructorOptions& options) {
  DepthToCloudParams params;
  params.near_limit_m = options.depth_near_limit_m();
  params.far_limit_m = options.far_limit_m;
  return params;
}

/// The frame's gravity, or the mounting's where the frame has none.
Gravity gravity_of(const Stamp& stamp, const Mounting& mounting) {
  Gravity gravity = stamp.gravity;
  if (gravity.source == GravitySource::kLevel && mounting.down) {
    gravity.down = mounting.down->cast<float>().normalized();
    gravity.source = GravitySource::kOption;
  }
  if (!gravity.sensor_height_m && mounting.sensor_height_m)
    gravity.sensor_height_m = static_cast<float>(*mounting.sensor_height_m);
  return gravity;
}

/// Gives the cloud the frame's stamp, keeping the noise that the cloud's maker stated.
void stamp_cloud(Cloud& cloud, const Stamp& stamp, const Mounting& mounting,
                 const char* frame_suffix) {
  const DepthNoise noise = cloud.stamp.depth_noise;
  cloud.stamp = stamp;
  cloud.stamp.depth_noise = noise;
  cloud.stamp.gravity = gravity_of(stamp, mounting);
  if (cloud.stamp.frame.empty()) cloud.stamp.frame = stamp.sensor + frame_suffix;
}

}  // namespace

StereoReconstructor::StereoReconstructor(const StereoCalibration& calibration,
                                         const ReconstructorOptions& options)
    : options_(options),
      mounting_(calibration.mounting),
      rectifier_(calibration, options.image_scale),
      roi_(region_of_interest(options, rectifier_.camera())) {
  const double near_limit_m = options.stereo_near_limit_m();
  const auto disparities_to = [&](double distance_m) {
    const int most = rectifier_.camera().width;
    const double needed = std::ceil(focal_baseline_px_m() / distance_m) + 1.0;
    return needed < most ? static_cast<int>(needed) : most;
  };
  most_disparities_ = disparities_to(near_limit_m);
  num_disparities_ = disparities_to(std::max(near_limit_m, kUsualNearest_m));
}

double StereoReconstructor::nearest_m() const {
  return std::max(options_.stereo_near_limit_m(), focal_baseline_px_m() / most_disparities_);
}

DisparityImage StereoReconstructor::match(const RectifiedPair& pair) const {
  MatcherParams params;
  const int num_disparities = find_num_disparities(pair, num_disparities_, most_disparities_);
  params.semi_global.num_disparities = num_disparities;
  // A pixel's match stands up to num_disparities further left.
  const int left_edge = std::max(0, roi_.x - num_disparities);
  const cv::Rect searched(left_edge, roi_.y, roi_.x + roi_.width - left_edge, roi_.height);
  const DisparityImage found =
      reconstructor::match(pair.left(searched), pair.right(searched), params);
  if (roi_.size() == pair.left.size()) return found;
  const cv::Rect inner(roi_.x - left_edge, 0, roi_.width, roi_.height);
  DisparityImage result{cv::Mat1f(pair.left.size(), 0.0F), cv::Mat1b(pair.left.size(), uchar{0})};
  found.disparity_px(inner).copyTo(result.disparity_px(roi_));
  found.confidence(inner).copyTo(result.confidence(roi_));
  return result;
}

Cloud StereoReconstructor::reconstruct(const StereoImages& images) const {
  const RectifiedPair pair =
      with_rows_aligned(rectifier_.rectify(images.left, images.right), rectifier_.camera());
  TriangulationParams params;
  params.near_limit_m = options_.stereo_near_limit_m();
  params.far_limit_m = options_.far_limit_m;
  Cloud cloud =
      triangulate(match(pair), pair.left, rectifier_.camera(), rectifier_.baseline_m(), params);
  stamp_cloud(cloud, images.stamp, mounting_, "/left_rectified");
  if (options_.ground_plane) complete_gravity(cloud);
  return cloud;
}

DepthReconstructor::DepthReconstructor(const DepthCalibration& calibration,
                                       const ReconstructorOptions& options)
    : depth_to_cloud_(calibration, limits_of(options)),
      mounting_(calibration.mounting),
      ground_plane_(options.ground_plane) {}

Cloud DepthReconstructor::reconstruct(const DepthImages& images) const {
  Cloud cloud = depth_to_cloud_.cloud_of(images.depth, images.color);
  stamp_cloud(cloud, images.stamp, mounting_, "/color");
  // Laxer than of pairs: six of a real one's 60 frames take something else for the ground so, and
  // the mean error of its joints is 0.1 cm less all the same (tests/accuracy/README.md).
  if (ground_plane_) complete_gravity(cloud, GroundPlaneParams{});
  return cloud;
}

}  // namespace limbcast::reconstructor
