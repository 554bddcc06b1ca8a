#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace limbcast::segmenter {

/// A network with one hidden layer that tells how likely its input is what it was trained for.
struct Network {
  using Weights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Weights hidden_weights;  ///< a row for each hidden unit, a column for each input
  Eigen::VectorXf hidden_bias, output_weights;
  float output_bias = 0.0F;

  /// Log odds. `input` must hold one value for each column of hidden_weights.
  float log_odds(const std::vector<float>& input) const;
  /// The same of many inputs, one a row.
  Eigen::VectorXf log_odds(const Weights& inputs) const;
};

/// Weights as they stand in the program text: 8 bits each, one scale a row.
struct StoredNetwork {
  int inputs, hidden;
  const float* row_scales;         ///< hidden
  const std::int8_t* row_weights;  ///< hidden * inputs
  const float* hidden_bias;        ///< hidden
  const float* output_weights;     ///< hidden
  float output_bias;
};

Network unpack(const StoredNetwork& stored);

inline float probability(float log_odds) { return 1.0F / (1.0F + std::exp(-log_odds)); }
/// The same back; finite for 0 and 1 too.
inline float log_odds(float probability) {
  constexpr float kLeast = 1e-6F;
  return std::log(std::max(kLeast, probability) / std::max(kLeast, 1.0F - probability));
}

/// Bounded and steep at zero, as tanh, without a call: x / (1 + |x|).
inline float soft_sign(float x) { return x / (1.0F + (x < 0.0F ? -x : x)); }

}  // namespace limbcast::segmenter
