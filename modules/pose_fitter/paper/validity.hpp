#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/pose_fitter/paper/rotation_fitter.hpp"

namespace limbcast::pose_fitter {

/// Lengths of the fitted links over those of the model, in the order of Table I.
std::vector<float> link_scales(const FittedPose& pose, const HumanModel& model);

/// s of Eq. 2; 0 without any link.
float average_scale(const std::vector<float>& scales, ScaleAverage average);

/// The 2 sigma rule: no link's scale is farther from `average` than twice the deviation.
bool scales_agree(const std::vector<float>& scales, float average, const PaperFitterParams& params);

/// All checks of section III-C.3. They ask nothing of a head alone, which is valid.
bool is_valid(const FittedPose& pose, const HumanModel& model, const Eigen::Matrix3f& axes,
              const PaperFitterParams& params);

}  // namespace limbcast::pose_fitter
