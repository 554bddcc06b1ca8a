#include "modules/evaluate/matching.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "common/human_model/mean_joint_distance.hpp"

namespace limbcast::evaluate {
namespace {

constexpr std::array<Joint, 4> kTrunk = {Joint::kHead, Joint::kNeck, Joint::kChest, Joint::kPelvis};

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
  MeanJointDistance trunk, all;
  for (const Joint joint : kTrunk) trunk.add(a[joint], b[joint]);
  for (int i = 0; i < kJointCount; ++i) all.add(a.joints[i], b.joints[i]);
  return trunk.mean_m() ? trunk.mean_m() : all.mean_m();
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
