#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "modules/segmenter/networks/network_engine.hpp"
#include "modules/segmenter/networks/network_library.hpp"
#include "modules/segmenter/networks/tflite_file.hpp"

namespace limbcast::segmenter {

/// Computes a network of TensorFlow Lite on one core, for one thread at a time. The same input
/// gives the same output on computers of one kind.
class TfliteNetwork {
 public:
  /// `file` lives longer than this object. `outputs`: names of the tensors that are wanted. Throws
  /// std::runtime_error where the file lacks one, or a step to them is not known here.
  TfliteNetwork(const TfliteFile& file, const std::vector<std::string>& outputs,
                NetworkLibrary library = network_libraries().front());
  ~TfliteNetwork();

  /// Rows, columns and channels of the image, which the caller writes before each run.
  float* input() { return input_.data(); }
  /// Throws std::runtime_error where the library reports an error.
  void run();
  /// Of the last run; `index` counts the constructor's names.
  const float* output(std::size_t index) const { return outputs_.at(index).data(); }

 private:
  std::vector<float> input_;
  std::vector<std::vector<float>> outputs_;
  std::unique_ptr<NetworkEngine> engine_;
};

}  // namespace limbcast::segmenter
