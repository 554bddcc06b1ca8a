#include "modules/pose_fitter/refined/cost/cone_equations.hpp"

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

/// Sums over a cone's residuals. Row of the Jacobian: ((1 - t) n, t n, -r, -r); so n n^T with
/// three weights, r n and e n with two, and r^2, e r say all.
struct Sums {
  std::array<float, 6> normals_from{}, normals_mixed{}, normals_to{};  ///< xx xy xz yy yz zz
  std::array<float, 3> radius_from{}, radius_to{}, residual_from{}, residual_to{};
  float radius2 = 0.0F, radius_residual = 0.0F;
  bool used = false;

  void add(float t, const Eigen::Vector3f& normal, float radius, float residual,
           float information) {
    used = true;
    const float from = 1.0F - t, x = normal.x(), y = normal.y(), z = normal.z();
    const std::array<float, 6> normals = {x * x, x * y, x * z, y * y, y * z, z * z};
    const float weight_from = information * from * from, weight_mixed = information * from * t,
                weight_to = information * t * t;
    for (int i = 0; i < 6; ++i) {
      normals_from[i] += weight_from * normals[i];
      normals_mixed[i] += weight_mixed * normals[i];
      normals_to[i] += weight_to * normals[i];
    }
    for (int i = 0; i < 3; ++i) {
      radius_from[i] += information * radius * from * normal[i];
      radius_to[i] += information * radius * t * normal[i];
      residual_from[i] += information * residual * from * normal[i];
      residual_to[i] += information * residual * t * normal[i];
    }
    radius2 += information * radius * radius;
    radius_residual += information * radius * residual;
  }
};

using Column = Eigen::Matrix<Real, kVariables, 1>;

/// The normal equations of one cone in its own variables.
struct OwnEquations {
  Matrix hessian;
  Column gradient;

  OwnEquations(const Sums& sums, bool grows_with_girth) {
    const Real girth = grows_with_girth ? 1.0 : 0.0;
    const Mat3 from = symmetric(sums.normals_from), mixed = symmetric(sums.normals_mixed),
               to = symmetric(sums.normals_to);
    const Vec3 radius_from = vector(sums.radius_from), radius_to = vector(sums.radius_to);
    hessian << from, mixed, -radius_from, -girth * radius_from, mixed, to, -radius_to,
        -girth * radius_to, -radius_from.transpose(), -radius_to.transpose(), sums.radius2,
        girth * sums.radius2, -girth * radius_from.transpose(), -girth * radius_to.transpose(),
        girth * sums.radius2, girth * sums.radius2;
    gradient << vector(sums.residual_from), vector(sums.residual_to), -sums.radius_residual,
        -girth * sums.radius_residual;
  }
};

void add_points(const OwnEquations& own, const ConePoints& cone, NormalEquations& equations) {
  const Matrix& h = own.hessian;
  for (int i = 0; i < cone.count; ++i) {
    const PointWeights& p = cone.points[i];
    if (!equations.wants_point(p.point)) continue;
    equations.gradient.segment<3>(3 * p.point) +=
        p.in_from * own.gradient.head<3>() + p.in_to * own.gradient.segment<3>(3);
    for (int j = 0; j < cone.count; ++j) {
      const PointWeights& q = cone.points[j];
      if (q.point > p.point || !equations.wants_point(q.point)) continue;
      equations.hessian.block<3, 3>(3 * p.point, 3 * q.point) +=
          (p.in_from * q.in_from) * h.block<3, 3>(0, 0) +
          (p.in_from * q.in_to) * h.block<3, 3>(0, 3) +
          (p.in_to * q.in_from) * h.block<3, 3>(3, 0) + (p.in_to * q.in_to) * h.block<3, 3>(3, 3);
    }
  }
}

/// How a cone's variables change with stature, girth and rotation (turning about the front itself
/// moves nothing), which move both ends alike by the forward offset.
std::array<Column, 4> size_and_rotation(const BodyState& body, Real offset_m) {
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
  return columns;
}

void add_size_and_rotation(const OwnEquations& own, const ConePoints& cone,
                           const std::array<Column, 4>& columns, NormalEquations& equations) {
  for (int i = 0; i < 4; ++i) {
    const int unknown = kLogStature + i;
    const Column product = own.hessian.lazyProduct(columns[i]);
    equations.gradient[unknown] += columns[i].dot(own.gradient);
    for (int k = 0; k < cone.count; ++k) {
      const PointWeights& p = cone.points[k];
      equations.hessian.block<1, 3>(unknown, 3 * p.point) +=
          (p.in_from * product.head<3>() + p.in_to * product.segment<3>(3)).transpose();
    }
    for (int j = 0; j <= i; ++j)
      equations.hessian(unknown, kLogStature + j) += product.dot(columns[j]);
  }
}

}  // namespace

void ConeEquations::Columns::resize(std::size_t size) {
  cone.resize(size);
  for (auto* column : {&t, &x, &y, &z, &radius, &residual, &information}) column->resize(size);
}

void ConeEquations::add_to(const BodyState& body, NormalEquations& equations) const {
  std::array<Sums, kConeCount> sums;
  for (std::size_t i = 0; i < many_.cone.size(); ++i) {
    if (many_.cone[i] < 0) continue;
    sums[many_.cone[i]].add(many_.t[i], {many_.x[i], many_.y[i], many_.z[i]}, many_.radius[i],
                            many_.residual[i], many_.information[i]);
  }
  for (const Row& row : rows_)
    sums[row.cone].add(row.t, row.normal, row.radius, row.residual, row.information);
  const Real stature_m = body.stature_m();
  for (int c = 0; c < kConeCount; ++c) {
    if (!sums[c].used) continue;
    const ConeSpec& spec = cone_specs()[c];
    const OwnEquations own(sums[c], spec.grows_with_girth);
    const ConePoints& points = points_of_cones()[c];
    add_points(own, points, equations);
    if (!equations.wants(kLogStature)) continue;
    add_size_and_rotation(own, points, size_and_rotation(body, spec.forward_offset * stature_m),
                          equations);
  }
}

}  // namespace limbcast::pose_fitter::refined
