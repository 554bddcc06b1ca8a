#include "modules/pose_fitter/refined/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limbcast::pose_fitter::refined {
namespace {

/// Steps of the solver at each stage: most of the gain comes in the first ones.
constexpr int kTrunkIterations = 8, kArmIterations = 8, kFinalIterations = 15;
constexpr int kFlipIterations = 12, kLegIterations = 8, kMoveCoarseIterations = 6,
              kMoveIterations = 10;
/// A round of moves that wins less than this share is the last.
constexpr Real kLeastRoundGain = 0.01;

void sort_by_cost(std::vector<PoseCandidate>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.cost < b.cost; });
}

bool alike(const BodyState& a, const BodyState& b) {
  return (a.front() - b.front()).norm() < 0.5 && (a.points[kKnee] - b.points[kKnee]).norm() < 0.15;
}

bool faces_away(const BodyState& a, const BodyState& b) { return a.front().dot(b.front()) < -0.5; }

}  // namespace

PoseSearch::PoseSearch(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      solver_(observation, params),
      arms_(observation, params) {}

FitStage PoseSearch::final_stage() const {
  return {&observation_.fine, kAllParts, params_.surface_sigma_m};
}

std::vector<PoseCandidate> PoseSearch::trunk_starts() {
  const FitStage stage{&observation_.coarse, kWithoutArms, params_.search_surface_sigma_m};
  std::vector<PoseCandidate> all;
  const Real log_stature = std::log(params_.mean_stature_m / kReferenceStatureM);
  for (int k = 0; k < params_.yaw_steps; ++k) {
    for (const Legs legs : {Legs::kStanding, Legs::kSitting}) {
      PoseCandidate pose;
      pose.body = rest_body(observation_.head_start, observation_.up,
                            2.0 * M_PI * k / params_.yaw_steps, log_stature, legs);
      pose.cost = solver_.minimize(pose.body, stage, kTrunkIterations);
      all.push_back(pose);
    }
  }
  sort_by_cost(all);
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& pose : all) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const PoseCandidate& other) {
      return alike(pose.body, other.body);
    });
    if (!known) kept.push_back(pose);
    if (static_cast<int>(kept.size()) >= params_.starts_kept) break;
  }
  // Front and back look alike: always carry one that faces the other way.
  const auto away = [&](const PoseCandidate& pose) {
    return faces_away(pose.body, kept.front().body);
  };
  if (std::none_of(kept.begin(), kept.end(), away)) {
    const auto other = std::find_if(all.begin(), all.end(), away);
    if (other != all.end()) kept.push_back(*other);
  }
  return kept;
}

PoseCandidate PoseSearch::with_arms(const BodyState& start) {
  const FitStage coarse{&observation_.coarse, kAllParts, params_.arm_search_surface_sigma_m};
  std::array<std::vector<ArmPosture>, 2> postures;
  for (int side = 0; side < 2; ++side) {
    postures[side] = arms_.postures(start, side, kWithoutArms, params_.arm_postures_per_start);
  }
  PoseCandidate best{1e18, start};
  int best_left = 0;
  const auto try_pair = [&](int left, int right) {
    BodyState body = start;
    if (left < static_cast<int>(postures[0].size())) set_arm(body, 0, postures[0][left]);
    if (right < static_cast<int>(postures[1].size())) set_arm(body, 1, postures[1][right]);
    const Real cost = solver_.minimize(body, coarse, kArmIterations);
    if (cost < best.cost) {
      best = {cost, body};
      best_left = left;
    }
  };
  for (int left = 0; left < std::max<int>(1, static_cast<int>(postures[0].size())); ++left)
    try_pair(left, 0);
  const int chosen = best_left;
  for (int right = 1; right < static_cast<int>(postures[1].size()); ++right)
    try_pair(chosen, right);
  best.cost = solver_.minimize(best.body, final_stage(), kFinalIterations);
  return best;
}

bool PoseSearch::accept(BodyState body, int iterations, PoseCandidate& pose) {
  const Real cost = solver_.minimize(body, final_stage(), iterations);
  if (cost >= pose.cost) return false;
  pose = {cost, std::move(body)};
  return true;
}

bool PoseSearch::try_flip(PoseCandidate& pose) {
  return accept(front_back_flipped(pose.body), kFlipIterations, pose);
}

bool PoseSearch::try_legs(PoseCandidate& pose) {
  BodyState swapped = pose.body;
  for (const int left :
       {static_cast<int>(kKnee), static_cast<int>(kAnkle), static_cast<int>(kToe)}) {
    std::swap(swapped.points[left], swapped.points[left + 1]);
  }
  bool better = accept(swapped, kLegIterations, pose);
  for (const Legs legs : {Legs::kStanding, Legs::kSitting}) {
    BodyState other = pose.body;
    set_legs(other, legs);
    Real change = 0.0;
    for (int i = kKnee; i < kHand; ++i)
      change = std::max(change, (other.points[i] - pose.body.points[i]).norm());
    if (change > 0.12) better |= accept(other, kLegIterations, pose);
  }
  return better;
}

bool PoseSearch::try_arm(PoseCandidate& pose, int side) {
  const FitStage coarse{&observation_.coarse, kAllParts, params_.surface_sigma_m};
  const std::vector<ArmPosture> postures =
      arms_.postures(pose.body, side, kAllParts & ~arm_bit(side), params_.arm_postures_per_move);
  PoseCandidate best{1e18, {}};
  for (const ArmPosture& posture : postures) {
    if ((posture.wrist - pose.body.points[kWrist + side]).norm() < 0.07 &&
        (posture.elbow - pose.body.points[kElbow + side]).norm() < 0.07) {
      continue;
    }
    BodyState body = pose.body;
    set_arm(body, side, posture);
    const Real cost = solver_.minimize(body, coarse, kMoveCoarseIterations);
    if (cost < best.cost) best = {cost, body};
  }
  return best.cost < 1e17 && accept(best.body, kMoveIterations, pose);
}

void PoseSearch::move(PoseCandidate& pose) {
  for (int round = 0; round < params_.move_rounds; ++round) {
    const Real before = pose.cost;
    try_flip(pose);
    try_legs(pose);
    for (int side = 0; side < 2; ++side) try_arm(pose, side);
    if (before - pose.cost < kLeastRoundGain * before) break;
  }
}

std::vector<PoseCandidate> PoseSearch::run() {
  std::vector<PoseCandidate> poses;
  for (const PoseCandidate& start : trunk_starts()) poses.push_back(with_arms(start.body));
  sort_by_cost(poses);
  const int moved_count = std::min<int>(params_.poses_moved, static_cast<int>(poses.size()));
  for (int i = 0; i < moved_count; ++i) move(poses[i]);
  sort_by_cost(poses);
  return poses;
}

}  // namespace limbcast::pose_fitter::refined
