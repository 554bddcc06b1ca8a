#include "tests/segmenter/network_training.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>
#include <stdexcept>

namespace limbcast::segmenter {
namespace {

/// Adam over one vector of weights.
class Adam {
 public:
  explicit Adam(std::vector<float>& weights)
      : weights_(weights), mean_(weights.size()), square_(weights.size()) {}

  void step(const std::vector<float>& gradient, float rate, float decay) {
    constexpr float kMean = 0.9F, kSquare = 0.999F;
    mean_power_ *= kMean;
    square_power_ *= kSquare;
    const float scale = rate * std::sqrt(1.0F - square_power_) / (1.0F - mean_power_);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      mean_[i] = kMean * mean_[i] + (1.0F - kMean) * gradient[i];
      square_[i] = kSquare * square_[i] + (1.0F - kSquare) * gradient[i] * gradient[i];
      weights_[i] -=
          scale * mean_[i] / (std::sqrt(square_[i]) + 1e-8F) + rate * decay * weights_[i];
    }
  }

 private:
  std::vector<float>& weights_;
  std::vector<float> mean_, square_;
  float mean_power_ = 1.0F, square_power_ = 1.0F;
};

Network random_network(int inputs, int hidden, std::mt19937& random) {
  Network network;
  network.inputs = inputs;
  network.hidden = hidden;
  const auto uniform = [&] { return static_cast<float>(random()) / 4294967296.0F * 2.0F - 1.0F; };
  const float range = 1.0F / std::sqrt(static_cast<float>(inputs));
  for (int i = 0; i < hidden * (inputs + 1); ++i)
    network.hidden_weights.push_back(range * uniform());
  for (int i = 0; i <= hidden; ++i) network.output_weights.push_back(0.3F * uniform());
  return network;
}

/// Adds the gradient of one example's loss.
void add_gradient(const Network& network, const Example& example,
                  std::vector<float>& hidden_gradient, std::vector<float>& output_gradient) {
  const auto inputs = static_cast<std::size_t>(network.inputs),
             hidden = static_cast<std::size_t>(network.hidden);
  std::vector<float> activation(hidden);
  float odds = network.output_weights[hidden];
  for (std::size_t h = 0; h < hidden; ++h) {
    const float* row = network.hidden_weights.data() + h * (inputs + 1);
    float sum = row[inputs];
    for (std::size_t i = 0; i < inputs; ++i) sum += row[i] * example.input[i];
    activation[h] = sum;
    odds += network.output_weights[h] * soft_sign(sum);
  }
  const float error =
      example.weight * (1.0F / (1.0F + std::exp(-odds)) - (example.positive ? 1.0F : 0.0F));
  output_gradient[hidden] += error;
  for (std::size_t h = 0; h < hidden; ++h) {
    output_gradient[h] += error * soft_sign(activation[h]);
    const float slope = 1.0F / std::pow(1.0F + std::abs(activation[h]), 2.0F);
    const float back = error * network.output_weights[h] * slope;
    float* row = hidden_gradient.data() + h * (inputs + 1);
    for (std::size_t i = 0; i < inputs; ++i) row[i] += back * example.input[i];
    row[inputs] += back;
  }
}

void write_network(const Network& network, const std::string& name, std::ostream& file) {
  const auto stride = static_cast<std::size_t>(network.inputs) + 1;
  const auto hidden = static_cast<std::size_t>(network.hidden);
  std::vector<float> scales;
  file << "constexpr std::int8_t " << name << "RowWeights[] = {\n";
  for (std::size_t h = 0; h < hidden; ++h) {
    float largest = 1e-9F;
    for (std::size_t i = 0; i < stride; ++i)
      largest = std::max(largest, std::abs(network.hidden_weights[h * stride + i]));
    scales.push_back(largest / 127.0F);
    for (std::size_t i = 0; i < stride; ++i) {
      file << std::lround(network.hidden_weights[h * stride + i] / scales.back())
           << (i + 1 < stride ? "," : ",\n");
    }
  }
  file << "};\nconstexpr float " << name << "RowScales[] = {";
  file.precision(9);
  for (const float scale : scales) file << std::fixed << scale << "F,";
  file << "};\nconstexpr float " << name << "OutputWeights[] = {";
  for (const float weight : network.output_weights) file << weight << "F,";
  file << "};\nconstexpr StoredNetwork " << name << " = {" << network.inputs << ", "
       << network.hidden << ", " << name << "RowScales, " << name << "RowWeights, " << name
       << "OutputWeights};\n";
}

}  // namespace

Network train(const std::vector<Example>& examples, const TrainingParams& params) {
  constexpr std::size_t kBatch = 64;
  std::mt19937 random(params.seed);
  Network network =
      random_network(static_cast<int>(examples.at(0).input.size()), params.hidden, random);
  Adam hidden_adam(network.hidden_weights), output_adam(network.output_weights);
  std::vector<std::size_t> order(examples.size());
  std::iota(order.begin(), order.end(), 0U);
  for (int epoch = 0; epoch < params.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    const float rate =
        params.rate * std::pow(0.1F, static_cast<float>(epoch) / static_cast<float>(params.epochs));
    for (std::size_t start = 0; start < order.size(); start += kBatch) {
      std::vector<float> hidden_gradient(network.hidden_weights.size()),
          output_gradient(network.output_weights.size());
      const std::size_t end = std::min(order.size(), start + kBatch);
      for (std::size_t i = start; i < end; ++i)
        add_gradient(network, examples[order[i]], hidden_gradient, output_gradient);
      for (float& g : hidden_gradient) g /= static_cast<float>(end - start);
      for (float& g : output_gradient) g /= static_cast<float>(end - start);
      hidden_adam.step(hidden_gradient, rate, params.decay);
      output_adam.step(output_gradient, rate, params.decay);
    }
  }
  return network;
}

void write_networks(const std::vector<std::pair<std::string, Network>>& networks,
                    const std::string& path) {
  std::ofstream file(path);
  file << "// Written by limbcast-train-heads; not to be edited.\n// clang-format off\n";
  for (const auto& [name, network] : networks) write_network(network, name, file);
  file << "// clang-format on\n";
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace limbcast::segmenter
