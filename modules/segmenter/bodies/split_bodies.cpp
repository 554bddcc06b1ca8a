#include "modules/segmenter/bodies/split_bodies.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "modules/segmenter/bodies/same_person.hpp"
#include "modules/segmenter/networks/network.hpp"
#include "modules/segmenter/seeds/seed_place.hpp"

namespace limbcast::segmenter {
namespace {

constexpr int kHeadJoint = index(Joint::kHead), kFirstLimbJoint = index(Joint::kShoulderLeft);

/// How far from where the segment began the network sees the head [m].
float head_error_m(const PoseInDepths& pose, const Segment& segment) {
  return (pose.places_m[kHeadJoint] - behind_surface(segment.seed_m)).norm();
}

bool sees_head(const PoseInDepths& pose, const SplitBodyParams& params) {
  return log_odds(pose.person_score) >= params.min_person_odds &&
         pose.visibilities[kHeadJoint] >= params.min_head_visibility &&
         pose.spreads_m[kHeadJoint] <= params.max_head_spread_m;
}

/// Whether the network sees a head where the segment began.
bool has_own_head(const PoseInDepths& pose, const Segment& segment, const SplitBodyParams& params) {
  return pose.visibilities[kHeadJoint] >= params.min_own_head_visibility &&
         head_error_m(pose, segment) <= params.max_own_head_error_m;
}

/// Whether the network sees a head in the one clearly worse than in the other.
bool is_seen_worse(const PoseInDepths& pose, const PoseInDepths& other,
                   const SplitBodyParams& params) {
  return pose.visibilities[kHeadJoint] <=
         other.visibilities[kHeadJoint] - params.min_visibility_gap;
}

/// How many of the person's joints that the network sees lie on the other segment.
int count_joints_in(const Scene& scene, const std::vector<std::int16_t>& labels,
                    const PoseInDepths& pose, std::size_t person, std::size_t other,
                    const SplitBodyParams& params) {
  // Squares of the distances of each joint to the nearest point of either segment [m^2].
  std::array<float, kJointCount> own_m2, others_m2;
  own_m2.fill(params.max_joint_distance_m * params.max_joint_distance_m);
  others_m2 = own_m2;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_own = labels[i] == static_cast<std::int16_t>(person);
    if (!is_own && labels[i] != static_cast<std::int16_t>(other)) continue;
    std::array<float, kJointCount>& squares_m2 = is_own ? own_m2 : others_m2;
    for (int joint = kFirstLimbJoint; joint < kJointCount; ++joint) {
      const float square_m2 = (scene.cloud.points_m[i] - pose.places_m[joint]).squaredNorm();
      squares_m2[joint] = std::min(squares_m2[joint], square_m2);
    }
  }
  int count = 0;
  for (int joint = kFirstLimbJoint; joint < kJointCount; ++joint) {
    if (pose.visibilities[joint] >= params.min_joint_visibility && others_m2[joint] < own_m2[joint])
      ++count;
  }
  return count;
}

/// The segments, those first in which the network sees a head the best.
std::vector<std::size_t> by_heads(const PosesInDepths& poses) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (poses[k]) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return poses[a]->visibilities[kHeadJoint] > poses[b]->visibilities[kHeadJoint];
  });
  return order;
}

}  // namespace

bool join_split_bodies(const Scene& scene, const PosesInDepths& poses,
                       const SplitBodyParams& params, std::vector<Segment>& segments,
                       std::vector<std::int16_t>& labels) {
  const auto is_part_of = [&](std::size_t part, std::size_t person) {
    if (part == person || !poses[part] || !segments[part].valid() ||
        (segments[part].seed_m - segments[person].seed_m).norm() > params.max_seeds_apart_m)
      return false;
    int min_joints = params.min_joints_in_part;
    if (has_own_head(*poses[part], segments[part], params)) {
      if (!is_seen_worse(*poses[part], *poses[person], params)) return false;
      min_joints = params.min_joints_beside_head;
    }
    return count_joints_in(scene, labels, *poses[person], person, part, params) >= min_joints;
  };
  bool any = false;
  for (const std::size_t person : by_heads(poses)) {
    if (!segments[person].valid() || !sees_head(*poses[person], params) ||
        head_error_m(*poses[person], segments[person]) > params.max_head_error_m)
      continue;
    for (std::size_t part = 0; part < poses.size(); ++part) {
      if (!is_part_of(part, person)) continue;
      give_to_same_person(part, person, segments, labels);
      any = true;
    }
  }
  return any;
}

bool put_seeds_to_heads(const PosesInDepths& poses, const SplitBodyParams& params,
                        std::vector<Segment>& segments, std::vector<std::int16_t>& labels) {
  bool any = false;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Segment& segment = segments[k];
    if (!poses[k] || !segment.valid() || !sees_head(*poses[k], params) ||
        head_error_m(*poses[k], segment) < params.min_moved_m)
      continue;
    any = true;
    const auto owner = std::find_if(segments.begin(), segments.end(), [&](const Segment& other) {
      return &other != &segment && other.valid() &&
             head_error_m(*poses[k], other) < params.max_same_head_m;
    });
    if (owner != segments.end()) {
      give_to_same_person(k, static_cast<std::size_t>(owner - segments.begin()), segments, labels);
      continue;
    }
    segment.seed_m = surface_before(poses[k]->places_m[kHeadJoint]);
    // It is in sight now.
    if (segment.seed_kind == SeedKind::kBody) segment.seed_kind = SeedKind::kHeadShape;
  }
  return any;
}

}  // namespace limbcast::segmenter
