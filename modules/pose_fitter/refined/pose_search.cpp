#include "modules/pose_fitter/refined/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/pose_fitter/refined/image_start.hpp"
#include "modules/pose_fitter/refined/straight_arm.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Steps of the solver at each stage: most of the gain comes in the first ones.
constexpr int kTrunkIterations = 8, kArmIterations = 6, kCombinedIterations = 6;
constexpr int kFirstArmIterations = 2;
/// Arms that are fitted further after the first steps.
constexpr std::size_t kArmsContinued = 6;
constexpr int kFinalIterations = 15, kFlipIterations = 12, kLegIterations = 8, kMoveIterations = 10;
constexpr int kImageStartIterations = 25;
/// A round of moves that wins less than this share is the last.
constexpr Real kLeastRoundGain = 0.01;

void sort_by_cost(std::vector<PoseCandidate>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const PoseCandidate& a, const PoseCandidate& b) { return a.cost < b.cost; });
}

/// Height of the head's centre over the floor, in statures.
constexpr Real kStandingHeadHeight = 0.950, kSittingHeadHeight = 0.724;
constexpr Real kSmallestStatureM = 0.9, kTallestStatureM = 2.05;

/// First guess of the logarithm of stature: from the head's height where the floor is known.
Real log_stature_start(const Observation& observation, const RefinedParams& params, Legs legs) {
  Real stature_m = params.mean_stature_m;
  if (observation.floor_m) {
    const Real head_m = observation.up.dot(observation.head_start) + *observation.floor_m;
    const Real told_m =
        head_m / (legs == Legs::kStanding ? kStandingHeadHeight : kSittingHeadHeight);
    stature_m = std::clamp(told_m, kSmallestStatureM, kTallestStatureM);
  }
  return std::log(stature_m / kReferenceStatureM);
}

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

bool alike(const BodyState& a, const BodyState& b) {
  return (a.front() - b.front()).norm() < 0.5 && (a.points[kKnee] - b.points[kKnee]).norm() < 0.15;
}

bool faces_away(const BodyState& a, const BodyState& b) { return a.front().dot(b.front()) < -0.5; }

}  // namespace

PoseSearch::PoseSearch(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      effort_(observation.has_colors && !observation.looks.empty() ? params.effort_with_image
                                                                   : params.effort),
      solver_(observation, params),
      arms_(observation, params) {}

FitStage PoseSearch::final_stage() const {
  return {&observation_.fine, kAllParts, params_.surface_sigma_m};
}

std::vector<PoseCandidate> PoseSearch::trunk_starts() {
  const FitStage stage{&observation_.coarse, kWithoutArms, params_.search_surface_sigma_m};
  std::vector<PoseCandidate> all;
  for (int k = 0; k < params_.yaw_steps; ++k) {
    for (const Legs legs : {Legs::kStanding, Legs::kSitting}) {
      PoseCandidate pose;
      pose.body =
          rest_body(observation_.head_start, observation_.up, 2.0 * M_PI * k / params_.yaw_steps,
                    log_stature_start(observation_, params_, legs), legs);
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
    if (static_cast<int>(kept.size()) >= effort_.starts_kept) break;
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

std::vector<BodyState> PoseSearch::fitted_arms(const BodyState& body, int side, unsigned explained,
                                               int postures, int count) {
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
  std::vector<BodyState> best;
  for (const PoseCandidate& pose : fitted) {
    const bool known = std::any_of(best.begin(), best.end(), [&](const BodyState& other) {
      return same_arm(pose.body, other, side);
    });
    if (!known) best.push_back(pose.body);
    if (static_cast<int>(best.size()) >= count) break;
  }
  return best;
}

PoseCandidate PoseSearch::with_arms(const BodyState& start) {
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

bool PoseSearch::accept(BodyState body, int iterations, PoseCandidate& pose) {
  const Real cost = solver_.minimize(body, final_stage(), iterations, pose.cost);
  if (cost >= pose.cost) return false;
  pose = {cost, std::move(body)};
  return true;
}

bool PoseSearch::accept_flipped(PoseCandidate flipped, PoseCandidate& pose) {
  const bool better = flipped.cost < pose.cost;
  if (better) std::swap(flipped, pose);
  rejected_.push_back(std::move(flipped));
  return better;
}

bool PoseSearch::try_flip(PoseCandidate& pose) {
  PoseCandidate flipped{0.0, front_back_flipped(pose.body)};
  flipped.cost = solver_.minimize(flipped.body, final_stage(), kFlipIterations);
  return accept_flipped(std::move(flipped), pose);
}

bool PoseSearch::try_flip_with_other_arms(PoseCandidate& pose) {
  return accept_flipped(with_arms(front_back_flipped(pose.body)), pose);
}

std::vector<PoseCandidate> PoseSearch::other_arms(const PoseCandidate& pose, int side) {
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
  bool better = false;
  for (const BodyState& other : fitted_arms(pose.body, side, kAllParts & ~arm_bit(side),
                                            effort_.arm_postures_per_move, effort_.arms_combined)) {
    if (!same_arm(other, pose.body, side)) better |= accept(other, kMoveIterations, pose);
  }
  return better;
}

void PoseSearch::straighten_arm(PoseCandidate& pose, int side) {
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

void PoseSearch::move_limbs(PoseCandidate& pose) {
  try_legs(pose);
  for (int side = 0; side < 2; ++side) try_arm(pose, side);
}

void PoseSearch::move(PoseCandidate& pose) {
  for (int round = 0; round < effort_.move_rounds; ++round) {
    const Real before = pose.cost;
    try_flip(pose);
    if (round == 0) try_flip_with_other_arms(pose);
    move_limbs(pose);
    if (before - pose.cost < kLeastRoundGain * before) break;
  }
}

/// What tells of the front speaks last: in the search it would leave too few bodies that face the
/// other way, whose flips find arms that no other start finds.
void PoseSearch::choose_by_front(std::vector<PoseCandidate>& poses) {
  const auto with_front = [&](const PoseCandidate& pose) {
    return pose.cost + front_cost(pose.body, observation_, params_);
  };
  const auto chosen = std::min_element(poses.begin(), poses.end(),
                                       [&](const PoseCandidate& a, const PoseCandidate& b) {
                                         return with_front(a) < with_front(b);
                                       });
  // What lost by its shape was given up half-way.
  if (chosen != poses.begin()) move_limbs(*chosen);
  for (PoseCandidate& pose : poses) pose.cost = with_front(pose);
  sort_by_cost(poses);
}

std::vector<PoseCandidate> PoseSearch::poses_in_image(const BodyState& like) {
  std::vector<PoseCandidate> poses;
  const std::optional<BodyState> start = body_in_image(observation_, like);
  if (!start) return poses;
  // The network may take left for right.
  for (const BodyState& body : {*start, front_back_flipped(*start)}) {
    PoseCandidate pose{0.0, body};
    pose.cost = solver_.minimize(pose.body, final_stage(), kImageStartIterations);
    poses.push_back(pose);
  }
  return poses;
}

std::vector<PoseCandidate> PoseSearch::run() {
  std::vector<PoseCandidate> poses;
  for (const PoseCandidate& start : trunk_starts()) poses.push_back(with_arms(start.body));
  for (PoseCandidate& pose : poses_in_image(poses.front().body)) poses.push_back(std::move(pose));
  sort_by_cost(poses);
  const int moved_count = std::min<int>(effort_.poses_moved, static_cast<int>(poses.size()));
  for (int i = 0; i < moved_count; ++i) move(poses[i]);
  poses.insert(poses.end(), rejected_.begin(), rejected_.end());
  sort_by_cost(poses);
  choose_by_front(poses);
  for (int side = 0; side < 2; ++side) straighten_arm(poses.front(), side);
  return poses;
}

}  // namespace limbcast::pose_fitter::refined
