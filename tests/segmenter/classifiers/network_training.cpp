#include "tests/segmenter/classifiers/network_training.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <random>
#include <stdexcept>

namespace limbcast::segmenter {
namespace {

/// Examples that one step looks at.
constexpr std::size_t kBatch = 64;
/// The step falls to this share of itself over the epochs.
constexpr float kLastRate = 0.05F;

/// Adam over one block of weights.
class Adam {
 public:
  explicit Adam(Eigen::Index size)
      : mean_(Eigen::ArrayXf::Zero(size)), square_(Eigen::ArrayXf::Zero(size)) {}

  void step(const Eigen::Ref<const Eigen::ArrayXf>& gradient, float rate, float decay,
            Eigen::Ref<Eigen::ArrayXf> weights) {
    constexpr float kMean = 0.9F, kSquare = 0.999F, kTiny = 1e-8F;
    mean_power_ *= kMean;
    square_power_ *= kSquare;
    const float scale = rate * std::sqrt(1.0F - square_power_) / (1.0F - mean_power_);
    mean_ = kMean * mean_ + (1.0F - kMean) * gradient;
    square_ = kSquare * square_ + (1.0F - kSquare) * gradient.square();
    weights -= scale * mean_ / (square_.sqrt() + kTiny) + rate * decay * weights;
  }

 private:
  Eigen::ArrayXf mean_, square_;
  float mean_power_ = 1.0F, square_power_ = 1.0F;
};

/// One weight for each in a Network: what its loss changes with it.
struct Gradient {
  Network::Weights hidden_weights;
  Eigen::VectorXf hidden_bias, output_weights;
  float output_bias = 0.0F;
};

/// Inputs and truth of some examples.
struct Batch {
  Network::Weights inputs;
  Eigen::VectorXf positive;
};

Network random_network(Eigen::Index inputs, int hidden, std::mt19937& random) {
  const auto uniform = [&] { return static_cast<float>(random()) / 4294967296.0F * 2.0F - 1.0F; };
  const float range = 1.0F / std::sqrt(static_cast<float>(inputs));
  Network network;
  network.hidden_weights =
      Network::Weights::NullaryExpr(hidden, inputs, [&] { return range * uniform(); });
  network.hidden_bias = Eigen::VectorXf::Zero(hidden);
  network.output_weights = Eigen::VectorXf::NullaryExpr(hidden, [&] { return 0.3F * uniform(); });
  return network;
}

/// Mean gradient of the logistic loss over the batch.
Gradient gradient_of(const Network& network, const Batch& batch) {
  const Network::Weights activation =
      (batch.inputs * network.hidden_weights.transpose()).rowwise() +
      network.hidden_bias.transpose();
  const Network::Weights output = activation.unaryExpr(&soft_sign);
  const Eigen::ArrayXf odds = (output * network.output_weights).array() + network.output_bias;
  const Eigen::VectorXf error = (1.0F / (1.0F + (-odds).exp()) - batch.positive.array()) /
                                static_cast<float>(batch.positive.size());
  const Network::Weights back = (error * network.output_weights.transpose()).array() /
                                (1.0F + activation.array().abs()).square();
  return {back.transpose() * batch.inputs, back.colwise().sum().transpose(),
          output.transpose() * error, error.sum()};
}

Eigen::Map<Eigen::ArrayXf> flat(Network::Weights& weights) {
  return {weights.data(), weights.size()};
}

/// Adam over all weights of a network.
class Descent {
 public:
  explicit Descent(const Network& network)
      : hidden_weights_(network.hidden_weights.size()),
        hidden_bias_(network.hidden_bias.size()),
        output_weights_(network.output_weights.size()),
        output_bias_(1) {}

  void step(Gradient gradient, float rate, float decay, Network& network) {
    hidden_weights_.step(flat(gradient.hidden_weights), rate, decay, flat(network.hidden_weights));
    hidden_bias_.step(gradient.hidden_bias.array(), rate, 0.0F, network.hidden_bias.array());
    output_weights_.step(gradient.output_weights.array(), rate, decay,
                         network.output_weights.array());
    output_bias_.step(Eigen::Map<Eigen::ArrayXf>(&gradient.output_bias, 1), rate, 0.0F,
                      Eigen::Map<Eigen::ArrayXf>(&network.output_bias, 1));
  }

 private:
  Adam hidden_weights_, hidden_bias_, output_weights_, output_bias_;
};

template <class Values>
void write_list(const std::string& type, const std::string& name, const Values& values,
                std::ostream& file) {
  file << "constexpr " << type << " " << name << "[] = {";
  for (Eigen::Index i = 0; i < values.size(); ++i) file << values[i] << "F,";
  file << "};\n";
}

void write_network(const Network& network, const std::string& name, std::ostream& file) {
  file << "constexpr std::int8_t " << name << "RowWeights[] = {\n";
  Eigen::VectorXf scales = network.hidden_weights.cwiseAbs().rowwise().maxCoeff() / 127.0F;
  scales = scales.cwiseMax(1e-9F);
  for (Eigen::Index h = 0; h < scales.size(); ++h) {
    for (Eigen::Index i = 0; i < network.hidden_weights.cols(); ++i)
      file << std::lround(network.hidden_weights(h, i) / scales[h]) << ",";
    file << "\n";
  }
  file << "};\n" << std::fixed;
  file.precision(9);
  write_list("float", name + "RowScales", scales, file);
  write_list("float", name + "HiddenBias", network.hidden_bias, file);
  write_list("float", name + "OutputWeights", network.output_weights, file);
  file << "constexpr StoredNetwork " << name << " = {" << network.hidden_weights.cols() << ", "
       << scales.size() << ", " << name << "RowScales, " << name << "RowWeights, " << name
       << "HiddenBias, " << name << "OutputWeights, " << network.output_bias << "F};\n";
}

}  // namespace

Network train(const std::vector<Example>& examples, const TrainingParams& params) {
  std::mt19937 random(params.seed);
  const auto inputs = static_cast<Eigen::Index>(examples.at(0).input.size());
  Network network = random_network(inputs, params.hidden, random);
  Descent descent(network);
  std::vector<std::size_t> order(examples.size());
  std::iota(order.begin(), order.end(), 0U);
  Batch batch;
  for (int epoch = 0; epoch < params.epochs; ++epoch) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    const float rate = params.rate * std::pow(kLastRate, static_cast<float>(epoch) /
                                                             static_cast<float>(params.epochs));
    for (std::size_t start = 0; start < order.size(); start += kBatch) {
      const auto count = static_cast<Eigen::Index>(std::min(kBatch, order.size() - start));
      batch.inputs.resize(count, inputs);
      batch.positive.resize(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const Example& example = examples[order[start + static_cast<std::size_t>(i)]];
        batch.inputs.row(i) = Eigen::Map<const Eigen::RowVectorXf>(example.input.data(), inputs);
        batch.positive[i] = example.positive ? 1.0F : 0.0F;
      }
      descent.step(gradient_of(network, batch), rate, params.decay, network);
    }
  }
  return network;
}

void write_networks(const std::vector<std::pair<std::string, Network>>& networks,
                    const std::string& path) {
  std::ofstream file(path);
  file << "// Written by a program that train.sh runs; not to be edited.\n// clang-format off\n";
  for (const auto& [name, network] : networks) write_network(network, name, file);
  file << "// clang-format on\n";
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void print_decisions(const char* what, const Network& network,
                     const std::vector<Example>& examples) {
  std::array<std::array<int, 2>, 2> table{};
  for (const Example& e : examples)
    ++table[e.positive ? 1 : 0][network.log_odds(e.input) > 0.0F ? 1 : 0];
  std::printf("%s: of bodies' points kept %d of %d, of others %d of %d\n", what, table[1][1],
              table[1][0] + table[1][1], table[0][1], table[0][0] + table[0][1]);
}

}  // namespace limbcast::segmenter
