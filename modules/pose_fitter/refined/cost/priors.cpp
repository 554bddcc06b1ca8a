#include "modules/pose_fitter/refined/cost/priors.hpp"

#include <algorithm>
#include <cmath>

// Lengths and spreads without a unit are in statures; spreads of proportions are those of adults
// (ANSUR II) found again on the tuning half, those of postures are wide and chosen there.
namespace limbcast::pose_fitter::refined {
namespace {

constexpr Real kUprightSigma = 0.12;           // sine of the trunk's lean to the side
constexpr Real kUprightForwardSigma = 0.1755;  // and to the front
/// A thick body farther away looks from the front as a thin one nearer does, and what tells them
/// apart shares its errors: the girth fitted with people's true spread of 0.10 has hardly to do
/// with the true one (tests/accuracy).
constexpr Real kLogGirthSigma = 0.04;
constexpr Real kStatureLimitSigmas = 3.0;
constexpr Real kSymmetrySigmaM = 0.006;
constexpr Real kHandSigma = 0.012;
constexpr Real kPenetrationSigmaM = 0.02;
/// Upper arms of people who point, wave, walk or stand akimbo (truth of D1-D3 and of simulated
/// people) do not reach farther behind the trunk's plane than this, as a cosine: a raised arm, and
/// what a hanging one may more. A body taken back to front would need it.
constexpr Real kArmBehindLimit = -0.37, kHangingArmBehindMore = -0.30, kArmBehindSigma = 0.08;
/// Ankles of who stands or sits are this high over the floor, no lower; who walks or climbs lifts
/// one.
constexpr Real kAnkleHeight = 0.046, kAnkleBelowSigma = 0.012, kAnkleAboveSigma = 0.020;
constexpr Real kAnkleLimitSigmas = 2.0;

}  // namespace

void Priors::offset(int point, int reference, const Vec3& mean, const Vec3& sigma) {
  const Vec3 local = body_.rotation.transpose() * (body_.points[point] - body_.points[reference]);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 direction = body_.rotation.col(axis);
    equations_.start_row();
    equations_.derivative_of_point(point, direction);
    equations_.derivative_of_point(reference, -direction);
    equations_.derivative(kLogStature, -stature_ * mean[axis]);
    // R exp(w): the local vector turns by local x w.
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    equations_.derivative(kRotation + next, -local[last]);
    equations_.derivative(kRotation + last, local[next]);
    equations_.add_residual(local[axis] - stature_ * mean[axis], sigma[axis] * stature_);
  }
}

void Priors::bone(int from, int to, Real length, Real relative_sigma) {
  const Vec3 between = body_.points[to] - body_.points[from];
  const Real distance = between.norm() + 1e-9;
  equations_.start_row();
  equations_.derivative_of_point(to, between / distance);
  equations_.derivative_of_point(from, -between / distance);
  equations_.derivative(kLogStature, -length * stature_);
  equations_.add_residual(distance - length * stature_, relative_sigma * length * stature_);
}

void Priors::symmetry(int from, int to) {
  equations_.start_row();
  Real difference = 0.0;
  for (int side = 0; side < 2; ++side) {
    const Vec3 between = body_.points[to + side] - body_.points[from + side];
    const Real distance = between.norm() + 1e-9;
    difference += side_sign(side) * distance;
    equations_.derivative_of_point(to + side, side_sign(side) * between / distance);
    equations_.derivative_of_point(from + side, -side_sign(side) * between / distance);
  }
  equations_.add_residual(difference, kSymmetrySigmaM);
}

void Priors::hand(int side) {
  constexpr Real kHandShare = 0.30;  // of the forearm, wrist to the hand's middle
  const int elbow = kElbow + side, wrist = kWrist + side, hand = kHand + side;
  const Vec3 residual = body_.points[hand] - body_.points[wrist] -
                        kHandShare * (body_.points[wrist] - body_.points[elbow]);
  for (int axis = 0; axis < 3; ++axis) {
    equations_.start_row();
    equations_.derivative(3 * hand + axis, 1.0);
    equations_.derivative(3 * wrist + axis, -1.0 - kHandShare);
    equations_.derivative(3 * elbow + axis, kHandShare);
    equations_.add_residual(residual[axis], kHandSigma * stature_);
  }
}

void Priors::knee(int side) {
  const int hip = kHip + side, knee = kKnee + side, ankle = kAnkle + side;
  const Vec3 front = body_.front();
  const Real ahead =
      front.dot(body_.points[knee] - 0.5 * (body_.points[hip] + body_.points[ankle])) -
      0.01 * stature_;
  if (ahead >= 0.0) return;
  equations_.start_row();
  equations_.derivative_of_point(knee, front);
  equations_.derivative_of_point(hip, -0.5 * front);
  equations_.derivative_of_point(ankle, -0.5 * front);
  equations_.add_residual(ahead, 0.012 * stature_);
}

void Priors::elbow(int side) {
  const int shoulder = kShoulder + side, elbow = kElbow + side, wrist = kWrist + side;
  const Vec3 local = body_.rotation.transpose() *
                     (body_.points[elbow] - 0.5 * (body_.points[shoulder] + body_.points[wrist]));
  const Vec3 mean(side_sign(side) * 0.015, -0.01, -0.012), sigma(0.05, 0.05, 0.035);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 direction = body_.rotation.col(axis);
    equations_.start_row();
    equations_.derivative_of_point(elbow, direction);
    equations_.derivative_of_point(shoulder, -0.5 * direction);
    equations_.derivative_of_point(wrist, -0.5 * direction);
    equations_.add_residual(local[axis] - stature_ * mean[axis], sigma[axis] * stature_);
  }
  const Vec3 reach = body_.points[wrist] - body_.points[shoulder];
  const Real distance = reach.norm() + 1e-9, folded = distance - 0.09 * stature_;
  if (folded >= 0.0) return;
  equations_.start_row();
  equations_.derivative_of_point(wrist, reach / distance);
  equations_.derivative_of_point(shoulder, -reach / distance);
  equations_.add_residual(folded, 0.01 * stature_);
}

void Priors::shoulder_limit(int side) {
  const int shoulder = kShoulder + side, elbow = kElbow + side;
  const Vec3 local = body_.rotation.transpose() * (body_.points[elbow] - body_.points[shoulder]);
  const Real length = local.norm() + 1e-9;
  const Real hanging = std::max(0.0, -local.y() / length);
  const Real beyond = local.z() - (kArmBehindLimit + kHangingArmBehindMore * hanging) * length;
  if (beyond >= 0.0) return;
  const Vec3 front = body_.front();
  equations_.start_row();
  equations_.derivative_of_point(elbow, front);
  equations_.derivative_of_point(shoulder, -front);
  equations_.derivative(kRotation + 0, -local.y());
  equations_.derivative(kRotation + 1, local.x());
  equations_.add_residual(beyond, kArmBehindSigma * length);
}

void Priors::outside_trunk(int point) {
  const Vec3& p = body_.points[point];
  Real nearest = 0.0, place = 0.0;
  Vec3 away = Vec3::Zero();
  int inside = -1;
  for (int c = 0; c < kConeCount; ++c) {
    if (!cone_specs()[c].blocks_arms) continue;
    const Real t = cones_[c].nearest(p);
    const Vec3 from_axis = p - cones_[c].point(t);
    const Real gap = from_axis.norm() - cones_[c].radius(t) - 0.02 * stature_;
    if (gap < nearest) {
      nearest = gap;
      place = t;
      away = from_axis;
      inside = c;
    }
  }
  if (inside < 0) return;
  const Vec3 normal = away / (away.norm() + 1e-9);
  equations_.start_row();
  equations_.derivative_of_point(point, normal);
  add_anchor(cone_specs()[inside].from, -(1.0 - place) * normal);
  add_anchor(cone_specs()[inside].to, -place * normal);
  equations_.add_residual(nearest, kPenetrationSigmaM);
}

void Priors::limbs_apart(int a0, int a1, int b0, int b1) {
  constexpr int kSteps = 4;
  Real best = 1e9, t = 0.0, u = 0.0;
  Vec3 between = Vec3::Zero();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Real ti = static_cast<Real>(i) / kSteps, uj = static_cast<Real>(j) / kSteps;
      const Vec3 d = body_.points[a0] * (1 - ti) + body_.points[a1] * ti -
                     body_.points[b0] * (1 - uj) - body_.points[b1] * uj;
      if (d.squaredNorm() < best) {
        best = d.squaredNorm();
        t = ti;
        u = uj;
        between = d;
      }
    }
  }
  const Real distance = std::sqrt(best) + 1e-9, gap = distance - 0.045 * stature_;
  if (gap >= 0.0) return;
  between /= distance;
  equations_.start_row();
  equations_.derivative_of_point(a0, (1 - t) * between);
  equations_.derivative_of_point(a1, t * between);
  equations_.derivative_of_point(b0, -(1 - u) * between);
  equations_.derivative_of_point(b1, -u * between);
  equations_.add_residual(gap, kPenetrationSigmaM);
}

void Priors::ground(int side, const Vec3& up, Real floor_m) {
  const int ankle = kAnkle + side;
  const Real above = up.dot(body_.points[ankle]) + floor_m - kAnkleHeight * stature_;
  equations_.start_row();
  equations_.derivative_of_point(ankle, up);
  equations_.derivative(kLogStature, -kAnkleHeight * stature_);
  if (above < 0.0) {
    equations_.add_residual(above, kAnkleBelowSigma * stature_);
  } else {
    equations_.add_robust_residual(above, kAnkleAboveSigma * stature_, kAnkleLimitSigmas);
  }
}

void Priors::upright(const Vec3& up) {
  const Vec3 local = body_.rotation.transpose() * up;
  equations_.start_row();
  equations_.derivative(kRotation + 1, -local.z());
  equations_.derivative(kRotation + 2, local.y());
  equations_.add_residual(local.x(), kUprightSigma);
  equations_.start_row();
  equations_.derivative(kRotation, -local.y());
  equations_.derivative(kRotation + 1, local.x());
  equations_.add_residual(local.z(), kUprightForwardSigma);
}

void Priors::head(const Vec3& start, Real sigma_m) {
  for (int axis = 0; axis < 3; ++axis) {
    equations_.start_row();
    equations_.derivative(3 * kHead + axis, 1.0);
    equations_.add_residual(body_.points[kHead][axis] - start[axis], sigma_m);
  }
}

void Priors::log_girth() {
  equations_.start_row();
  equations_.derivative(kLogGirth, 1.0);
  equations_.add_residual(body_.log_girth, kLogGirthSigma);
}

void Priors::log_stature(Real mean, Real sigma) {
  equations_.start_row();
  equations_.derivative(kLogStature, 1.0);
  equations_.add_robust_residual(body_.log_stature - mean, sigma, kStatureLimitSigmas);
}

void Priors::add_anchor(const Anchor& anchor, const Vec3& derivative) {
  for (const Weight& w : anchor) {
    if (w.weight != 0.0) equations_.derivative_of_point(w.point, w.weight * derivative);
  }
}

}  // namespace limbcast::pose_fitter::refined
