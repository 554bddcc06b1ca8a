#pragma once

#include <string>
#include <utility>
#include <vector>

#include "modules/segmenter/networks/network.hpp"

namespace limbcast::segmenter {

struct Example {
  std::vector<float> input;
  bool positive = false;
};

struct TrainingParams {
  int hidden = 40;
  int epochs = 16;
  float rate = 0.002F;  ///< Adam's step, falling to a twentieth over the epochs
  float decay = 0.1F;   ///< of the weights, a step, times the rate
  unsigned seed = 1;
};

/// Least logistic loss by Adam (Kingma and Ba, ICLR 2015). The same examples give the same network.
Network train(const std::vector<Example>& examples, const TrainingParams& params);

/// Prints how many points of bodies, and of other things, a network takes for a body's.
void print_decisions(const char* what, const Network& network,
                     const std::vector<Example>& examples);

/// Writes C++ text that defines a StoredNetwork (see networks/network.hpp) for each name.
void write_networks(const std::vector<std::pair<std::string, Network>>& networks,
                    const std::string& path);

}  // namespace limbcast::segmenter
