#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"
#include "common/human_model/joints.hpp"

namespace limbcast {

inline constexpr int kLinkCount = 16;  ///< of Table I, link 0 (the start, the head) included
inline constexpr int kTypicalPoseCount = 27;

/// One row of Table I. Lengths, where they are not exact, hold for the model's own stature.
struct Link {
  std::string name;               ///< as in Table I
  Joint end = Joint::kHead;       ///< the joint at which it ends
  int connected_to = 0;           ///< number of the link at whose end it starts
  std::optional<int> coupled_to;  ///< number of the link whose movement it shares (shoulders, hips)
  bool has_children = false;      ///< other links start at its end
  double length_m = 0.0;
  double min_length_m = 0.0, max_length_m = 0.0;
  /// How far its end lies behind the surface that the sensor sees, along the ray [m].
  double depth_offset_m = 0.0;
  /// Share of its fitted ends within 10 cm of the truth.
  float confidence = 0.5F;
  /// Half thickness: points of the cluster up to here belong to the link [m].
  double radius_m = 0.0;
};

/// One of the 28 degrees of freedom.
struct DegreeOfFreedom {
  std::string name;
  int link = 0;  ///< number of the link that it moves
  double min_rad = 0.0, max_rad = 0.0;
  std::string source;  ///< where the interval was published
};

/// Directions of the links, by their number, in the body's frame: x to its left, y up, z forward.
struct TypicalPose {
  std::string name;
  std::array<Eigen::Vector3f, kLinkCount> directions;
};

/// The human model of section III-A: links, joint limits and typical poses.
struct HumanModel {
  std::string name;
  /// Lengths times this are tried first; Eq. 2 tells how far off that is.
  double start_scale = 1.0;
  std::string length_limits_source;    ///< where shortest and longest links were published
  std::array<Link, kLinkCount> links;  ///< by the number of Table I
  std::array<DegreeOfFreedom, kDegreesOfFreedom> degrees_of_freedom;
  std::vector<TypicalPose> typical_poses;  ///< 27 of them
  double rotation_step_rad = 0.0;
  int rotation_count = 0;
};

/// The same model with all lengths of links times `scale`.
HumanModel scaled(HumanModel model, double scale);

/// Where the three parts of a model come from: a name of those that ship, or the path of a file.
struct HumanModelFiles {
  std::string links = "anthropometric";  ///< or "table1"
  std::string joint_limits = "joint_limits";
  std::string typical_poses = "typical_poses";
};

/// Reads a model. Throws InputError "file: 'key' is ..., must be ..." for what cannot be used.
HumanModel load_human_model(const HumanModelFiles& files = {});

}  // namespace limbcast
