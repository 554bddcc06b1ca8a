#include "modules/segmenter/networks/tflite_file.hpp"

#include <flatbuffers/flatbuffers.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace limbcast::segmenter {
namespace {

/// A table of the file, whose fields are asked by their numbers in schema.fbs.
class Record {
 public:
  explicit Record(const flatbuffers::Table* table) : table_(table) {}

  template <class T>
  T number(int field, T otherwise = T()) const {
    return table_->GetField<T>(offset(field), otherwise);
  }
  Record record(int field) const { return Record(pointer<flatbuffers::Table>(field)); }
  std::string text(int field) const {
    const auto* text = pointer<flatbuffers::String>(field);
    return text ? text->str() : std::string();
  }
  template <class T>
  std::vector<T> numbers(int field) const {
    const auto* vector = pointer<flatbuffers::Vector<T>>(field);
    return vector ? std::vector<T>(vector->begin(), vector->end()) : std::vector<T>();
  }
  std::vector<Record> records(int field) const {
    std::vector<Record> records;
    const auto* vector =
        pointer<flatbuffers::Vector<flatbuffers::Offset<flatbuffers::Table>>>(field);
    if (vector) {
      for (const auto* table : *vector) records.emplace_back(table);
    }
    return records;
  }

 private:
  static flatbuffers::voffset_t offset(int field) {
    return static_cast<flatbuffers::voffset_t>(4 + 2 * field);  // after two sizes
  }
  template <class T>
  const T* pointer(int field) const {
    return table_->GetPointer<const T*>(offset(field));
  }

  const flatbuffers::Table* table_;
};

/// Values of schema.fbs.
enum TensorType : std::int8_t { kFloat32 = 0, kFloat16 = 1, kInt32 = 2 };
enum Activation : std::int8_t { kNoActivation = 0, kRelu = 1, kRelu6 = 3 };
constexpr std::int8_t kSamePadding = 0;

template <class T>
std::vector<T> read_as(const std::vector<std::uint8_t>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

std::vector<float> widen(const std::vector<Eigen::half>& values) {
  return {values.begin(), values.end()};
}

TfliteTensor read_tensor(const Record& record, const std::vector<Record>& buffers) {
  TfliteTensor tensor;
  tensor.name = record.text(3);
  for (const std::int32_t size : record.numbers<std::int32_t>(0))
    tensor.shape.push_back(static_cast<std::size_t>(size));
  const std::vector<std::uint8_t> bytes =
      buffers.at(record.number<std::uint32_t>(2)).numbers<std::uint8_t>(0);
  switch (record.number<std::int8_t>(1)) {
    case kFloat32:
      tensor.numbers = read_as<float>(bytes);
      break;
    case kFloat16:
      tensor.numbers = widen(read_as<Eigen::half>(bytes));
      break;
    case kInt32:
      tensor.integers = read_as<std::int32_t>(bytes);
      break;
    default:
      throw std::runtime_error("a tensor of the network is of a type that is not known");
  }
  return tensor;
}

void set_activation(std::int8_t activation, TfliteStep& step) {
  if (activation != kNoActivation && activation != kRelu && activation != kRelu6)
    throw std::runtime_error("an activation of the network is not known");
  if (activation != kNoActivation) step.output_min = 0.0F;
  if (activation == kRelu6) step.output_max = 6.0F;
}

void set_window(const Record& options, TfliteStep& step) {
  step.same_padding = options.number<std::int8_t>(0) == kSamePadding;
  step.stride_columns = options.number<std::uint32_t>(1);
  step.stride_rows = options.number<std::uint32_t>(2);
}

TfliteStep read_step(const Record& record, const std::vector<TfliteKind>& kinds) {
  TfliteStep step;
  step.kind = kinds.at(record.number<std::uint32_t>(0));
  for (const std::int32_t input : record.numbers<std::int32_t>(1))
    step.inputs.push_back(static_cast<std::uint32_t>(input));
  step.output = static_cast<std::uint32_t>(record.numbers<std::int32_t>(2).at(0));
  const Record options = record.record(4);
  switch (step.kind) {
    case TfliteKind::kConvolution:
      set_window(options, step);
      set_activation(options.number<std::int8_t>(3), step);
      break;
    case TfliteKind::kDepthwiseConvolution:
      set_window(options, step);
      set_activation(options.number<std::int8_t>(4), step);
      break;
    case TfliteKind::kMaxPool:
      set_window(options, step);
      step.pool_columns = options.number<std::uint32_t>(3);
      step.pool_rows = options.number<std::uint32_t>(4);
      set_activation(options.number<std::int8_t>(5), step);
      break;
    case TfliteKind::kAdd:
      set_activation(options.number<std::int8_t>(0), step);
      break;
    default:
      break;
  }
  return step;
}

/// What is a constant of 16 bits in the file is one of 32 for its steps.
void widen_constants(TfliteFile& file) {
  for (const TfliteStep& step : file.steps) {
    if (step.kind == TfliteKind::kDequantize)
      file.tensors.at(step.output).numbers = std::move(file.tensors.at(step.inputs.at(0)).numbers);
  }
}

}  // namespace

TfliteFile read_tflite(const void* begin) {
  const Record model(flatbuffers::GetRoot<flatbuffers::Table>(begin));
  // Newer files write the kind into the fourth field, older ones into the first.
  std::vector<TfliteKind> kinds;
  for (const Record& code : model.records(1))
    kinds.push_back(static_cast<TfliteKind>(
        std::max<std::int32_t>(code.number<std::int8_t>(0), code.number<std::int32_t>(3))));
  const std::vector<Record> buffers = model.records(4);
  const Record graph = model.records(2).at(0);
  TfliteFile file;
  for (const Record& tensor : graph.records(0))
    file.tensors.push_back(read_tensor(tensor, buffers));
  for (const Record& step : graph.records(3)) file.steps.push_back(read_step(step, kinds));
  file.input = graph.numbers<std::uint32_t>(1).at(0);
  file.outputs = graph.numbers<std::uint32_t>(2);
  widen_constants(file);
  return file;
}

}  // namespace limbcast::segmenter
