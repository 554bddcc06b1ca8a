#include "modules/pose_fitter/refined/search/pose_moves.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "modules/pose_fitter/refined/search/straight_arm.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Steps of the solver at each stage: most of the gain comes in the first ones.
constexpr int kArmIterations = 6, kFirstArmIterations = 2, kCombinedIterations = 6;
constexpr int kFinalIterations = 15, kFlipIterations = 12, kLegIterations = 8, kMoveIterations = 10;
/// Arms that are fitted further after the first steps.
constexpr std::size_t kArmsContinued = 6;
/// A round of moves that wins less than this share is the last.
constexpr Real kLeastRoundGain = 0.01;

/// Arms nearer than this at elbow and wrist end in the same minimum [m].
constexpr Real kSameArmM = 0.07;

bool same_arm(const BodyState& a, const BodyState& b, int side) {
  return (a.points[kWrist + side] - b.points[kWrist + side]).norm() < kSameArmM &&
         (a.points[kElbow + side] - b.points[kElbow + side]).norm() < kSameArmM;
}

void copy_arm(const BodyState& from, int side, BodyState& to) {
  for (const int point : {kShoulder, kElbow, kWrist, kHand}) {
    to.points[point + side] = from.points[point + side];
  }
}

}  // namespace

void sort_by_cost(std::vector<PoseCandidate>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.cost < b.cost; });
}

PoseMoves::PoseMoves(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      effort_(effort_for(observation, params)),
      solver_(observation, params),
      arms_(observation, params) {}

const SearchEffort& PoseMoves::effort_for(const Observation& observation,
                                          const RefinedParams& params) {
  return observation.looks.empty() ? params.effort : params.effort_with_image;
}

FitStage PoseMoves::final_stage() const {
  return {&observation_.fine, kAllParts, params_.surface_sigma_m};
}

const std::vector<PoseCandidate>& PoseMoves::fit_arms(const BodyState& body, int side,
                                                      unsigned explained, int postures) {
  FittedArms& last = fitted_arms_[side];
  if (last.postures == postures && last.explained == explained && last.body == body)
    return last.fits;
  NearestCones fixed;
  nearest_cones(observation_.coarse, make_cones_of(body), explained, nullptr, fixed);
  const FitStage stage{&observation_.coarse, arm_bit(side), params_.arm_search_surface_sigma_m,
                       &fixed};
  std::vector<PoseCandidate> fitted;
  for (const ArmPosture& posture : arms_.postures(body, side, explained, postures)) {
    PoseCandidate pose{0.0, body};
    set_arm(pose.body, side, posture);
    pose.cost = solver_.minimize(pose.body, stage, kFirstArmIterations);
    fitted.push_back(pose);
  }
  // Most are known to be bad after the first steps.
  sort_by_cost(fitted);
  if (fitted.size() > kArmsContinued) fitted.resize(kArmsContinued);
  for (PoseCandidate& pose : fitted)
    pose.cost = solver_.minimize(pose.body, stage, kArmIterations - kFirstArmIterations);
  sort_by_cost(fitted);
  last = {body, explained, postures, std::move(fitted)};
  return last.fits;
}

std::vector<BodyState> PoseMoves::fitted_arms(const BodyState& body, int side, unsigned explained,
                                              int postures, int count) {
  std::vector<BodyState> best;
  for (const PoseCandidate& pose : fit_arms(body, side, explained, postures)) {
    const bool known = std::any_of(best.begin(), best.end(), [&](const BodyState& other) {
      return same_arm(pose.body, other, side);
    });
    if (!known) best.push_back(pose.body);
    if (static_cast<int>(best.size()) >= count) break;
  }
  return best;
}

PoseCandidate PoseMoves::with_arms(const BodyState& start) {
  const FitStage coarse{&observation_.coarse, kAllParts, params_.arm_search_surface_sigma_m};
  std::array<std::vector<BodyState>, 2> arms;
  for (int side = 0; side < 2; ++side) {
    arms[side] = fitted_arms(start, side, kWithoutArms, effort_.arm_postures_per_start,
                             effort_.arms_combined);
    if (arms[side].empty()) arms[side].push_back(start);
  }
  PoseCandidate best{1e18, start};
  for (const BodyState& left : arms[0]) {
    for (const BodyState& right : arms[1]) {
      BodyState body = start;
      copy_arm(left, 0, body);
      copy_arm(right, 1, body);
      const Real cost = solver_.minimize(body, coarse, kCombinedIterations);
      if (cost < best.cost) best = {cost, body};
    }
  }
  best.cost = solver_.minimize(best.body, final_stage(), kFinalIterations);
  return best;
}

bool PoseMoves::accept(BodyState body, int iterations, PoseCandidate& pose) {
  const Real cost = solver_.minimize(body, final_stage(), iterations, pose.cost);
  if (cost >= pose.cost) return false;
  pose = {cost, std::move(body)};
  return true;
}

PoseCandidate PoseMoves::flipped(const BodyState& body) {
  PoseCandidate pose{0.0, front_back_flipped(body)};
  pose.cost = solver_.minimize(pose.body, final_stage(), kFlipIterations);
  return pose;
}

std::vector<PoseCandidate> PoseMoves::other_arms(const PoseCandidate& pose, int side) {
  NearestCones fixed;
  nearest_cones(observation_.fine, make_cones_of(pose.body), kAllParts & ~arm_bit(side), nullptr,
                fixed);
  const FitStage stage{&observation_.fine, arm_bit(side), params_.surface_sigma_m, &fixed};
  BodyState present = pose.body;
  const Real present_cost = solver_.minimize(present, stage, kArmIterations);
  std::vector<PoseCandidate> others;
  for (const BodyState& start : fitted_arms(pose.body, side, kAllParts & ~arm_bit(side),
                                            effort_.arm_postures_per_move, params_.rival_arms)) {
    PoseCandidate other{0.0, start};
    other.cost = solver_.minimize(other.body, stage, kArmIterations) - present_cost;
    others.push_back(other);
  }
  return others;
}

bool PoseMoves::try_legs(PoseCandidate& pose) {
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

bool PoseMoves::try_arm(PoseCandidate& pose, int side) {
  bool better = false;
  for (const BodyState& other : fitted_arms(pose.body, side, kAllParts & ~arm_bit(side),
                                            effort_.arm_postures_per_move, effort_.arms_combined)) {
    if (!same_arm(other, pose.body, side)) better |= accept(other, kMoveIterations, pose);
  }
  return better;
}

void PoseMoves::straighten_arm(PoseCandidate& pose, int side) {
  std::optional<PoseCandidate> best;
  for (BodyState& body : with_straight_arm(pose.body, side)) {
    const Real cost =
        solver_.minimize(body, final_stage(), kFinalIterations, pose.cost + kBentArmCost) +
        front_cost(body, observation_, params_);
    if (is_straight_and_raised(body, side) && (!best || cost < best->cost))
      best = {cost, std::move(body)};
  }
  if (best && best->cost < pose.cost + kBentArmCost)
    pose = {std::min(pose.cost, best->cost), std::move(best->body)};
}

void PoseMoves::move_limbs(PoseCandidate& pose) {
  try_legs(pose);
  for (int side = 0; side < 2; ++side) try_arm(pose, side);
}

void PoseMoves::move(PoseCandidate& pose, std::vector<PoseCandidate>& rejected) {
  const auto keep_better = [&](PoseCandidate other) {
    if (other.cost < pose.cost) std::swap(other, pose);
    rejected.push_back(std::move(other));
  };
  for (int round = 0; round < effort_.move_rounds; ++round) {
    const Real before = pose.cost;
    keep_better(flipped(pose.body));
    if (round == 0) keep_better(with_arms(front_back_flipped(pose.body)));
    move_limbs(pose);
    if (before - pose.cost < kLeastRoundGain * before) break;
  }
}

}  // namespace limbcast::pose_fitter::refined
