#include "modules/pose_fitter/refined/assessment.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kDegree = M_PI / 180.0;
/// An arm points when it is bent by less and raised from the trunk by more than this.
constexpr Real kMostBend = 45.0 * kDegree, kLeastRaise = 32.0 * kDegree;
/// Weight of points that must lie on forearm and hand for a direction to be told.
constexpr Real kLeastSupport = 1.0;

Real angle(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
}

/// Weight of the points that lie on forearm and hand.
std::array<Real, 2> lower_arm_support(const BodyState& body, const PointColumns& points) {
  NearestCones nearest;
  nearest_cones(points, make_cones_of(body), kAllParts, nullptr, nearest);
  std::array<Real, 2> support{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ConeSpec& cone = cone_specs()[nearest.cone[i]];
    if (!cone.lower_arm || std::abs(nearest.distance[i]) > 0.05F + 2.0F * points.sigma_m[i])
      continue;
    support[cone.part == Part::kLeftArm ? 0 : 1] += points.weight[i];
  }
  return support;
}

struct PointingArm {
  int side;
  Real score;
};

std::vector<PointingArm> pointing_arms(const BodyState& body, const std::array<Real, 2>& support) {
  std::vector<PointingArm> arms;
  const Vec3 down_trunk = body.points[kPelvis] - body.points[kNeck];
  for (int side = 0; side < 2; ++side) {
    if (support[side] <= kLeastSupport) continue;
    const Vec3 upper = body.points[kElbow + side] - body.points[kShoulder + side];
    const Vec3 fore = body.points[kWrist + side] - body.points[kElbow + side];
    const Real bend = angle(upper, fore), raise = angle(upper + fore, down_trunk);
    if (bend < kMostBend && raise > kLeastRaise) arms.push_back({side, raise - 0.5 * bend});
  }
  std::stable_sort(arms.begin(), arms.end(),
                   [](const PointingArm& a, const PointingArm& b) { return a.score > b.score; });
  return arms;
}

}  // namespace

std::optional<BodyPose> assess(const std::vector<PoseCandidate>& candidates, Solver& solver,
                               const FitStage& stage) {
  const PoseCandidate& best = candidates.front();
  BodyPose pose;
  const auto direction = [&](int from, int to) {
    return Vec3(best.body.points[to] - best.body.points[from]).normalized().cast<float>().eval();
  };
  for (int i = 0; i < kJointCount; ++i) {
    pose.joints[i].valid = true;
    pose.joints[i].position_m = best.body.points[i].cast<float>();
    pose.joints[i].confidence = 1.0F;
  }
  (void)solver;
  pose.error = static_cast<float>(best.cost / static_cast<Real>(stage.points->size()));
  pose.scale = static_cast<float>(best.body.stature_m() / kReferenceStatureM);
  for (const PointingArm& arm :
       pointing_arms(best.body, lower_arm_support(best.body, *stage.points))) {
    Pointing pointing;
    pointing.side = arm.side == 0 ? Side::kLeft : Side::kRight;
    pointing.direction = direction(kShoulder + arm.side, kWrist + arm.side);
    pointing.forearm = direction(kElbow + arm.side, kWrist + arm.side);
    pointing.head_hand = direction(kHead, kWrist + arm.side);
    pointing.confidence = 1.0F;
    pose.pointing.push_back(pointing);
  }
  pose.confidence = 1.0F;
  return pose;
}

}  // namespace limbcast::pose_fitter::refined
