#pragma once

#include "common/camera/calibration.hpp"
#include "common/camera/images.hpp"
#include "modules/reconstructor/depth_to_cloud.hpp"
#include "modules/reconstructor/disparity.hpp"
#include "modules/reconstructor/options.hpp"
#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::reconstructor {

/// From a pair of images to an organised, coloured cloud: rectify, match, triangulate, find the
/// ground.
class StereoReconstructor {
 public:
  /// Throws std::invalid_argument where calibration and options do not fit together.
  StereoReconstructor(const StereoCalibration& calibration, const ReconstructorOptions& options);

  Cloud reconstruct(const StereoImages& images) const;

  /// Disparities of a rectified pair, searched as far as its nearest surface needs; outside the
  /// region of interest there are none.
  DisparityImage match(const RectifiedPair& pair) const;

  const Rectifier& rectifier() const { return rectifier_; }
  /// Disparity times distance.
  double focal_baseline_px_m() const { return rectifier_.camera().fx * rectifier_.baseline_m(); }
  /// Disparities that are searched where nothing is nearer than usual, and at most.
  int num_disparities() const { return num_disparities_; }
  int most_disparities() const { return most_disparities_; }
  /// What is nearer is not seen [m], where the matcher cannot search as far as the near limit asks.
  double nearest_m() const;

 private:
  ReconstructorOptions options_;
  Mounting mounting_;
  Rectifier rectifier_;
  int num_disparities_ = 0, most_disparities_ = 0;
  cv::Rect roi_;
};

/// From a depth camera's frame to an organised, coloured cloud.
class DepthReconstructor {
 public:
  DepthReconstructor(const DepthCalibration& calibration, const ReconstructorOptions& options);

  Cloud reconstruct(const DepthImages& images) const;

 private:
  DepthToCloud depth_to_cloud_;
  Mounting mounting_;
  bool ground_plane_;
};

}  // namespace limbcast::reconstructor
