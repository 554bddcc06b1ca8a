#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace limbcast::segmenter {

/// Kinds of steps, by their numbers in TensorFlow Lite's schema.fbs (BuiltinOperator).
enum class TfliteKind : std::int32_t {
  kAdd = 0,
  kConvolution = 3,
  kDepthwiseConvolution = 4,
  kDequantize = 6,
  kSigmoid = 14,
  kMaxPool = 17,
  kRelu = 19,
  kReshape = 22,
  kResizeBilinear = 23,
  kPad = 34
};

/// Rows, columns and channels of images; weights and limits.
struct TfliteTensor {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<float> numbers;          ///< empty where it is computed, or counts
  std::vector<std::int32_t> integers;  ///< of constant counts
};

struct TfliteStep {
  TfliteKind kind = TfliteKind::kAdd;
  std::vector<std::uint32_t> inputs;  ///< numbers of tensors
  std::uint32_t output = 0;
  bool same_padding = false;  ///< TensorFlow's "SAME"; otherwise none
  std::uint32_t stride_rows = 1, stride_columns = 1;
  std::uint32_t pool_rows = 1, pool_columns = 1;  ///< of kMaxPool
  /// The activation: the output is cut there.
  float output_min = -std::numeric_limits<float>::infinity();
  float output_max = std::numeric_limits<float>::infinity();
};

/// A network, as a file of TensorFlow Lite (schema version 3) holds it.
struct TfliteFile {
  std::vector<TfliteTensor> tensors;
  std::vector<TfliteStep> steps;  ///< in the order in which they are computed
  std::uint32_t input = 0;
  std::vector<std::uint32_t> outputs;
};

/// Reads the first graph of a file in memory, with weights of 16 bits widened to 32. Kinds of steps
/// that are not listed above are kept by their number. `begin` is trusted: the file is a part of
/// the program. Throws std::runtime_error where it uses what is not known here.
TfliteFile read_tflite(const void* begin);

}  // namespace limbcast::segmenter
