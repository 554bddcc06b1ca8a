#include "modules/pose_fitter/refined/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

namespace limbcast::pose_fitter::refined {
namespace {

/// Keeps unknowns that nothing observes in place [1 / m^2].
constexpr Real kDampingFloor = 1.0;

/// Row length: a multiple of four, so that rows start alike.
constexpr int kStride = (kUnknownCount + 3) / 4 * 4;

UnknownSet make_set(unsigned parts) {
  UnknownSet set;
  const auto add_point = [&](int point) {
    for (int axis = 0; axis < 3; ++axis) set.unknowns[set.count++] = 3 * point + axis;
  };
  const bool trunk = (parts & bit(Part::kTrunk)) != 0;
  for (int side = 0; side < 2; ++side) {
    if ((parts & arm_bit(side)) == 0) continue;
    for (const int point : {kHand, kWrist, kElbow}) add_point(point + side);
    if (!trunk) add_point(kShoulder + side);
  }
  for (int side = 0; side < 2 && (parts & bit(Part::kLegs)) != 0; ++side) {
    for (const int point : {kToe, kAnkle, kKnee}) add_point(point + side);
  }
  if (trunk) {
    for (const int point :
         {static_cast<int>(kHead), kHip + 0, kHip + 1, static_cast<int>(kChest),
          static_cast<int>(kPelvis), kShoulder + 0, kShoulder + 1, static_cast<int>(kNeck)}) {
      add_point(point);
    }
    for (int i = kLogStature; i < kUnknownCount; ++i) set.unknowns[set.count++] = i;
  }
  return set;
}

float dot(const float* a, const float* b, int count) {
  cv::v_float32x4 first = cv::v_setzero_f32(), second = cv::v_setzero_f32();
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    first = cv::v_muladd(cv::v_load(a + i), cv::v_load(b + i), first);
    second = cv::v_muladd(cv::v_load(a + i + 4), cv::v_load(b + i + 4), second);
  }
  if (i + 4 <= count) {
    first = cv::v_muladd(cv::v_load(a + i), cv::v_load(b + i), first);
    i += 4;
  }
  float sum = cv::v_reduce_sum(first + second);
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

const UnknownSet& unknowns_of(unsigned parts) {
  static const std::array<UnknownSet, kAllParts + 1> sets = [] {
    std::array<UnknownSet, kAllParts + 1> all;
    for (unsigned i = 0; i <= kAllParts; ++i) all[i] = make_set(i);
    return all;
  }();
  return sets[parts];
}

Eigen::Matrix<Real, kUnknownCount, 1> damped_step(const NormalEquations& equations,
                                                  const UnknownSet& set, Real damping) {
  const int n = set.count;
  alignas(16) std::array<float, kUnknownCount * kStride> factor;  // rows of the lower triangle
  alignas(16) std::array<float, kStride> solution{};
  for (int i = 0; i < n; ++i) {
    float* row = &factor[static_cast<std::size_t>(i) * kStride];
    const int a = set.unknowns[i];
    for (int j = 0; j <= i; ++j) {
      const int b = set.unknowns[j];
      row[j] = static_cast<float>(equations.hessian(std::max(a, b), std::min(a, b)));
    }
    row[i] += static_cast<float>(damping * equations.hessian(a, a) + kDampingFloor);
    for (int j = 0; j < i; ++j) {
      const float* other = &factor[static_cast<std::size_t>(j) * kStride];
      row[j] = (row[j] - dot(row, other, j)) * other[j];
    }
    // The diagonal is kept inverted.
    row[i] = 1.0F / std::sqrt(std::max(row[i] - dot(row, row, i), 1e-3F));
    solution[i] =
        (static_cast<float>(-equations.gradient[a]) - dot(row, solution.data(), i)) * row[i];
  }
  Eigen::Matrix<Real, kUnknownCount, 1> step;
  step.setZero();
  for (int i = n - 1; i >= 0; --i) {
    const float* row = &factor[static_cast<std::size_t>(i) * kStride];
    solution[i] *= row[i];
    for (int j = 0; j < i; ++j) solution[j] -= solution[i] * row[j];
    step[set.unknowns[i]] = solution[i];
  }
  return step;
}

}  // namespace limbcast::pose_fitter::refined
