#include <omp.h>

#include <algorithm>
#include <dnnl.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "modules/segmenter/networks/network_engine.hpp"
#include "modules/segmenter/networks/onednn_tensors.hpp"
#include "modules/segmenter/networks/step_adder.hpp"

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

/// Windows that move over an image.
struct Windows {
  Dims sides, strides;  ///< rows, columns
  Dims padding_before, padding_after;
};

Windows windows_over(const Dims& image, const Dims& sides, const TfliteStep& step) {
  Windows windows{sides, {step.stride_rows, step.stride_columns}, {0, 0}, {0, 0}};
  if (!step.same_padding) return windows;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::int64_t pixels = image.at(2 + i), stride = windows.strides[i];
    const std::int64_t outputs = (pixels + stride - 1) / stride;
    const std::int64_t padding =
        std::max<std::int64_t>(0, (outputs - 1) * stride + sides[i] - pixels);
    windows.padding_before[i] = padding / 2;
    windows.padding_after[i] = padding - padding / 2;
  }
  return windows;
}

dnnl::primitive_attr cut_off(const TfliteStep& step) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  dnnl::post_ops operations;
  if (step.output_min > -kInfinity || step.output_max < kInfinity)
    operations.append_eltwise(1.0F, dnnl::algorithm::eltwise_clip, step.output_min,
                              step.output_max);
  dnnl::primitive_attr attributes;
  attributes.set_post_ops(operations);
  return attributes;
}

/// Tells oneDNN of steps.
class OneDnnSteps : public StepAdder {
 public:
  OneDnnSteps(OneDnnTensors& tensors, OneDnnCalls& calls)
      : tensors_(tensors), calls_(calls), engine_(calls.engine()) {}

 private:
  /// Length of a dimension of a convolution's filter.
  std::int64_t length(const TfliteStep& step, std::size_t dimension) const {
    return static_cast<std::int64_t>(tensors_.told(step.inputs.at(1)).shape.at(dimension));
  }

  /// The filter: outputs, rows, columns, inputs.
  void add_convolution(const TfliteStep& step) override {
    convolve(step, {length(step, 0), length(step, 3), length(step, 1), length(step, 2)}, Tag::ohwi,
             length(step, 0));
  }
  /// The filter: 1, rows, columns, outputs, of which each is one of oneDNN's groups.
  void add_depthwise_convolution(const TfliteStep& step) override {
    if (tensors_.input(step, 0).get_desc().dims().at(1) != length(step, 3))
      throw std::runtime_error("a step of the network makes several channels of one");
    convolve(step, {length(step, 3), 1, 1, length(step, 1), length(step, 2)}, Tag::hwigo,
             length(step, 3));
  }
  void convolve(const TfliteStep& step, const Dims& filter, Tag filter_order,
                std::int64_t outputs) {
    const Type type = tensors_.computed_type(step.output);
    const dnnl::memory source = tensors_.input_as(type, step);
    const Windows windows =
        windows_over(source.get_desc().dims(), {length(step, 1), length(step, 2)}, step);
    const dnnl::memory::desc bias_as_told{{outputs}, Type::f32, Tag::a};
    const dnnl::convolution_forward::desc told(
        dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_direct, source.get_desc(),
        {filter, type, Tag::any}, bias_as_told, tensors_.description(step.output), windows.strides,
        windows.padding_before, windows.padding_after);
    const dnnl::convolution_forward::primitive_desc convolution(told, cut_off(step), engine_);
    const dnnl::memory weights = tensors_.constant(
        step.inputs.at(1), {filter, Type::f32, filter_order}, convolution.weights_desc());
    const dnnl::memory bias =
        tensors_.constant(step.inputs.at(2), bias_as_told, convolution.bias_desc());
    calls_.add(dnnl::convolution_forward(convolution),
               {{DNNL_ARG_SRC, source},
                {DNNL_ARG_WEIGHTS, weights},
                {DNNL_ARG_BIAS, bias},
                {DNNL_ARG_DST, tensors_.output(step.output)}});
  }

  void add_sum(const TfliteStep& step) override {
    const dnnl::memory first = tensors_.input(step, 0), second = tensors_.input(step, 1);
    const dnnl::binary::desc told(dnnl::algorithm::binary_add, first.get_desc(), second.get_desc(),
                                  tensors_.description(step.output));
    calls_.add(dnnl::binary({told, cut_off(step), engine_}),
               {{DNNL_ARG_SRC_0, first},
                {DNNL_ARG_SRC_1, second},
                {DNNL_ARG_DST, tensors_.output(step.output)}});
  }

  void add_max_pool(const TfliteStep& step) override {
    const dnnl::memory source = tensors_.input_as(tensors_.kept_type(step.output), step);
    const Windows windows =
        windows_over(source.get_desc().dims(), {step.pool_rows, step.pool_columns}, step);
    const dnnl::pooling_forward::desc told(
        dnnl::prop_kind::forward_inference, dnnl::algorithm::pooling_max, source.get_desc(),
        tensors_.description(step.output), windows.strides, windows.sides, windows.padding_before,
        windows.padding_after);
    add_one_to_one(step, source, dnnl::pooling_forward({told, cut_off(step), engine_}));
  }

  void add_sigmoid(const TfliteStep& step) override {
    add_function(step, dnnl::algorithm::eltwise_logistic);
  }
  void add_relu(const TfliteStep& step) override {
    add_function(step, dnnl::algorithm::eltwise_relu);
  }
  void add_function(const TfliteStep& step, dnnl::algorithm function) {
    const dnnl::memory source = tensors_.input_as(tensors_.kept_type(step.output), step);
    const dnnl::eltwise_forward::desc told(dnnl::prop_kind::forward_inference, function,
                                           source.get_desc(), 0.0F, 0.0F);
    add_one_to_one(step, source, dnnl::eltwise_forward({told, cut_off(step), engine_}));
  }

  /// Rows, columns and channels lie as TensorFlow has them: another shape is the same memory.
  void add_reshape(const TfliteStep& step) override {
    tensors_.make_same(step.output, step.inputs.at(0));
  }

  void add_resize(const TfliteStep& step) override {
    const dnnl::memory source = tensors_.input(step, 0);
    const dnnl::resampling_forward::desc told(dnnl::prop_kind::forward_inference,
                                              dnnl::algorithm::resampling_linear, source.get_desc(),
                                              tensors_.description(step.output));
    add_one_to_one(step, source, dnnl::resampling_forward({told, engine_}));
  }

  void add_padding(const TfliteStep& step) override {
    // Before and after each dimension in turn.
    const auto& padding = tensors_.told(step.inputs.at(1)).integers;
    const dnnl::memory source = tensors_.input(step, 0);
    const dnnl::memory whole = tensors_.output_of_zeros(step.output);
    const Dims offsets = {padding.at(0), padding.at(6), padding.at(2), padding.at(4)};
    const auto inside = whole.get_desc().submemory_desc(source.get_desc().dims(), offsets);
    const dnnl::reorder::primitive_desc told(engine_, source.get_desc(), engine_, inside);
    calls_.add(dnnl::reorder(told), {{DNNL_ARG_FROM, source}, {DNNL_ARG_TO, whole}});
  }

  /// A primitive that makes the step's output of one input alone.
  void add_one_to_one(const TfliteStep& step, const dnnl::memory& source,
                      dnnl::primitive primitive) {
    calls_.add(std::move(primitive),
               {{DNNL_ARG_SRC, source}, {DNNL_ARG_DST, tensors_.output(step.output)}});
  }

  OneDnnTensors& tensors_;
  OneDnnCalls& calls_;
  const dnnl::engine& engine_;
};

class OneDnnEngine : public NetworkEngine {
 public:
  explicit OneDnnEngine(const NetworkPart& part) : tensors_(part, calls_) {
    const OneThread one_thread;
    tensors_.copy_from(part.input, part.file.input);
    OneDnnSteps steps(tensors_, calls_);
    for (std::size_t i = 0; i < part.steps.size(); ++i) {
      steps.add(part.steps[i]);
      tensors_.release_inputs(part.steps[i], i);
    }
    for (std::size_t i = 0; i < part.outputs.size(); ++i)
      tensors_.copy_to(part.output_numbers.at(i), part.outputs[i]);
  }

  void run() override {
    const OneThread one_thread;
    in_words("run", [&] { calls_.run(); });
  }

 private:
  OneDnnCalls calls_;
  OneDnnTensors tensors_;
};

}  // namespace

std::unique_ptr<NetworkEngine> make_onednn_engine(const NetworkPart& part) {
  return in_words("prepare", [&] { return std::make_unique<OneDnnEngine>(part); });
}

bool onednn_is_quick() {
  if (computes_brain_floats()) return true;
  // Debian's XNNPACK has too few registers there: its innermost loop waits for memory.
  return onednn_has(dnnl::cpu_isa::avx2) && !onednn_has(dnnl::cpu_isa::avx512_core);
}

}  // namespace limbcast::segmenter
