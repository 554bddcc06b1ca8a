#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "modules/segmenter/networks/tflite_file.hpp"

namespace limbcast::segmenter {

/// Computes a network in memory that is told once; for one thread at a time.
class NetworkEngine {
 public:
  NetworkEngine() = default;
  virtual ~NetworkEngine() = default;
  NetworkEngine(const NetworkEngine&) = delete;
  NetworkEngine& operator=(const NetworkEngine&) = delete;

  virtual void run() = 0;
};

/// The part of a network that is computed, and where its numbers lie.
struct NetworkPart {
  const TfliteFile& file;
  std::vector<TfliteStep> steps;  ///< those that lead to the outputs, in order
  std::vector<std::uint32_t> outputs;
  /// The input's numbers and those of each output; kExtraNumbers more of each may be read.
  float* input = nullptr;
  std::vector<float*> output_numbers;
};
constexpr std::size_t kExtraNumbers = 4;

/// Throw std::runtime_error where a step is not known, or the library reports an error.
std::unique_ptr<NetworkEngine> make_xnnpack_engine(const NetworkPart& part);
std::unique_ptr<NetworkEngine> make_onednn_engine(const NetworkPart& part);
/// Whether oneDNN is built in and quicker than XNNPACK: on processors that compute with brain
/// floats (AVX512_BF16, AMX), and on those with AVX2 and no AVX-512.
bool onednn_is_quick();

}  // namespace limbcast::segmenter
