#pragma once

#include <cstdint>
#include <vector>

namespace limbcast::segmenter {

/// A network with one hidden layer that tells how likely its input is what it was trained for.
struct Network {
  int inputs = 0, hidden = 0;
  std::vector<float> hidden_weights;  ///< hidden rows of inputs + 1 (bias last)
  std::vector<float> output_weights;  ///< hidden + 1 (bias last)

  /// Log odds. `input` must hold `inputs` values.
  float log_odds(const std::vector<float>& input) const;
};

/// Weights as they stand in the program text: 8 bits each, one scale a row.
struct StoredNetwork {
  int inputs, hidden;
  const float* row_scales;         ///< hidden
  const std::int8_t* row_weights;  ///< hidden * (inputs + 1)
  const float* output_weights;     ///< hidden + 1
};

Network unpack(const StoredNetwork& stored);

/// Bounded and steep at zero, as tanh, without a call: x / (1 + |x|).
inline float soft_sign(float x) { return x / (1.0F + (x < 0.0F ? -x : x)); }

}  // namespace limbcast::segmenter
