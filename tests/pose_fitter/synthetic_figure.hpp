#pragma once

#include <array>
#include <vector>

#include "common/cloud/segment.hpp"
#include "common/human_model/human_model.hpp"
#include "common/human_model/joint_angles.hpp"

namespace limbcast::pose_fitter {

/// A person made of capsules, one a link, as a camera at the origin would see it.
struct Figure {
  Skeleton skeleton;  ///< where the links really end
  Segment segment;    ///< points on the capsules' visible side
  Stamp stamp;        ///< gravity along y
};

struct FigureOptions {
  Eigen::Vector3f head_m{0.0F, -0.6F, 3.0F};
  double rotation_rad = 0.0;               ///< about gravity; 0 faces the sensor
  double scale = 1.0;                      ///< against the model's lengths
  std::array<bool, kLinkCount> without{};  ///< links of which no point is made
};

/// The typical pose of that index, exactly.
Figure make_figure(const HumanModel& model, int typical_pose, const FigureOptions& options = {});

/// Distance of a joint from where the figure has it [m].
float joint_error_m(const BodyPose& body, const Figure& figure, Joint joint);

}  // namespace limbcast::pose_fitter
