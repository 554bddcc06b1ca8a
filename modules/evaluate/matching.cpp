#include "modules/evaluate/matching.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace limbcast::evaluate {
namespace {

constexpr std::array<Joint, 4> kTrunk = {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis};

struct DistanceSum {
  float sum_m = 0.0F;
  int count = 0;
  void add(const JointEstimate& a, const JointEstimate& b) {
    if (!a.valid || !b.valid) return;
    sum_m += (a.position_m - b.position_m).norm();
    ++count;
  }
};

struct Pair {
  float distance_m;
  std::size_t truth, report;
  bool operator<(const Pair& other) const {
    return std::tie(distance_m, truth, report) <
           std::tie(other.distance_m, other.truth, other.report);
  }
};

std::vector<Pair> near_pairs(const std::vector<BodyPose>& truth,
                             const std::vector<BodyPose>& reported, float max_distance_m) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t r = 0; r < reported.size(); ++r) {
      const auto distance_m = person_distance_m(truth[t], reported[r]);
      if (distance_m && *distance_m <= max_distance_m) pairs.push_back({*distance_m, t, r});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

std::optional<float> person_distance_m(const BodyPose& a, const BodyPose& b) {
  DistanceSum trunk, all;
  for (const Joint joint : kTrunk) trunk.add(a[joint], b[joint]);
  for (int i = 0; i < kJointCount; ++i) all.add(a.joints[i], b.joints[i]);
  const DistanceSum& used = trunk.count > 0 ? trunk : all;
  if (used.count == 0) return std::nullopt;
  return used.sum_m / static_cast<float>(used.count);
}

Matching match_persons(const std::vector<BodyPose>& truth, const std::vector<BodyPose>& reported,
                       float max_distance_m) {
  Matching matching{std::vector<std::optional<std::size_t>>(truth.size()),
                    std::vector<ReportKind>(reported.size(), ReportKind::kInvented)};
  for (const Pair& pair : near_pairs(truth, reported, max_distance_m)) {
    ReportKind& kind = matching.kinds[pair.report];
    if (kind == ReportKind::kMatched) continue;
    if (matching.report_of_truth[pair.truth]) {
      kind = ReportKind::kTwice;
      continue;
    }
    matching.report_of_truth[pair.truth] = pair.report;
    kind = ReportKind::kMatched;
  }
  return matching;
}

}  // namespace limbcast::evaluate
