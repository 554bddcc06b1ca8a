#pragma once

#include "modules/segmenter/classifiers/head_classifier.hpp"
#include "modules/segmenter/classifiers/head_patch.hpp"

namespace limbcast::segmenter {

/// A network that tells the same of everything.
inline Network constant_network(float odds, int inputs) {
  Network network;
  network.hidden_weights = Network::Weights::Zero(1, inputs);
  network.hidden_bias = Eigen::VectorXf::Zero(1);
  network.output_weights = Eigen::VectorXf::Zero(1);
  network.output_bias = odds;
  return network;
}

/// Takes every candidate and every cluster for a person's with the same log odds.
inline HeadClassifier constant_classifier(float odds) {
  constexpr int kPersonInputs = 19;
  return {constant_network(odds, kPatchSize), constant_network(odds, kPersonInputs)};
}

}  // namespace limbcast::segmenter
