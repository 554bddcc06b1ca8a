#include "modules/segmenter/network.hpp"

namespace limbcast::segmenter {

float Network::log_odds(const std::vector<float>& input) const {
  const auto stride = static_cast<std::size_t>(inputs) + 1;
  float sum = output_weights[static_cast<std::size_t>(hidden)];
  for (std::size_t h = 0; h < static_cast<std::size_t>(hidden); ++h) {
    const float* row = hidden_weights.data() + h * stride;
    float activation = row[inputs];
    for (std::size_t i = 0; i < static_cast<std::size_t>(inputs); ++i)
      activation += row[i] * input[i];
    sum += output_weights[h] * soft_sign(activation);
  }
  return sum;
}

Network unpack(const StoredNetwork& stored) {
  Network network;
  network.inputs = stored.inputs;
  network.hidden = stored.hidden;
  const auto stride = static_cast<std::size_t>(stored.inputs) + 1;
  const auto hidden = static_cast<std::size_t>(stored.hidden);
  network.hidden_weights.reserve(hidden * stride);
  for (std::size_t h = 0; h < hidden; ++h) {
    for (std::size_t i = 0; i < stride; ++i) {
      network.hidden_weights.push_back(stored.row_scales[h] *
                                       static_cast<float>(stored.row_weights[h * stride + i]));
    }
  }
  network.output_weights.assign(stored.output_weights, stored.output_weights + hidden + 1);
  return network;
}

}  // namespace limbcast::segmenter
