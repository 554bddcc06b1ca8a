#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/pose_fitter/paper/link_fitter.hpp"

namespace limbcast::pose_fitter {

/// One typical pose fitted into a cluster: the outcome of Algorithm 2's main part.
struct FittedPose {
  int typical_pose = 0;                   ///< index in the model
  int rotation = 0;                       ///< in steps of the model
  std::array<LinkFit, kLinkCount> links;  ///< by number; the head is valid and fitted to the start
  std::array<float, kErrorTermCount> terms{};  ///< Eq. 1, weighted
  float error = 0.0F;                          ///< their sum
};

/// Axes of the body (columns left, up, forward): forward is turned by `rotation_rad` from towards
/// the sensor about the axis against gravity.
Eigen::Matrix3f body_axes(const Eigen::Vector3f& head_m, const Eigen::Vector3f& down,
                          double rotation_rad);

/// Fits all typical poses in one rotation. What a link finds depends only on where it starts and
/// what it is looked for with, and most poses share that: each such fit is made once.
class RotationFitter {
 public:
  RotationFitter(const HumanModel& model, const PaperFitterParams& params, const Cluster& cluster,
                 const Eigen::Vector3f& head_m, const Eigen::Matrix3f& axes);

  /// Algorithm 2, main part, for the typical pose of that index.
  FittedPose fit(int typical_pose);

 private:
  /// A link fit, what it was asked for, and the points near it.
  struct SharedFit {
    LinkStart start;
    Eigen::Vector3f direction;
    LinkFit fit;
    std::vector<std::uint64_t> near_points;
  };

  const SharedFit& shared_fit(int number, const LinkStart& start, const Eigen::Vector3f& direction);
  Eigen::Vector3f reference_direction(int number, const FittedPose& pose) const;
  void compute_error(const std::vector<std::uint64_t>& used, FittedPose& pose) const;

  const HumanModel& model_;
  const PaperFitterParams& params_;
  const Cluster& cluster_;
  LinkFitter link_fitter_;
  Eigen::Vector3f head_m_;
  Eigen::Matrix3f axes_;
  std::array<std::vector<SharedFit>, kLinkCount> shared_;
};

}  // namespace limbcast::pose_fitter
