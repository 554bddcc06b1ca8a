#include "modules/pose_fitter/refined/cone_equations.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// What a body point weighs in the two ends of a cone.
struct PointWeights {
  int point;
  Real in_from, in_to;
};

struct ConePoints {
  std::array<PointWeights, 6> points;
  int count = 0;

  void add(int point, Real in_from, Real in_to) {
    for (int i = 0; i < count; ++i) {
      if (points[i].point != point) continue;
      points[i].in_from += in_from;
      points[i].in_to += in_to;
      return;
    }
    points[count++] = {point, in_from, in_to};
  }
};

const std::array<ConePoints, kConeCount>& points_of_cones() {
  static const std::array<ConePoints, kConeCount> all = [] {
    std::array<ConePoints, kConeCount> result;
    for (int i = 0; i < kConeCount; ++i) {
      for (const Weight& w : cone_specs()[i].from) {
        if (w.weight != 0.0) result[i].add(w.point, w.weight, 0.0);
      }
      for (const Weight& w : cone_specs()[i].to) {
        if (w.weight != 0.0) result[i].add(w.point, 0.0, w.weight);
      }
    }
    return result;
  }();
  return all;
}

constexpr int kVariables = 8, kStatureVariable = 6, kGirthVariable = 7;
using Matrix = Eigen::Matrix<Real, kVariables, kVariables>;

Mat3 symmetric(const std::array<float, 6>& sums) {
  Mat3 matrix;
  matrix << sums[0], sums[1], sums[2], sums[1], sums[3], sums[4], sums[2], sums[4], sums[5];
  return matrix;
}

Vec3 vector(const std::array<float, 3>& sums) { return {sums[0], sums[1], sums[2]}; }

}  // namespace

void ConeEquations::clear() { sums_.fill(Sums{}); }

void ConeEquations::add(int cone, float t, const Eigen::Vector3f& normal, float radius,
                        float residual, float information) {
  Sums& sums = sums_[cone];
  sums.used = true;
  const float from = 1.0F - t, x = normal.x(), y = normal.y(), z = normal.z();
  const std::array<float, 6> normals = {x * x, x * y, x * z, y * y, y * z, z * z};
  const float weight_from = information * from * from, weight_mixed = information * from * t,
              weight_to = information * t * t;
  for (int i = 0; i < 6; ++i) {
    sums.normals_from[i] += weight_from * normals[i];
    sums.normals_mixed[i] += weight_mixed * normals[i];
    sums.normals_to[i] += weight_to * normals[i];
  }
  for (int i = 0; i < 3; ++i) {
    sums.radius_from[i] += information * radius * from * normal[i];
    sums.radius_to[i] += information * radius * t * normal[i];
    sums.residual_from[i] += information * residual * from * normal[i];
    sums.residual_to[i] += information * residual * t * normal[i];
  }
  sums.radius2 += information * radius * radius;
  sums.radius_residual += information * radius * residual;
}

void ConeEquations::add_to(const BodyState& body, NormalEquations& equations) const {
  using Column = Eigen::Matrix<Real, kVariables, 1>;
  for (int c = 0; c < kConeCount; ++c) {
    const Sums& sums = sums_[c];
    if (!sums.used) continue;
    const Real girth = cone_specs()[c].grows_with_girth ? 1.0 : 0.0;
    Matrix h;
    h << symmetric(sums.normals_from), symmetric(sums.normals_mixed), -vector(sums.radius_from),
        -girth * vector(sums.radius_from), symmetric(sums.normals_mixed),
        symmetric(sums.normals_to), -vector(sums.radius_to), -girth * vector(sums.radius_to),
        -vector(sums.radius_from).transpose(), -vector(sums.radius_to).transpose(), sums.radius2,
        girth * sums.radius2, -girth * vector(sums.radius_from).transpose(),
        -girth * vector(sums.radius_to).transpose(), girth * sums.radius2, girth * sums.radius2;
    Column gradient;
    gradient << vector(sums.residual_from), vector(sums.residual_to), -sums.radius_residual,
        -girth * sums.radius_residual;
    const ConePoints& cone = points_of_cones()[c];
    for (int i = 0; i < cone.count; ++i) {
      const PointWeights& p = cone.points[i];
      equations.gradient.segment<3>(3 * p.point) +=
          p.in_from * gradient.head<3>() + p.in_to * gradient.segment<3>(3);
      for (int j = 0; j < cone.count; ++j) {
        const PointWeights& q = cone.points[j];
        if (q.point > p.point) continue;
        equations.hessian.block<3, 3>(3 * p.point, 3 * q.point) +=
            (p.in_from * q.in_from) * h.block<3, 3>(0, 0) +
            (p.in_from * q.in_to) * h.block<3, 3>(0, 3) +
            (p.in_to * q.in_from) * h.block<3, 3>(3, 0) + (p.in_to * q.in_to) * h.block<3, 3>(3, 3);
      }
    }
    // Stature, girth and rotation move both ends alike by the forward offset.
    const Real offset_m = cone_specs()[c].forward_offset * body.stature_m();
    std::array<Column, 4> columns;
    columns.fill(Column::Zero());
    const auto both_ends = [&](int i, const Vec3& change) {
      columns[i].head<3>() = change;
      columns[i].segment<3>(3) = change;
    };
    both_ends(0, offset_m * body.front());
    columns[0][kStatureVariable] = 1.0;
    columns[1][kGirthVariable] = 1.0;
    both_ends(2, -offset_m * body.rotation.col(1));
    both_ends(3, offset_m * body.rotation.col(0));
    for (int i = 0; i < 4; ++i) {  // turning about the front itself moves nothing
      const int unknown = kLogStature + i;
      const Column product = h * columns[i];
      equations.gradient[unknown] += columns[i].dot(gradient);
      for (int k = 0; k < cone.count; ++k) {
        const PointWeights& p = cone.points[k];
        equations.hessian.block<1, 3>(unknown, 3 * p.point) +=
            (p.in_from * product.head<3>() + p.in_to * product.segment<3>(3)).transpose();
      }
      for (int j = 0; j <= i; ++j)
        equations.hessian(unknown, kLogStature + j) += product.dot(columns[j]);
    }
  }
}

}  // namespace limbcast::pose_fitter::refined
