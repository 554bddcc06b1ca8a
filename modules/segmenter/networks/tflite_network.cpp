#include "modules/segmenter/networks/tflite_network.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <stdexcept>

#include "modules/segmenter/networks/network_engine.hpp"

namespace limbcast::segmenter {
namespace {

std::size_t count_of(const TfliteTensor& tensor) {
  return std::accumulate(tensor.shape.begin(), tensor.shape.end(), std::size_t{1},
                         std::multiplies<>());
}

std::uint32_t find_output(const TfliteFile& file, const std::string& name) {
  const auto output =
      std::find_if(file.outputs.begin(), file.outputs.end(),
                   [&](std::uint32_t tensor) { return file.tensors.at(tensor).name == name; });
  if (output == file.outputs.end()) throw std::runtime_error("the network has no output " + name);
  return *output;
}

/// The steps that lead to some tensors, in the order in which they are computed.
std::vector<TfliteStep> steps_to(const TfliteFile& file, const std::vector<std::uint32_t>& wanted) {
  std::set<std::uint32_t> needed(wanted.begin(), wanted.end());
  std::vector<TfliteStep> steps;
  for (auto step = file.steps.rbegin(); step != file.steps.rend(); ++step) {
    if (needed.count(step->output) == 0 || !file.tensors.at(step->output).numbers.empty()) continue;
    steps.push_back(*step);
    needed.insert(step->inputs.begin(), step->inputs.end());
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

std::vector<float> memory_for(const TfliteTensor& tensor) {
  return std::vector<float>(count_of(tensor) + kExtraNumbers);
}

}  // namespace

std::vector<NetworkLibrary> network_libraries() {
  if (onednn_is_quick()) return {NetworkLibrary::kOneDnn, NetworkLibrary::kXnnpack};
  return {NetworkLibrary::kXnnpack};
}

TfliteNetwork::TfliteNetwork(const TfliteFile& file, const std::vector<std::string>& outputs,
                             NetworkLibrary library) {
  NetworkPart part{file, {}, {}, nullptr, {}};
  for (const std::string& name : outputs) part.outputs.push_back(find_output(file, name));
  part.steps = steps_to(file, part.outputs);
  input_ = memory_for(file.tensors.at(file.input));
  part.input = input_.data();
  for (const std::uint32_t output : part.outputs)
    part.output_numbers.push_back(
        outputs_.emplace_back(memory_for(file.tensors.at(output))).data());
  engine_ =
      library == NetworkLibrary::kOneDnn ? make_onednn_engine(part) : make_xnnpack_engine(part);
}

TfliteNetwork::~TfliteNetwork() = default;

void TfliteNetwork::run() { engine_->run(); }

}  // namespace limbcast::segmenter
