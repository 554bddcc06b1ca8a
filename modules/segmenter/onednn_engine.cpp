#include <omp.h>

#include <algorithm>
#include <dnnl.hpp>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "modules/segmenter/network_engine.hpp"

namespace limbcast::segmenter {
namespace {

using Type = dnnl::memory::data_type;
using Tag = dnnl::memory::format_tag;
using Dims = dnnl::memory::dims;

/// Keeps oneDNN in the caller's thread, as long as it lives: several networks run side by side.
class OneThread {
 public:
  OneThread() { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = omp_get_max_threads();
};

/// What `work` gives; oneDNN's own kind of errors as std::runtime_error.
template <class Work>
auto in_words(const char* what, const Work& work) {
  try {
    return work();
  } catch (const dnnl::error& error) {
    throw std::runtime_error(std::string("oneDNN cannot ") + what + " a network: " + error.what());
  }
}

/// oneDNN counts channels before rows and columns, however they lie in memory.
Dims image_dims(const TfliteTensor& tensor) {
  const auto& shape = tensor.shape;
  if (shape.size() != 4) throw std::runtime_error("a step of the network works on no image");
  return {static_cast<std::int64_t>(shape[0]), static_cast<std::int64_t>(shape[3]),
          static_cast<std::int64_t>(shape[1]), static_cast<std::int64_t>(shape[2])};
}

/// What is padded before and after.
struct Padding {
  std::int64_t before = 0, after = 0;
};

Padding padding_for(bool same, std::int64_t input, std::int64_t window, std::int64_t stride) {
  if (!same) return {};
  const std::int64_t outputs = (input + stride - 1) / stride;
  const std::int64_t all = std::max<std::int64_t>(0, (outputs - 1) * stride + window - input);
  return {all / 2, all - all / 2};
}

dnnl::primitive_attr cut_off(const TfliteStep& step) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  dnnl::post_ops operations;
  if (step.output_min == 0.0F && step.output_max == kInfinity)
    operations.append_eltwise(1.0F, dnnl::algorithm::eltwise_relu, 0.0F, 0.0F);
  else if (step.output_min > -kInfinity || step.output_max < kInfinity)
    operations.append_eltwise(1.0F, dnnl::algorithm::eltwise_clip, step.output_min,
                              step.output_max);
  dnnl::primitive_attr attributes;
  attributes.set_post_ops(operations);
  return attributes;
}

class OneDnnEngine : public NetworkEngine {
 public:
  explicit OneDnnEngine(const NetworkPart& part) : file_(part.file) {
    const OneThread one_thread;
    find_exact_tensors(part);
    for (std::size_t i = 0; i < part.steps.size(); ++i)
      for (const std::uint32_t tensor : part.steps[i].inputs) last_use_[tensor] = i;
    for (const std::uint32_t tensor : part.outputs) last_use_[tensor] = part.steps.size();

    copy(numbers_at(part.input, image_dims(tensor(file_.input))), memory_for(file_.input));
    for (std::size_t i = 0; i < part.steps.size(); ++i) {
      add(part.steps[i]);
      for (const std::uint32_t tensor : part.steps[i].inputs) release(tensor, i);
    }
    for (std::size_t i = 0; i < part.outputs.size(); ++i) {
      const dnnl::memory& computed = memories_.at(part.outputs[i]);
      copy(computed, numbers_at(part.output_numbers.at(i), computed.get_desc().dims()));
    }
  }

  void run() override {
    const OneThread one_thread;
    in_words("run", [&] {
      for (const Call& call : calls_) call.primitive.execute(stream_, call.arguments);
      return stream_.wait();
    });
  }

 private:
  using Arguments = std::unordered_map<int, dnnl::memory>;
  struct Call {
    dnnl::primitive primitive;
    Arguments arguments;
  };

  const TfliteTensor& tensor(std::uint32_t index) const { return file_.tensors.at(index); }

  /// Outputs have 32 bits, and so has what leads to them by a step that keeps the type.
  void find_exact_tensors(const NetworkPart& part) {
    is_exact_.insert(part.outputs.begin(), part.outputs.end());
    for (auto step = part.steps.rbegin(); step != part.steps.rend(); ++step) {
      const bool keeps_type =
          step->kind == TfliteKind::kSigmoid || step->kind == TfliteKind::kRelu ||
          step->kind == TfliteKind::kReshape || step->kind == TfliteKind::kMaxPool;
      if (keeps_type && is_exact_.count(step->output) > 0) is_exact_.insert(step->inputs.at(0));
    }
  }

  /// What is computed of few cells has 32 bits: BlazePose sums a dozen such images up before it
  /// tells joints, which then err by 0.3 instead of 1.0 px for a twentieth of its time.
  Type computed_type(std::uint32_t index) const {
    constexpr std::size_t kFewRows = 4;
    const auto& shape = tensor(index).shape;
    return shape.size() == 4 && shape[1] <= kFewRows ? Type::f32 : Type::bf16;
  }
  Type type_of(std::uint32_t index) const {
    return is_exact_.count(index) > 0 ? Type::f32 : computed_type(index);
  }
  dnnl::memory numbers_at(float* numbers, const Dims& dims) {
    return {{dims, Type::f32, Tag::nhwc}, engine_, numbers};
  }
  dnnl::memory::desc description(std::uint32_t index) const {
    return {image_dims(tensor(index)), type_of(index), Tag::nhwc};
  }
  /// Memory for a tensor that is computed: that of one which is needed no more, or new.
  dnnl::memory memory_for(std::uint32_t index) {
    const dnnl::memory::desc told = description(index);
    auto fits = idle_.lower_bound(told.get_size());
    if (fits == idle_.end()) {
      const auto bytes = static_cast<std::int64_t>(told.get_size());
      const dnnl::memory::desc plain({bytes}, Type::u8, Tag::a);
      fits = idle_.emplace(told.get_size(), owned_.emplace_back(plain, engine_).get_data_handle());
    }
    busy_[index] = *fits;
    void* const bytes = fits->second;
    idle_.erase(fits);
    return memories_[index] = dnnl::memory(told, engine_, bytes);
  }
  void release(std::uint32_t index, std::size_t step) {
    const auto held = busy_.find(index);
    if (held == busy_.end() || last_use_[index] > step) return;
    idle_.insert(held->second);
    busy_.erase(held);
  }
  /// A step's input, computed before or constant.
  const dnnl::memory& input(const TfliteStep& step, std::size_t index) {
    const std::uint32_t number = step.inputs.at(index);
    const auto found = memories_.find(number);
    if (found != memories_.end()) return found->second;
    const dnnl::memory::desc as_told{image_dims(tensor(number)), Type::f32, Tag::nhwc};
    return memories_[number] = constant(tensor(number), as_told, description(number));
  }
  /// A step's first input with numbers of this type.
  dnnl::memory input_as(Type type, const TfliteStep& step) {
    const dnnl::memory& told = input(step, 0);
    if (told.get_desc().data_type() == type) return told;
    const dnnl::memory::desc wanted{told.get_desc().dims(), type, Tag::nhwc};
    const dnnl::memory converted = owned_.emplace_back(wanted, engine_);
    copy(told, converted);
    return converted;
  }
  void call(dnnl::primitive primitive, Arguments arguments) {
    calls_.push_back({std::move(primitive), std::move(arguments)});
  }
  void copy(const dnnl::memory& from, const dnnl::memory& to) {
    call(dnnl::reorder(from, to), {{DNNL_ARG_FROM, from}, {DNNL_ARG_TO, to}});
  }
  /// Constants as a primitive wants them.
  dnnl::memory constant(const TfliteTensor& told, const dnnl::memory::desc& as_told,
                        const dnnl::memory::desc& wanted) {
    dnnl::memory from(as_told, engine_, const_cast<float*>(told.numbers.data()));
    dnnl::memory to(wanted, engine_);
    dnnl::reorder(from, to).execute(stream_, from, to);
    stream_.wait();
    return to;
  }

  void add(const TfliteStep& step) {
    switch (step.kind) {
      case TfliteKind::kConvolution:
      case TfliteKind::kDepthwiseConvolution:
        return add_convolution(step);
      case TfliteKind::kAdd:
        return add_sum(step);
      case TfliteKind::kMaxPool:
        return add_pooling(step);
      case TfliteKind::kSigmoid:
        return add_function(step, dnnl::algorithm::eltwise_logistic);
      case TfliteKind::kRelu:
        return add_function(step, dnnl::algorithm::eltwise_relu);
      case TfliteKind::kReshape:
        return add_reshape(step);
      case TfliteKind::kResizeBilinear:
        return add_resize(step);
      case TfliteKind::kPad:
        return add_padding(step);
      default:
        throw std::runtime_error("a step of the network is of a kind that is not known (" +
                                 std::to_string(static_cast<int>(step.kind)) + ")");
    }
  }

  void add_convolution(const TfliteStep& step) {
    const TfliteTensor& filter =
        tensor(step.inputs.at(1));  // outputs or 1, rows, columns, inputs or outputs
    const auto size = [&](std::size_t i) { return static_cast<std::int64_t>(filter.shape.at(i)); };
    const bool depthwise = step.kind == TfliteKind::kDepthwiseConvolution;
    const Dims dims = depthwise ? Dims{size(3), 1, 1, size(1), size(2)}
                                : Dims{size(0), size(3), size(1), size(2)};
    const std::int64_t outputs = depthwise ? size(3) : size(0);
    const Type type = computed_type(step.output);
    const dnnl::memory source = input_as(type, step);
    const Dims in = source.get_desc().dims();
    if (depthwise && in[1] != outputs)
      throw std::runtime_error("a step of the network makes several channels of one");
    const Padding rows = padding_for(step.same_padding, in[2], size(1), step.stride_rows);
    const Padding columns = padding_for(step.same_padding, in[3], size(2), step.stride_columns);
    const dnnl::convolution_forward::desc told(
        dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct, source.get_desc(),
        {dims, type, Tag::any}, {{outputs}, Type::f32, Tag::a}, description(step.output),
        {step.stride_rows, step.stride_columns}, {rows.before, columns.before},
        {rows.after, columns.after});
    const dnnl::convolution_forward::primitive_desc convolution(told, cut_off(step), engine_);
    const dnnl::memory weights = constant(
        filter, {dims, Type::f32, depthwise ? Tag::hwigo : Tag::ohwi}, convolution.weights_desc());
    const dnnl::memory bias = constant(tensor(step.inputs.at(2)), {{outputs}, Type::f32, Tag::a},
                                       convolution.bias_desc());
    call(dnnl::convolution_forward(convolution), {{DNNL_ARG_SRC, source},
                                                  {DNNL_ARG_WEIGHTS, weights},
                                                  {DNNL_ARG_BIAS, bias},
                                                  {DNNL_ARG_DST, memory_for(step.output)}});
  }

  void add_sum(const TfliteStep& step) {
    const dnnl::memory first = input(step, 0), second = input(step, 1);
    const dnnl::binary::desc told(dnnl::algorithm::binary_add, first.get_desc(), second.get_desc(),
                                  description(step.output));
    call(dnnl::binary({told, cut_off(step), engine_}), {{DNNL_ARG_SRC_0, first},
                                                        {DNNL_ARG_SRC_1, second},
                                                        {DNNL_ARG_DST, memory_for(step.output)}});
  }

  void add_pooling(const TfliteStep& step) {
    const dnnl::memory source = input_as(type_of(step.output), step);
    const Dims in = source.get_desc().dims();
    const Padding rows = padding_for(step.same_padding, in[2], step.pool_rows, step.stride_rows);
    const Padding columns =
        padding_for(step.same_padding, in[3], step.pool_columns, step.stride_columns);
    const dnnl::pooling_forward::desc told(
        dnnl::prop_kind::forward_inference, dnnl::algorithm::pooling_max, source.get_desc(),
        description(step.output), {step.stride_rows, step.stride_columns},
        {step.pool_rows, step.pool_columns}, {rows.before, columns.before},
        {rows.after, columns.after});
    call(dnnl::pooling_forward({told, cut_off(step), engine_}),
         {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, memory_for(step.output)}});
  }

  void add_function(const TfliteStep& step, dnnl::algorithm function) {
    const dnnl::memory source = input_as(type_of(step.output), step);
    const dnnl::eltwise_forward::desc told(dnnl::prop_kind::forward_inference, function,
                                           source.get_desc(), 0.0F, 0.0F);
    const dnnl::memory result = memory_for(step.output);
    call(dnnl::eltwise_forward({told, cut_off(step), engine_}),
         {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, result}});
  }

  /// Rows, columns and channels lie as TensorFlow has them: another shape is the same memory.
  void add_reshape(const TfliteStep& step) {
    const std::uint32_t from = step.inputs.at(0);
    memories_[step.output] = memories_.at(from);
    busy_.erase(from);  // for good: both are it
  }

  void add_resize(const TfliteStep& step) {
    const dnnl::memory source = input(step, 0);
    const dnnl::resampling_forward::desc told(dnnl::prop_kind::forward_inference,
                                              dnnl::algorithm::resampling_linear, source.get_desc(),
                                              description(step.output));
    call(dnnl::resampling_forward({told, engine_}),
         {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, memory_for(step.output)}});
  }

  void add_padding(const TfliteStep& step) {
    const auto& padding = tensor(step.inputs.at(1)).integers;  // before, after of each dimension
    const dnnl::memory source = input(step, 0);
    owned_.emplace_back(description(step.output), engine_);  // its rim stays 0
    const dnnl::memory& whole = memories_[step.output] = owned_.back();
    std::fill_n(static_cast<char*>(whole.get_data_handle()), whole.get_desc().get_size(), '\0');
    const Dims offsets = {padding.at(0), padding.at(6), padding.at(2), padding.at(4)};
    const auto inside = whole.get_desc().submemory_desc(source.get_desc().dims(), offsets);
    const dnnl::reorder::primitive_desc told(engine_, source.get_desc(), engine_, inside);
    call(dnnl::reorder(told), {{DNNL_ARG_FROM, source}, {DNNL_ARG_TO, whole}});
  }

  const TfliteFile& file_;
  dnnl::engine engine_{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream_{engine_};
  std::set<std::uint32_t> is_exact_;
  std::map<std::uint32_t, std::size_t> last_use_;  ///< number of the step
  std::map<std::uint32_t, dnnl::memory> memories_;
  using Bytes = std::pair<std::size_t, void*>;
  std::multimap<std::size_t, void*> idle_;
  std::map<std::uint32_t, Bytes> busy_;
  std::vector<dnnl::memory> owned_;
  std::vector<Call> calls_;
};

}  // namespace

std::unique_ptr<NetworkEngine> make_onednn_engine(const NetworkPart& part) {
  return in_words("prepare", [&] { return std::make_unique<OneDnnEngine>(part); });
}

bool onednn_is_quick() {
  const auto needed = static_cast<int>(dnnl::cpu_isa::avx512_core_amx);
  return (static_cast<int>(dnnl::get_effective_cpu_isa()) & needed) == needed;
}

}  // namespace limbcast::segmenter
