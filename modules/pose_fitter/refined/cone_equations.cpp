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

constexpr int kStatureVariable = 6, kGirthVariable = 7;

}  // namespace

void ConeEquations::clear() {
  for (Block& block : blocks_) block.used = false;
}

void ConeEquations::add(int cone, Real t, const Vec3& normal, Real radius, Real residual,
                        Real information) {
  Block& block = blocks_[cone];
  if (!block.used) {
    block.hessian.setZero();
    block.gradient.setZero();
    block.used = true;
  }
  Eigen::Matrix<Real, kVariables, 1> row;
  row << (1.0 - t) * normal, t * normal, -radius,
      cone_specs()[cone].grows_with_girth ? -radius : 0.0;
  const Eigen::Matrix<Real, kVariables, 1> weighted = information * row;
  block.gradient += residual * weighted;
  block.hessian += weighted * row.transpose();
}

void ConeEquations::add_to(const BodyState& body, NormalEquations& equations) const {
  using Column = Eigen::Matrix<Real, kVariables, 1>;
  for (int c = 0; c < kConeCount; ++c) {
    const Block& block = blocks_[c];
    if (!block.used) continue;
    const ConePoints& cone = points_of_cones()[c];
    const auto& h = block.hessian;
    for (int i = 0; i < cone.count; ++i) {
      const PointWeights& p = cone.points[i];
      equations.gradient.segment<3>(3 * p.point) +=
          p.in_from * block.gradient.head<3>() + p.in_to * block.gradient.segment<3>(3);
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
      equations.gradient[unknown] += columns[i].dot(block.gradient);
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
