#include "modules/segmenter/networks/onednn_tensors.hpp"

#include <algorithm>
#include <stdexcept>

namespace limbcast::segmenter {
namespace {

using Tag = dnnl::memory::format_tag;
using Dims = dnnl::memory::dims;

/// oneDNN counts channels before rows and columns, however they lie in memory.
Dims image_dims(const TfliteTensor& tensor) {
  const auto& shape = tensor.shape;
  if (shape.size() != 4) throw std::runtime_error("a step of the network works on no image");
  return {static_cast<std::int64_t>(shape[0]), static_cast<std::int64_t>(shape[3]),
          static_cast<std::int64_t>(shape[1]), static_cast<std::int64_t>(shape[2])};
}

/// Whether a step's output has its input's type.
bool keeps_type(TfliteKind kind) {
  return kind == TfliteKind::kSigmoid || kind == TfliteKind::kRelu ||
         kind == TfliteKind::kReshape || kind == TfliteKind::kMaxPool;
}

}  // namespace

bool onednn_has(dnnl::cpu_isa instructions) {
  const auto needed = static_cast<int>(instructions);
  return (static_cast<int>(dnnl::get_effective_cpu_isa()) & needed) == needed;
}

bool computes_brain_floats() { return onednn_has(dnnl::cpu_isa::avx512_core_bf16); }

void OneDnnCalls::add(dnnl::primitive primitive, Arguments arguments) {
  calls_.push_back({std::move(primitive), std::move(arguments)});
}

void OneDnnCalls::add_copy(const dnnl::memory& from, const dnnl::memory& to) {
  add(dnnl::reorder(from, to), {{DNNL_ARG_FROM, from}, {DNNL_ARG_TO, to}});
}

void OneDnnCalls::copy_now(dnnl::memory from, dnnl::memory to) {
  dnnl::reorder(from, to).execute(stream_, from, to);
  stream_.wait();
}

void OneDnnCalls::run() {
  for (const Call& call : calls_) call.primitive.execute(stream_, call.arguments);
  stream_.wait();
}

OneDnnTensors::OneDnnTensors(const NetworkPart& part, OneDnnCalls& calls)
    : file_(part.file), calls_(calls) {
  find_exact_tensors(part);
  for (std::size_t i = 0; i < part.steps.size(); ++i)
    for (const std::uint32_t tensor : part.steps[i].inputs) last_use_[tensor] = i;
  for (const std::uint32_t tensor : part.outputs) last_use_[tensor] = part.steps.size();
}

/// Outputs have 32 bits, and so has what leads to them by a step that keeps the type.
void OneDnnTensors::find_exact_tensors(const NetworkPart& part) {
  is_exact_.insert(part.outputs.begin(), part.outputs.end());
  for (auto step = part.steps.rbegin(); step != part.steps.rend(); ++step)
    if (keeps_type(step->kind) && is_exact_.count(step->output) > 0)
      is_exact_.insert(step->inputs.at(0));
}

/// What is computed of few cells has 32 bits on every processor: BlazePose sums a dozen such images
/// up before it tells joints, which then err by 0.3 instead of 1.0 px for a twentieth of its time.
OneDnnTensors::Type OneDnnTensors::computed_type(std::uint32_t index) const {
  if (!computes_brain_floats()) return Type::f32;
  constexpr std::size_t kFewRows = 4;
  const auto& shape = told(index).shape;
  return shape.size() == 4 && shape[1] <= kFewRows ? Type::f32 : Type::bf16;
}

OneDnnTensors::Type OneDnnTensors::kept_type(std::uint32_t index) const {
  return is_exact_.count(index) > 0 ? Type::f32 : computed_type(index);
}

dnnl::memory::desc OneDnnTensors::description(std::uint32_t index) const {
  return {image_dims(told(index)), kept_type(index), Tag::nhwc};
}

const dnnl::memory& OneDnnTensors::input(const TfliteStep& step, std::size_t index) {
  const std::uint32_t tensor = step.inputs.at(index);
  const auto found = memories_.find(tensor);
  if (found != memories_.end()) return found->second;
  const dnnl::memory::desc as_told{image_dims(told(tensor)), Type::f32, Tag::nhwc};
  return memories_[tensor] = constant(tensor, as_told, description(tensor));
}

dnnl::memory OneDnnTensors::input_as(Type type, const TfliteStep& step) {
  const dnnl::memory& computed = input(step, 0);
  if (computed.get_desc().data_type() == type) return computed;
  const dnnl::memory converted = own({computed.get_desc().dims(), type, Tag::nhwc});
  calls_.add_copy(computed, converted);
  return converted;
}

dnnl::memory OneDnnTensors::constant(std::uint32_t index, const dnnl::memory::desc& as_told,
                                     const dnnl::memory::desc& wanted) {
  // oneDNN takes no const memory, though it only reads it here.
  auto* const numbers = const_cast<float*>(told(index).numbers.data());
  dnnl::memory constant(wanted, calls_.engine());
  calls_.copy_now({as_told, calls_.engine(), numbers}, constant);
  return constant;
}

dnnl::memory OneDnnTensors::output(std::uint32_t index) {
  const dnnl::memory::desc wanted = description(index);
  auto fits = idle_.lower_bound(wanted.get_size());
  if (fits == idle_.end()) {
    const dnnl::memory::desc bytes({static_cast<std::int64_t>(wanted.get_size())}, Type::u8,
                                   Tag::a);
    fits = idle_.emplace(wanted.get_size(), own(bytes).get_data_handle());
  }
  const Bytes bytes = *fits;
  idle_.erase(fits);
  busy_[index] = bytes;
  return memories_[index] = dnnl::memory(wanted, calls_.engine(), bytes.second);
}

dnnl::memory OneDnnTensors::output_of_zeros(std::uint32_t index) {
  const dnnl::memory& zeros = memories_[index] = own(description(index));
  std::fill_n(static_cast<char*>(zeros.get_data_handle()), zeros.get_desc().get_size(), '\0');
  return zeros;
}

void OneDnnTensors::make_same(std::uint32_t index, std::uint32_t other) {
  memories_[index] = memories_.at(other);
  busy_.erase(other);  // never idle again: it is needed as long as either
}

void OneDnnTensors::release_inputs(const TfliteStep& step, std::size_t number) {
  for (const std::uint32_t tensor : step.inputs) {
    const auto held = busy_.find(tensor);
    if (held == busy_.end() || last_use_.at(tensor) > number) continue;
    idle_.insert(held->second);
    busy_.erase(held);
  }
}

void OneDnnTensors::copy_from(float* numbers, std::uint32_t index) {
  const dnnl::memory::desc given{image_dims(told(index)), Type::f32, Tag::nhwc};
  calls_.add_copy({given, calls_.engine(), numbers}, output(index));
}

void OneDnnTensors::copy_to(float* numbers, std::uint32_t index) {
  const dnnl::memory& computed = memories_.at(index);
  const dnnl::memory::desc wanted{computed.get_desc().dims(), Type::f32, Tag::nhwc};
  calls_.add_copy(computed, {wanted, calls_.engine(), numbers});
}

dnnl::memory& OneDnnTensors::own(const dnnl::memory::desc& description) {
  return owned_.emplace_back(description, calls_.engine());
}

}  // namespace limbcast::segmenter
