#include "modules/pose_fitter/same_person.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/human_model/mean_joint_distance.hpp"

namespace limbcast::pose_fitter {
namespace {

constexpr std::pair<Joint, Joint> kSides[] = {{Joint::kShoulderLeft, Joint::kShoulderRight},
                                              {Joint::kHipLeft, Joint::kHipRight}};

std::optional<float> trunk_distance_m(const BodyPose& a, const BodyPose& b, bool swapped) {
  MeanJointDistance distance;
  for (const Joint joint : {Joint::kNeck, Joint::kChest, Joint::kPelvis}) {
    distance.add(a[joint], b[joint]);
  }
  for (const auto& [left, right] : kSides) {
    distance.add(a[left], b[swapped ? right : left]);
    distance.add(a[right], b[swapped ? left : right]);
  }
  return distance.mean_m();
}

}  // namespace

bool same_place(const BodyPose& a, const BodyPose& b) {
  // One of the two may be fitted back to front.
  for (const bool swapped : {false, true}) {
    const auto trunk_m = trunk_distance_m(a, b, swapped);
    if (trunk_m && *trunk_m < kSameTrunkM) return true;
    if (trunk_m) continue;
    MeanJointDistance heads;
    heads.add(a[Joint::kHead], b[Joint::kHead]);
    return heads.mean_m().value_or(kSameTrunkM) < kSameTrunkM;
  }
  return false;
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
