#include "modules/pose_fitter/paper/validity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/human_model/joint_angles.hpp"
#include "modules/pose_fitter/paper/skeleton.hpp"

namespace limbcast::pose_fitter {
namespace {

float median(std::vector<float> values) {
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  const float below = *std::max_element(values.begin(), values.begin() + static_cast<long>(middle));
  return 0.5F * (below + values[middle]);
}

}  // namespace

std::vector<float> link_scales(const FittedPose& pose, const HumanModel& model) {
  std::vector<float> scales;
  for (int number = 1; number < kLinkCount; ++number) {
    const Link& link = model.links[number];
    if (!pose.links[number].valid) continue;
    const float length = (pose.links[number].end_m - pose.links[link.connected_to].end_m).norm();
    scales.push_back(length / static_cast<float>(link.length_m));
  }
  return scales;
}

float average_scale(const std::vector<float>& scales, ScaleAverage average) {
  if (scales.empty()) return 0.0F;
  if (average == ScaleAverage::kMedian) return median(scales);
  return std::accumulate(scales.begin(), scales.end(), 0.0F) / static_cast<float>(scales.size());
}

bool scales_agree(const std::vector<float>& scales, float average,
                  const PaperFitterParams& params) {
  if (scales.empty()) return true;
  double sigma = params.scale_sigma * average;
  if (params.scale_deviation == ScaleDeviation::kPose) {
    double sum = 0.0;
    for (const float scale : scales) sum += (scale - average) * (scale - average);
    sigma = std::sqrt(sum / static_cast<double>(scales.size()));
  }
  return std::all_of(scales.begin(), scales.end(),
                     [&](float scale) { return std::abs(scale - average) <= 2.0 * sigma; });
}

bool is_valid(const FittedPose& pose, const HumanModel& model, const Eigen::Matrix3f& axes,
              const PaperFitterParams& params) {
  const std::vector<float> scales = link_scales(pose, model);
  const float scale = average_scale(scales, params.scale_average);
  if (!scales_agree(scales, scale, params)) return false;
  const JointAngles angles = fitted_angles(pose, model, axes);
  const double tolerance_rad = params.angle_tolerance_deg * 3.14159265358979323846 / 180.0;
  return !broken_joint_limit(angles, model, static_cast<float>(tolerance_rad));
}

}  // namespace limbcast::pose_fitter
