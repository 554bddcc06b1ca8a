#include "modules/pose_fitter/refined/search/pose_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "modules/pose_fitter/refined/search/image_start.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Steps of the solver: most of the gain comes in the first ones.
constexpr int kTrunkIterations = 8, kImageStartIterations = 25;

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

bool alike(const BodyState& a, const BodyState& b) {
  return (a.front() - b.front()).norm() < 0.5 && (a.points[kKnee] - b.points[kKnee]).norm() < 0.15;
}

bool faces_away(const BodyState& a, const BodyState& b) { return a.front().dot(b.front()) < -0.5; }

}  // namespace

PoseSearch::PoseSearch(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      effort_(PoseMoves::effort_for(observation, params)),
      moves_([&] { return PoseMoves(observation, params); }) {}

void PoseSearch::minimize(std::vector<PoseCandidate>& poses, const FitStage& stage,
                          int iterations) {
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t i) {
    poses[i].cost = moves().solver().minimize(poses[i].body, stage, iterations);
  });
}

std::vector<PoseCandidate> PoseSearch::trunk_starts() {
  std::vector<PoseCandidate> all;
  for (int k = 0; k < params_.yaw_steps; ++k) {
    for (const Legs legs : {Legs::kStanding, Legs::kSitting}) {
      const Real yaw_rad = 2.0 * M_PI * k / params_.yaw_steps;
      all.push_back({0.0, rest_body(observation_.head_start, observation_.up, yaw_rad,
                                    log_stature_start(observation_, params_, legs), legs)});
    }
  }
  minimize(all, {&observation_.coarse, kWithoutArms, params_.search_surface_sigma_m},
           kTrunkIterations);
  sort_by_cost(all);
  return kept_starts(std::move(all));
}

std::vector<PoseCandidate> PoseSearch::kept_starts(std::vector<PoseCandidate> all) const {
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
  if (chosen != poses.begin()) moves().move_limbs(*chosen);
  for (PoseCandidate& pose : poses) pose.cost = with_front(pose);
  sort_by_cost(poses);
}

std::vector<PoseCandidate> PoseSearch::poses_in_image(const BodyState& like) {
  std::vector<PoseCandidate> poses;
  for (const ImageLook* look : looks_to_start_from(observation_)) {
    const std::optional<BodyState> start = body_in_image(observation_, *look, like);
    if (!start) continue;
    // It may take left for right.
    poses.push_back({0.0, *start});
    poses.push_back({0.0, front_back_flipped(*start)});
  }
  minimize(poses, moves().final_stage(), kImageStartIterations);
  return poses;
}

void PoseSearch::move_best(std::vector<PoseCandidate>& poses) {
  const std::size_t count = std::min(static_cast<std::size_t>(effort_.poses_moved), poses.size());
  std::vector<std::vector<PoseCandidate>> rejected(count);
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { moves().move(poses[i], rejected[i]); });
  for (std::vector<PoseCandidate>& others : rejected)
    std::move(others.begin(), others.end(), std::back_inserter(poses));
}

std::vector<PoseCandidate> PoseSearch::run() {
  std::vector<PoseCandidate> poses = trunk_starts();
  tbb::parallel_for(std::size_t{0}, poses.size(),
                    [&](std::size_t i) { poses[i] = moves().with_arms(poses[i].body); });
  for (PoseCandidate& pose : poses_in_image(poses.front().body)) poses.push_back(std::move(pose));
  sort_by_cost(poses);
  move_best(poses);
  sort_by_cost(poses);
  choose_by_front(poses);
  for (int side = 0; side < 2; ++side) moves().straighten_arm(poses.front(), side);
  return poses;
}

}  // namespace limbcast::pose_fitter::refined
