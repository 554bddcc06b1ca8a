#include "modules/pose_fitter/refined/search/arm_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core/fast_math.hpp>
#include <utility>

#include "modules/pose_fitter/refined/cost/image_term.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Cells in which points are taken as explained or not: fine enough for a forearm before a coarse
/// range image, no finer than needed before a camera.
constexpr Real kCellRad = 0.006;
constexpr int kMostCellPx = 3;
/// From the wrist to the hand's middle, and radii along the arm [statures].
constexpr Real kToHand = 0.05;
/// From the wrist to the fingers' base [lengths of the forearm].
constexpr Real kHandPerForearm = 0.3;
constexpr Real kUpperArmRadius = 0.030, kElbowRadius = 0.026, kForearmRadius = 0.022,
               kWristRadius = 0.018;
/// Spread of the surface about an arm that is only guessed [m].
constexpr Real kSampleSigmaM = 0.04;
/// Costs beyond which a half arm, a whole arm is given up.
constexpr Real kHalfArmLimit = 6.0, kArmLimit = 8.0;
/// An elbow may stand so far before the line shoulder-wrist [statures].
constexpr Real kElbowAheadLimit = 0.06, kElbowAheadSigma = 0.04;
/// Postures nearer than this at elbow and wrist are the same [m].
constexpr Real kSamePostureM = 0.14;
/// Cosines to the body's side and front below which no upper arm goes, and the one across the body
/// that only an arm before it has.
constexpr Real kLeastOutwards = -0.75, kLeastForwards = -0.75, kLeastOutwardsBehind = -0.2;
/// The same for arms whose wrist is seen, and cosine of the sharpest elbow.
constexpr Real kLeastCosineOfReach = -0.8, kSharpestElbow = -0.82;
/// Where the shoulder of a hanging arm stands against the neck, and how it rises with the arm
/// [statures]; a short form of shoulder_offset().
constexpr Real kShoulderOutwards = 0.0985, kShoulderUp = -0.0602, kShoulderLift = 0.0225,
               kShoulderForwards = 0.0074;
/// Farther than a straight arm a wrist may be, and nearer to its shoulder it may not [statures].
constexpr Real kOverreach = 0.05, kLeastReach = 0.08;
/// An arm of more than this share of its whole length is straight; an elbow nearer to the line
/// shoulder-wrist than this has no way round it [statures].
constexpr Real kStraightShare = 0.985, kLeastSwivel = 0.02;
constexpr std::size_t kReachTargets = 120;
constexpr int kSwivels = 12;

Real upper_arm_m(Real stature_m) { return stature_m * bones()[0].length; }
Real forearm_m(Real stature_m) { return stature_m * bones()[1].length; }

/// Evenly spread unit vectors (Fibonacci lattice).
std::vector<Vec3> sphere(int count) {
  constexpr Real kGoldenAngle = 2.39996322972865332;
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i) {
    const Real z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(i * kGoldenAngle), r * std::sin(i * kGoldenAngle), z);
  }
  return directions;
}

bool same_posture(const ArmPosture& a, const ArmPosture& b) {
  return (a.wrist - b.wrist).squaredNorm() < kSamePostureM * kSamePostureM &&
         (a.elbow - b.elbow).squaredNorm() < kSamePostureM * kSamePostureM;
}

/// The best `count` that differ, best first; of equal costs the one found first. Thousands are
/// found and few asked for: a heap brings up only as many as are looked at.
std::vector<ArmPosture> best_different(const std::vector<ArmPosture>& found, int count) {
  std::vector<std::pair<Real, int>> heap;
  heap.reserve(found.size());
  for (const ArmPosture& posture : found)
    heap.emplace_back(posture.cost, static_cast<int>(heap.size()));
  std::make_heap(heap.begin(), heap.end(), std::greater<>());
  std::vector<ArmPosture> best;
  while (!heap.empty() && static_cast<int>(best.size()) < count) {
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    const ArmPosture& posture = found[heap.back().second];
    heap.pop_back();
    const auto is_same = [&](const ArmPosture& other) { return same_posture(posture, other); };
    if (std::none_of(best.begin(), best.end(), is_same)) best.push_back(posture);
  }
  return best;
}

}  // namespace

struct ArmSearch::SeenArm {
  const ImageLook& look;
  int side;  ///< of the arm, as the network takes the sides
};

struct ArmSearch::Frame {
  Frame(const BodyState& body, int side)
      : body_rotation(body.rotation),
        shoulder(body.points[kShoulder + side]),
        neck(body.points[kNeck]),
        outwards(body.rotation.col(0) * side_sign(side)),
        up(body.rotation.col(1)),
        front(body.front()),
        stature(body.stature_m()),
        hips_m(hips_depth_m(body)),
        sign(side_sign(side)) {}

  /// Upper arms do not go far across the body or behind it.
  bool upper_arm_possible(const Vec3& direction) const {
    const Real out = direction.dot(outwards), forward = direction.dot(front);
    return out >= kLeastOutwards && forward >= kLeastForwards &&
           (out >= kLeastOutwardsBehind || forward >= 0.0);
  }
  Real elbow_ahead(const Vec3& elbow, const Vec3& wrist) const {
    return (elbow - 0.5 * (shoulder + wrist)).dot(front) / stature;
  }
  static Real elbow_cost(Real ahead) {
    return ahead > 0.0 ? ahead * ahead / (kElbowAheadSigma * kElbowAheadSigma) : 0.0;
  }

  Mat3 body_rotation;
  Vec3 shoulder, neck, outwards, up, front;
  Real stature, hips_m, sign;
  std::vector<SeenArm> seen;  ///< the arm as each network sees it
};

ArmSearch::ArmSearch(const Observation& observation, const RefinedParams& params)
    : observation_(observation),
      params_(params),
      directions_(sphere(params.arm_directions)),
      cell_px_(std::clamp(cvRound(kCellRad * observation.camera.fx), 1, kMostCellPx)) {
  const PinholeCamera& camera = observation.camera;
  grid_width_ = (camera.width + cell_px_ - 1) / cell_px_;
  grid_height_ = (camera.height + cell_px_ - 1) / cell_px_;
  for (int v = 0; v < camera.height; v += cell_px_) {
    for (int u = 0; u < camera.width; u += cell_px_) {
      const float z = observation.smooth_surface_m(u, v);
      if (z <= 0.0F) continue;
      grid_points_.add(
          camera.back_project(static_cast<float>(u), static_cast<float>(v), z).cast<Real>(), 1.0F,
          observation.noise.sigma_m(z));
      grid_cells_.push_back(v / cell_px_ * grid_width_ + u / cell_px_);
    }
  }
  grid_points_.pad();
  for (int u = 0; u < camera.width; ++u) columns_.push_back(u / cell_px_);
  for (int v = 0; v < camera.height; ++v) row_starts_.push_back(v / cell_px_ * grid_width_);
  for (int k = 0; k < kSwivels; ++k) {
    const Real angle_rad = 2.0 * M_PI * k / kSwivels;
    swivels_.emplace_back(std::cos(angle_rad), std::sin(angle_rad));
  }
}

void ArmSearch::mark_unexplained(const BodyState& body, unsigned explained) {
  if (explained == marked_parts_ && body == marked_body_) return;
  marked_body_ = body;
  marked_parts_ = explained;
  nearest_cones(grid_points_, make_cones_of(body), explained, nullptr, nearest_);
  unexplained_.assign(static_cast<std::size_t>(grid_width_) * grid_height_, 0.0F);
  for (std::size_t i = 0; i < grid_points_.size(); ++i) {
    const float beyond = nearest_.distance[i] - 0.02F - grid_points_.sigma_m[i];
    unexplained_[grid_cells_[i]] = std::clamp(beyond / 0.06F, 0.0F, 1.0F);
  }
}

void ArmSearch::look_at_samples() {
  find_pixels(observation_, samples_);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const int u = static_cast<int>(samples_.u[i]), v = static_cast<int>(samples_.v[i]);
    const std::size_t pixel = observation_.at(u, v);
    const float surface_m = observation_.surface_m[pixel];
    samples_.clearance_px[i] = observation_.clearance_px[pixel];
    samples_.surface_m[i] = surface_m;
    samples_.sigma_m[i] = kSampleSigmaM + observation_.noise.sigma_m(surface_m);
    samples_.unexplained[i] = unexplained_[row_starts_[v] + columns_[u]];
  }
  weigh(observation_.camera.fx, samples_);
}

Real ArmSearch::sample_cost(const Vec3& center, Real radius) {
  samples_.clear();
  samples_.add(center, radius);
  look_at_samples();
  return samples_.cost.front();
}

ArmSearch::ImageCosts ArmSearch::image_costs(const Frame& arm, int joint, const Vec3& point) const {
  ImageCosts costs{};
  for (std::size_t i = 0; i < arm.seen.size(); ++i)
    costs[i] = image_cost(arm.seen[i].look, joint + arm.seen[i].side, point, arm.hips_m, params_);
  return costs;
}

Real ArmSearch::sum(const ImageCosts& of_elbow, const ImageCosts& of_wrist) {
  Real cost = 0.0;
  for (std::size_t i = 0; i < of_elbow.size(); ++i) cost += of_elbow[i] + of_wrist[i];
  return cost;
}

void ArmSearch::by_directions(const Frame& arm, std::vector<ArmPosture>& found) {
  const Real upper = upper_arm_m(arm.stature);
  for (const Vec3& upper_direction : directions_) {
    if (!arm.upper_arm_possible(upper_direction)) continue;
    const Vec3 elbow = arm.shoulder + upper * upper_direction;
    const Real half_cost =
        sample_cost(arm.shoulder + 0.5 * upper * upper_direction, kUpperArmRadius * arm.stature) +
        sample_cost(elbow, kElbowRadius * arm.stature);
    if (half_cost <= kHalfArmLimit) add_forearms(arm, upper_direction, elbow, half_cost, found);
  }
}

void ArmSearch::add_forearms(const Frame& arm, const Vec3& upper_direction, const Vec3& elbow,
                             Real half_cost, std::vector<ArmPosture>& found) {
  const Real fore = forearm_m(arm.stature);
  tried_.clear();
  samples_.clear();
  for (const Vec3& direction : directions_) {
    if (upper_direction.dot(direction) < kSharpestElbow) continue;
    const Vec3 wrist = elbow + fore * direction;
    const Real ahead = arm.elbow_ahead(elbow, wrist);
    if (ahead > kElbowAheadLimit) continue;
    tried_.push_back({Frame::elbow_cost(ahead), elbow, wrist});
    samples_.add(elbow + 0.5 * fore * direction, kForearmRadius * arm.stature);
    samples_.add(wrist, kWristRadius * arm.stature);
    samples_.add(wrist + kToHand * arm.stature * direction, kWristRadius * arm.stature);
  }
  look_at_samples();
  const ImageCosts elbow_in_image = image_costs(arm, kElbow, elbow);
  const Real* sample = samples_.cost.data();
  for (const ArmPosture& tried : tried_) {
    const Real forearm_cost = *sample++, wrist_cost = *sample++, hand_cost = *sample++;
    const Real cost = half_cost + forearm_cost + wrist_cost;
    if (cost > kArmLimit) continue;
    const Real more =
        hand_cost + tried.cost + sum(elbow_in_image, image_costs(arm, kWrist, tried.wrist));
    found.push_back({cost + more, elbow, tried.wrist});
  }
}

void ArmSearch::reach(const Frame& arm, const Vec3& surface, std::vector<ArmPosture>& found) {
  const Real upper = upper_arm_m(arm.stature), fore = forearm_m(arm.stature);
  Vec3 wrist = surface * (1.0 + kWristRadius * arm.stature / surface.norm());
  // The shoulder as it stands when the arm goes there.
  const Vec3 lift = arm.body_rotation.transpose() * (wrist - arm.shoulder).normalized();
  const Vec3 shoulder =
      arm.neck + arm.body_rotation * (arm.stature * Vec3(arm.sign * kShoulderOutwards,
                                                         kShoulderUp + kShoulderLift * lift.y(),
                                                         kShoulderForwards));
  const Real distance = (wrist - shoulder).norm();
  if (distance > upper + fore + kOverreach * arm.stature || distance < kLeastReach * arm.stature)
    return;
  const Vec3 along = (wrist - shoulder) / distance;
  Real to_foot = upper, height = 0.0;
  if (distance >= kStraightShare * (upper + fore)) {
    wrist = shoulder + along * (upper + fore);
  } else {
    to_foot = (upper * upper - fore * fore + distance * distance) / (2.0 * distance);
    height = std::sqrt(std::max(0.0, upper * upper - to_foot * to_foot));
  }
  const Vec3 first = along.cross(arm.up).normalized(), second = along.cross(first);
  const int swivels = height < kLeastSwivel * arm.stature ? 1 : kSwivels;
  tried_.clear();
  for (int k = 0; k < swivels; ++k) {
    const auto [cosine, sine] = swivels_[k];
    const Vec3 elbow = shoulder + along * to_foot + height * (cosine * first + sine * second);
    const Real ahead = arm.elbow_ahead(elbow, wrist);
    if (ahead > kElbowAheadLimit) continue;
    const Vec3 upper_direction = (elbow - shoulder) / upper;
    if (upper_direction.dot(arm.outwards) < kLeastCosineOfReach ||
        upper_direction.dot(arm.front) < kLeastCosineOfReach)
      continue;
    tried_.push_back({Frame::elbow_cost(ahead), elbow, wrist});
  }
  add_reaching(arm, shoulder, wrist, found);
}

void ArmSearch::add_reaching(const Frame& arm, const Vec3& shoulder, const Vec3& wrist,
                             std::vector<ArmPosture>& found) {
  samples_.clear();
  samples_.add(wrist, kWristRadius * arm.stature);
  for (const ArmPosture& tried : tried_) {
    const Vec3 fore_direction = (wrist - tried.elbow).normalized();
    samples_.add(0.5 * (shoulder + tried.elbow), kUpperArmRadius * arm.stature);
    samples_.add(tried.elbow, kElbowRadius * arm.stature);
    samples_.add(0.5 * (tried.elbow + wrist), kForearmRadius * arm.stature);
    samples_.add(wrist + kToHand * arm.stature * fore_direction, kWristRadius * arm.stature);
  }
  look_at_samples();
  const ImageCosts wrist_in_image = image_costs(arm, kWrist, wrist);
  const Real* sample = samples_.cost.data();
  const Real wrist_cost = *sample++;
  for (const ArmPosture& tried : tried_) {
    const Real upper_arm_cost = *sample++, elbow_cost = *sample++, forearm_cost = *sample++,
               hand_cost = *sample++;
    const Real cost =
        upper_arm_cost + elbow_cost + forearm_cost + wrist_cost + hand_cost + tried.cost;
    if (cost >= kArmLimit) continue;
    const Real in_image = sum(image_costs(arm, kElbow, tried.elbow), wrist_in_image);
    found.push_back({cost + in_image, tried.elbow, wrist});
  }
}

void ArmSearch::reach_seen_wrist(const Frame& arm, const SeenJoint& seen,
                                 std::vector<ArmPosture>& found) {
  if (seen.visibility <= 0.0) return;
  const float z = observation_.smooth_surface_m(seen);
  if (z > 0.0F) reach(arm, seen.ray * (z / seen.ray.z()), found);
}

void ArmSearch::by_reaching(const Frame& arm, std::vector<ArmPosture>& found) {
  const auto point = [&](std::size_t i) {
    return Vec3(grid_points_.x[i], grid_points_.y[i], grid_points_.z[i]);
  };
  std::vector<std::size_t> unexplained;
  for (std::size_t i = 0; i < grid_points_.size(); ++i) {
    if (unexplained_[grid_cells_[i]] > 0.3F) unexplained.push_back(i);
  }
  const std::size_t step = std::max<std::size_t>(1, unexplained.size() / kReachTargets);
  for (std::size_t i = 0; i < unexplained.size(); i += step)
    reach(arm, point(unexplained[i]), found);
  for (const SeenArm& seen : arm.seen)
    reach_seen_wrist(arm, seen.look.joints[kWrist + seen.side], found);
  const std::size_t all_step = std::max<std::size_t>(1, grid_points_.size() / kReachTargets);
  for (std::size_t i = all_step / 2; i < grid_points_.size(); i += all_step)
    reach(arm, point(i), found);
}

std::vector<ArmPosture> ArmSearch::postures(const BodyState& body, int side, unsigned explained,
                                            int count) {
  mark_unexplained(body, explained);
  Frame arm(body, side);
  for (const ImageLook& look : observation_.looks) {
    const bool swapped = takes_sides_otherwise(body, look, bit(Part::kTrunk), params_);
    arm.seen.push_back({look, swapped ? 1 - side : side});
  }
  std::vector<ArmPosture> found;
  by_directions(arm, found);
  by_reaching(arm, found);
  return best_different(found, count);
}

void set_arm(BodyState& body, int side, const ArmPosture& posture) {
  body.points[kElbow + side] = posture.elbow;
  body.points[kWrist + side] = posture.wrist;
  body.points[kHand + side] = posture.wrist + kHandPerForearm * (posture.wrist - posture.elbow);
}

}  // namespace limbcast::pose_fitter::refined
