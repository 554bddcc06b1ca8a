#include "modules/pose_fitter/refined/search/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "common/simd.hpp"

namespace limbcast::pose_fitter::refined {
namespace {

/// Keeps unknowns that nothing observes in place [1 / m^2].
constexpr Real kDampingFloor = 1.0;

/// Least pivot: keeps rounding from making one negative.
constexpr float kLeastPivot = 1e-3F;

/// Rows that are eliminated at once. Each adds up its own products in the same order whatever the
/// width of the processor's vectors, so that steps are the same everywhere.
constexpr int kRowsAtOnce = 8;
using Rows = Float8;
/// Partial sums of a row's products.
constexpr int kSums = 8;

/// Rows of the unknowns and of the right side, up to whole vectors.
constexpr int kStride = (kUnknownCount + 1 + kRowsAtOnce - 1) / kRowsAtOnce * kRowsAtOnce;

/// The lower triangle by columns with the negative gradient as its last row, which elimination
/// turns into the solution of the forward substitution. Rows begin at `first`, so that the last
/// ones, with the most columns, fill a vector.
struct Triangle {
  explicit Triangle(int unknowns)
      : count(unknowns),
        rows((unknowns + kRowsAtOnce) / kRowsAtOnce * kRowsAtOnce),
        first(rows - unknowns - 1) {}

  float* column(int j) { return &columns[static_cast<std::size_t>(j) * kStride]; }
  Rows& rows_at(int j, int row) { return *reinterpret_cast<Rows*>(column(j) + row); }

  int count, rows, first;
  alignas(sizeof(Rows)) std::array<float, kUnknownCount * kStride> columns;
};

void fill(const NormalEquations& equations, const UnknownSet& set, Real damping,
          Triangle& triangle) {
  const std::uint16_t* place = set.hessian_places.data();
  for (int j = 0; j < set.count; ++j) {
    const int diagonal = triangle.first + j;
    float* column = triangle.column(j);
    std::fill(column + diagonal / kRowsAtOnce * kRowsAtOnce, column + diagonal, 0.0F);
    const Real pivot = equations.hessian.data()[*place];
    for (int row = diagonal; row < triangle.rows - 1; ++row)
      column[row] = static_cast<float>(equations.hessian.data()[*place++]);
    column[diagonal] += static_cast<float>(damping * pivot + kDampingFloor);
    column[triangle.rows - 1] = static_cast<float>(-equations.gradient[set.unknowns[j]]);
  }
}

/// Cholesky's factor in place, its diagonal inverted.
LIMBCAST_SIMD void eliminate(Triangle& triangle) {
  for (int row = 0; row < triangle.rows; row += kRowsAtOnce) {
    const int columns = std::min(triangle.count, row + kRowsAtOnce - triangle.first);
    for (int j = 0; j < columns; ++j) {
      const int diagonal = triangle.first + j;
      Rows sums[kSums] = {};
      int k = 0;
      for (; k + kSums <= j; k += kSums) {
        for (int s = 0; s < kSums; ++s)
          sums[s] += triangle.rows_at(k + s, row) * triangle.column(k + s)[diagonal];
      }
      if (k + kSums / 2 <= j) {
        for (int s = 0; s < kSums / 2; ++s)
          sums[s] += triangle.rows_at(k + s, row) * triangle.column(k + s)[diagonal];
        k += kSums / 2;
      }
      for (int s = 0; s < kSums / 2; ++s) sums[s] += sums[s + kSums / 2];
      Rows sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
      for (; k < j; ++k) sum += triangle.rows_at(k, row) * triangle.column(k)[diagonal];
      Rows& rest = triangle.rows_at(j, row);
      rest -= sum;
      float& pivot = triangle.column(j)[diagonal];
      if (diagonal < row) {
        rest *= pivot;
      } else {
        const float inverse = 1.0F / std::sqrt(std::max(pivot, kLeastPivot));
        rest *= inverse;
        pivot = inverse;
      }
    }
  }
}

/// The last row times the inverse of the transposed factor: later unknowns are taken off first.
LIMBCAST_SIMD void substitute_back(Triangle& triangle, std::array<float, kStride>& solution) {
  for (int j = 0; j < triangle.count; ++j)
    solution[triangle.first + j] = triangle.column(j)[triangle.rows - 1];
  for (int row = triangle.rows - kRowsAtOnce; row >= 0; row -= kRowsAtOnce) {
    const int begin = std::max(row, triangle.first),
              end = std::min(row + kRowsAtOnce, triangle.rows - 1);
    for (int i = end - 1; i >= begin; --i) {
      solution[i] *= triangle.column(i - triangle.first)[i];
      for (int j = begin; j < i; ++j)
        solution[j] -= solution[i] * triangle.column(j - triangle.first)[i];
    }
    for (int j = triangle.first; j < begin; ++j) {
      const float* column = triangle.column(j - triangle.first);
      for (int i = end - 1; i >= begin; --i) solution[j] -= solution[i] * column[i];
    }
  }
}

}  // namespace

Eigen::Matrix<Real, kUnknownCount, 1> damped_step(const NormalEquations& equations,
                                                  const UnknownSet& set, Real damping) {
  Triangle triangle(set.count);
  fill(equations, set, damping, triangle);
  eliminate(triangle);
  std::array<float, kStride> solution;
  substitute_back(triangle, solution);
  Eigen::Matrix<Real, kUnknownCount, 1> step;
  step.setZero();
  for (int i = 0; i < set.count; ++i) step[set.unknowns[i]] = solution[triangle.first + i];
  return step;
}

}  // namespace limbcast::pose_fitter::refined
