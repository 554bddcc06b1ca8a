#include "modules/segmenter/networks/network.hpp"

namespace limbcast::segmenter {

float Network::log_odds(const std::vector<float>& input) const {
  const Eigen::Map<const Eigen::VectorXf> x(input.data(), static_cast<Eigen::Index>(input.size()));
  const Eigen::VectorXf activation = hidden_weights * x + hidden_bias;
  float sum = output_bias;
  for (Eigen::Index h = 0; h < activation.size(); ++h)
    sum += output_weights[h] * soft_sign(activation[h]);
  return sum;
}

Eigen::VectorXf Network::log_odds(const Weights& inputs) const {
  const Weights activation =
      (inputs * hidden_weights.transpose()).rowwise() + hidden_bias.transpose();
  return (activation.unaryExpr(&soft_sign) * output_weights).array() + output_bias;
}

Network unpack(const StoredNetwork& stored) {
  Network network;
  network.hidden_weights.resize(stored.hidden, stored.inputs);
  network.hidden_bias.resize(stored.hidden);
  const std::int8_t* weight = stored.row_weights;
  for (int h = 0; h < stored.hidden; ++h) {
    for (int i = 0; i < stored.inputs; ++i)
      network.hidden_weights(h, i) = stored.row_scales[h] * static_cast<float>(*weight++);
    network.hidden_bias[h] = stored.hidden_bias[h];
  }
  network.output_weights = Eigen::Map<const Eigen::VectorXf>(stored.output_weights, stored.hidden);
  network.output_bias = stored.output_bias;
  return network;
}

}  // namespace limbcast::segmenter
