#include "modules/pose_fitter/same_person.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace limbcast::pose_fitter {
namespace {

/// Mean distance over the pairs of joints that both bodies have.
class MeanDistance {
 public:
  void add(const JointEstimate& a, const JointEstimate& b) {
    if (!a.valid || !b.valid) return;
    sum_m_ += (a.position_m - b.position_m).norm();
    ++count_;
  }
  std::optional<float> mean_m() const {
    if (count_ == 0) return std::nullopt;
    return sum_m_ / static_cast<float>(count_);
  }

 private:
  float sum_m_ = 0.0F;
  int count_ = 0;
};

constexpr std::pair<Joint, Joint> kSides[] = {{Joint::kShoulderLeft, Joint::kShoulderRight},
                                              {Joint::kHipLeft, Joint::kHipRight}};

std::optional<float> trunk_distance_m(const BodyPose& a, const BodyPose& b, bool swapped) {
  MeanDistance distance;
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
    MeanDistance heads;
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
