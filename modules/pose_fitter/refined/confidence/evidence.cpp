#include "modules/pose_fitter/refined/confidence/evidence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "common/angle.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

using Covariance = Eigen::Matrix<Real, kUnknownCount, kUnknownCount>;

/// Radii of the body about its points, in statures.
constexpr std::array<Real, kPointCount> kPointRadius = {
    0.055, 0.034, 0.075, 0.080, 0.040, 0.040, 0.025, 0.025, 0.017, 0.017,
    0.065, 0.065, 0.038, 0.038, 0.030, 0.030, 0.020, 0.020, 0.020, 0.020};
/// A point that lies deeper behind the seen surface than its radius and this is hidden [m].
constexpr Real kHiddenM = 0.08;
/// An arm whose axis differs by more is another arm: cosine of 20 degrees.
constexpr Real kOtherArmCosine = 0.94;
constexpr Real kNoRival = 1e3;

Real worst_sigma(const Mat3& covariance) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
}

Covariance posterior(const NormalEquations& equations) {
  Covariance information = equations.hessian.selfadjointView<Eigen::Lower>();
  information.diagonal().array() += 1e-6;
  return Eigen::LLT<Covariance>(information).solve(Covariance::Identity());
}

Real axis_sigma(const BodyState& body, const Covariance& covariance, int side) {
  const int from = 3 * (kShoulder + side), to = 3 * (kWrist + side);
  const Vec3 arm = body.points[kWrist + side] - body.points[kShoulder + side];
  const Mat3 difference = covariance.block<3, 3>(to, to) + covariance.block<3, 3>(from, from) -
                          covariance.block<3, 3>(to, from) - covariance.block<3, 3>(from, to);
  const Vec3 direction = arm.normalized();
  const Mat3 across = Mat3::Identity() - direction * direction.transpose();
  return worst_sigma(across * difference * across) / (arm.norm() + 1e-9);
}

/// Surface the sensor saw near a pixel, the nearest one; 0 where it saw nothing or through.
Real seen_surface(const Observation& observation, const Vec3& point) {
  const auto [u, v] = observation.pixel_of(point);
  Real nearest = 0.0;
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      if (!observation.inside(x, y)) continue;
      const Real z = observation.seen_m[observation.at(x, y)];
      if (z > 0.0 && (nearest <= 0.0 || z < nearest)) nearest = z;
    }
  }
  return nearest;
}

bool in_sight(const Observation& observation, const Vec3& point, Real radius) {
  if (point.z() < 0.1) return false;
  const auto [u, v] = observation.pixel_of(point);
  if (!observation.in_sensor_image(u, v)) return false;
  const Real surface = seen_surface(observation, point);
  const Real noise = 2.0 * observation.noise.sigma_m(static_cast<float>(point.z()));
  return surface <= 0.0 || surface > point.z() - radius - kHiddenM - noise;
}

Real surface_cost_without(const Cones& cones, const FitStage& stage, unsigned parts,
                          Real robust_sigmas) {
  const auto workspace = std::make_unique<Workspace>();
  const auto equations = std::make_unique<NormalEquations>();
  equations->clear(false);
  FitStage reduced = stage;
  reduced.parts = parts;
  add_surface_term(cones, reduced, robust_sigmas, *workspace, *equations);
  return equations->cost;
}

Real weight_of(const PointColumns& points) {
  return std::max(1e-3, std::accumulate(points.weight.begin(), points.weight.end(), 0.0));
}

Vec3 arm_axis(const BodyState& body, int side) {
  return (body.points[kWrist + side] - body.points[kShoulder + side]).normalized();
}

bool faces_the_other_way(const BodyState& a, const BodyState& b) {
  return a.front().dot(b.front()) < 0.0;
}

/// Least of what bodies facing the other way cost more than the best, by `cost_of` a candidate.
template <class CostOf>
Real flip_gap(const std::vector<PoseCandidate>& candidates, const CostOf& cost_of) {
  const PoseCandidate& best = candidates.front();
  Real gap = kNoRival;
  for (const PoseCandidate& rival : candidates) {
    if (faces_the_other_way(rival.body, best.body))
      gap = std::min(gap, cost_of(rival) - cost_of(best));
  }
  return gap;
}

/// Rivals are other bodies that face the same way, and other arms of the best one.
Real arm_gap(const std::vector<PoseCandidate>& candidates, int side, PoseMoves& moves) {
  const PoseCandidate& best = candidates.front();
  const auto is_rival = [&](const BodyState& body) {
    return !faces_the_other_way(body, best.body) &&
           arm_axis(body, side).dot(arm_axis(best.body, side)) < kOtherArmCosine;
  };
  Real gap = kNoRival;
  for (const PoseCandidate& rival : candidates) {
    if (is_rival(rival.body)) gap = std::min(gap, rival.cost - best.cost);
  }
  for (const PoseCandidate& rival : moves.other_arms(best, side)) {
    if (is_rival(rival.body)) gap = std::min(gap, rival.cost);
  }
  return gap;
}

}  // namespace

Evidence gather_evidence(const std::vector<PoseCandidate>& candidates, PoseMoves& moves) {
  Evidence evidence;
  const PoseCandidate& best = candidates.front();
  const BodyState& body = best.body;
  Solver& solver = moves.solver();
  const Observation& observation = solver.observation();
  const FitStage stage = moves.final_stage();
  const Cones cones = make_cones_of(body);

  const auto equations = std::make_unique<NormalEquations>();
  const CostTerms terms = solver.evaluate_at(body, stage, *equations);
  evidence.surface_cost = terms.surface;
  evidence.prior_cost = terms.priors;
  const Covariance covariance = posterior(*equations);
  for (int i = 0; i < kPointCount; ++i) {
    evidence.sigma_m[i] = worst_sigma(covariance.block<3, 3>(3 * i, 3 * i));
    evidence.in_sight[i] =
        in_sight(observation, body.points[i], kPointRadius[i] * body.stature_m());
  }
  evidence.weight = weight_of(*stage.points);
  evidence.images = image_evidence(body, observation, solver.params());

  evidence.flip_gap = flip_gap(candidates, [](const PoseCandidate& pose) { return pose.cost; });
  evidence.shape_flip_gap = flip_gap(candidates, [&](const PoseCandidate& pose) {
    return pose.cost - front_cost(pose.body, observation, solver.params());
  });
  const Vec3 front = body.front();
  evidence.face_agreement = face_agreement(front, observation);
  evidence.has_colors = observation.has_colors;
  evidence.face_seen = observation.face.facing_log_odds > 0.0F;
  evidence.sideways = sideways(front, observation);
  for (int side = 0; side < 2; ++side) {
    ArmEvidence& arm = evidence.arms[side];
    arm.bend_rad = angle_rad(body.points[kElbow + side] - body.points[kShoulder + side],
                             body.points[kWrist + side] - body.points[kElbow + side]);
    arm.sigma_rad = axis_sigma(body, covariance, side);
    const Vec3 axis = arm_axis(body, side);
    if (const auto seen_axis = seen_arm_axis(body, observation, side, evidence.images))
      arm.off_seen_axis_rad = angle_rad(axis, *seen_axis);
    arm.forwards = axis.dot(body.front());
    arm.outwards = axis.dot(body.rotation.col(0)) * side_sign(side);
    arm.support = surface_cost_without(cones, stage, kAllParts & ~arm_bit(side),
                                       solver.params().robust_sigmas) -
                  terms.surface;
    arm.gap = arm_gap(candidates, side, moves);
  }
  return evidence;
}

}  // namespace limbcast::pose_fitter::refined
