#include "modules/pose_fitter/same_person.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "common/human_model/mean_joint_distance.hpp"

namespace limbcast::pose_fitter {
namespace {

constexpr std::array<Joint, 4> kSpine = {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis};

float distance_from_line_m(const Eigen::Vector3f& point, const Eigen::Vector3f& from,
                           const Eigen::Vector3f& to) {
  const Eigen::Vector3f line = to - from;
  const float length2 = std::max(line.squaredNorm(), std::numeric_limits<float>::min());
  const float along = std::clamp((point - from).dot(line) / length2, 0.0F, 1.0F);
  return (point - from - along * line).norm();
}

/// Nothing where fewer than two joints of the spine are told.
std::optional<float> distance_from_spine_m(const Eigen::Vector3f& point, const BodyPose& body) {
  std::optional<float> nearest_m;
  const JointEstimate* above = nullptr;
  for (const Joint joint : kSpine) {
    const JointEstimate& below = body[joint];
    if (!below.valid) continue;
    if (above != nullptr) {
      const float distance_m = distance_from_line_m(point, above->position_m, below.position_m);
      nearest_m = std::min(distance_m, nearest_m.value_or(distance_m));
    }
    above = &below;
  }
  return nearest_m;
}

/// How far the trunk of one body stands beside the spine of another; nothing where too few of their
/// joints are told.
std::optional<float> beside_spine_m(const BodyPose& trunk, const BodyPose& spine) {
  float sum_m = 0.0F;
  int count = 0;
  for (const Joint joint : {Joint::kNeck, Joint::kChest}) {
    if (!trunk[joint].valid) continue;
    const auto distance_m = distance_from_spine_m(trunk[joint].position_m, spine);
    if (!distance_m) return std::nullopt;
    sum_m += *distance_m;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum_m / static_cast<float>(count);
}

}  // namespace

bool same_place(const BodyPose& a, const BodyPose& b) {
  const auto a_m = beside_spine_m(a, b), b_m = beside_spine_m(b, a);
  if (a_m || b_m)
    return std::min(a_m.value_or(kSameSpineM), b_m.value_or(kSameSpineM)) < kSameSpineM;
  MeanJointDistance heads;
  heads.add(a[Joint::kHead], b[Joint::kHead]);
  return heads.mean_m().value_or(kSameSpineM) < kSameSpineM;
}

void remove_double_reports(std::vector<BodyPose>& persons) {
  std::vector<std::size_t> by_confidence(persons.size());
  for (std::size_t i = 0; i < persons.size(); ++i) by_confidence[i] = i;
  std::stable_sort(by_confidence.begin(), by_confidence.end(), [&](std::size_t a, std::size_t b) {
    return persons[a].confidence > persons[b].confidence;
  });
  std::vector<std::size_t> kept;
  for (const std::size_t candidate : by_confidence) {
    const bool is_double = std::any_of(kept.begin(), kept.end(), [&](std::size_t other) {
      return same_place(persons[candidate], persons[other]);
    });
    if (!is_double) kept.push_back(candidate);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<BodyPose> remaining;
  for (const std::size_t i : kept) remaining.push_back(persons[i]);
  persons = std::move(remaining);
}

}  // namespace limbcast::pose_fitter
