#include "modules/tracker/body_size.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace limbcast::tracker {
namespace {

using Ends = std::pair<Joint, Joint>;

/// Ends of each length, of the left and right one where there are two.
const std::array<std::vector<Ends>, kLengthCount> kLengths = {{
    {{Joint::kHead, Joint::kNeck}},
    {{Joint::kNeck, Joint::kChest}},
    {{Joint::kChest, Joint::kPelvis}},
    {{Joint::kShoulderLeft, Joint::kShoulderRight}},
    {{Joint::kShoulderLeft, Joint::kElbowLeft}, {Joint::kShoulderRight, Joint::kElbowRight}},
    {{Joint::kElbowLeft, Joint::kWristLeft}, {Joint::kElbowRight, Joint::kWristRight}},
    {{Joint::kHipLeft, Joint::kKneeLeft}, {Joint::kHipRight, Joint::kKneeRight}},
    {{Joint::kKneeLeft, Joint::kAnkleLeft}, {Joint::kKneeRight, Joint::kAnkleRight}},
}};

/// Mean of the sides that are known.
std::optional<double> length_m(const BodyPose& pose, const std::vector<Ends>& sides) {
  double sum_m = 0.0;
  int count = 0;
  for (const auto& [from, to] : sides) {
    if (!pose[from].valid || !pose[to].valid) continue;
    sum_m += (pose[to].position_m - pose[from].position_m).norm();
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum_m / count;
}

}  // namespace

void BodySize::add(const BodyPose& pose) {
  for (int i = 0; i < kLengthCount; ++i) {
    const auto measured_m = length_m(pose, kLengths[i]);
    if (!measured_m) continue;
    sums_m_[i] += *measured_m;
    ++counts_[i];
  }
}

double BodySize::difference(const BodyPose& pose, double length_sigma_m) const {
  double sum = 0.0;
  int common = 0;
  for (int i = 0; i < kLengthCount; ++i) {
    const auto measured_m = length_m(pose, kLengths[i]);
    if (!measured_m || counts_[i] == 0) continue;
    const double off = (*measured_m - sums_m_[i] / counts_[i]) / length_sigma_m;
    sum += off * off;
    ++common;
  }
  return common == 0 ? 0.0 : sum / common;
}

}  // namespace limbcast::tracker
