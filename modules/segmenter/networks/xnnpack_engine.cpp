#include <xnnpack.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "modules/segmenter/networks/network_engine.hpp"
#include "modules/segmenter/networks/step_adder.hpp"

namespace limbcast::segmenter {
namespace {

constexpr std::uint32_t kUndefined = XNN_INVALID_VALUE_ID;
constexpr std::uint32_t kNoFlags = 0, kNoPadding = 0, kNoDilation = 1;

void check(xnn_status status, const char* what) {
  if (status != xnn_status_success)
    throw std::runtime_error("XNNPACK cannot " + std::string(what) + " the network (error " +
                             std::to_string(status) + ")");
}

/// Tells XNNPACK of tensors and steps.
class Subgraph : public StepAdder {
 public:
  /// Tensors of `external` are the caller's memory, and have numbers from 0 on in this order.
  Subgraph(const TfliteFile& file, const std::vector<std::uint32_t>& external)
      : file_(file), values_(file.tensors.size(), kUndefined) {
    check(xnn_create_subgraph(static_cast<std::uint32_t>(external.size()), kNoFlags, &subgraph_),
          "begin");
    for (std::uint32_t i = 0; i < external.size(); ++i)
      define(external[i], i,
             i == 0 ? XNN_VALUE_FLAG_EXTERNAL_INPUT : XNN_VALUE_FLAG_EXTERNAL_OUTPUT);
  }
  ~Subgraph() override { xnn_delete_subgraph(subgraph_); }

  xnn_subgraph_t get() const { return subgraph_; }

 private:
  std::uint32_t define(std::uint32_t tensor, std::uint32_t external_id, std::uint32_t flags) {
    const TfliteTensor& told = file_.tensors.at(tensor);
    check(
        xnn_define_tensor_value(subgraph_, xnn_datatype_fp32, told.shape.size(), told.shape.data(),
                                told.numbers.empty() ? nullptr : told.numbers.data(), external_id,
                                flags, &values_.at(tensor)),
        "hold a tensor of");
    return values_.at(tensor);
  }
  std::uint32_t value(std::uint32_t tensor) {
    const std::uint32_t value = values_.at(tensor);
    return value == kUndefined ? define(tensor, XNN_INVALID_VALUE_ID, kNoFlags) : value;
  }
  std::uint32_t input(const TfliteStep& step, std::size_t index) {
    return value(step.inputs.at(index));
  }
  const std::vector<std::size_t>& input_shape(const TfliteStep& step, std::size_t index) const {
    return file_.tensors.at(step.inputs.at(index)).shape;
  }
  static std::uint32_t flags(const TfliteStep& step) {
    return step.same_padding ? XNN_FLAG_TENSORFLOW_SAME_PADDING : kNoFlags;
  }

  void add_convolution(const TfliteStep& step) override {
    const auto& filter = input_shape(step, 1);  // outputs, rows, columns, inputs
    check(xnn_define_convolution_2d(
              subgraph_, kNoPadding, kNoPadding, kNoPadding, kNoPadding,
              static_cast<std::uint32_t>(filter.at(1)), static_cast<std::uint32_t>(filter.at(2)),
              step.stride_rows, step.stride_columns, kNoDilation, kNoDilation, 1, filter.at(3),
              filter.at(0), step.output_min, step.output_max, input(step, 0), input(step, 1),
              input(step, 2), value(step.output), flags(step)),
          "convolve in");
  }

  void add_depthwise_convolution(const TfliteStep& step) override {
    const auto& filter = input_shape(step, 1);  // 1, rows, columns, outputs
    const std::size_t channels = input_shape(step, 0).at(3);
    check(xnn_define_depthwise_convolution_2d(
              subgraph_, kNoPadding, kNoPadding, kNoPadding, kNoPadding,
              static_cast<std::uint32_t>(filter.at(1)), static_cast<std::uint32_t>(filter.at(2)),
              step.stride_rows, step.stride_columns, kNoDilation, kNoDilation,
              static_cast<std::uint32_t>(filter.at(3) / channels), channels, step.output_min,
              step.output_max, input(step, 0), input(step, 1), input(step, 2), value(step.output),
              flags(step)),
          "convolve each channel in");
  }

  void add_sum(const TfliteStep& step) override {
    check(xnn_define_add2(subgraph_, step.output_min, step.output_max, input(step, 0),
                          input(step, 1), value(step.output), kNoFlags),
          "add in");
  }

  void add_max_pool(const TfliteStep& step) override {
    check(xnn_define_max_pooling_2d(
              subgraph_, kNoPadding, kNoPadding, kNoPadding, kNoPadding, step.pool_rows,
              step.pool_columns, step.stride_rows, step.stride_columns, kNoDilation, kNoDilation,
              step.output_min, step.output_max, input(step, 0), value(step.output), flags(step)),
          "pool in");
  }

  void add_sigmoid(const TfliteStep& step) override {
    check(xnn_define_sigmoid(subgraph_, input(step, 0), value(step.output), kNoFlags),
          "take the sigmoid in");
  }

  void add_relu(const TfliteStep& step) override {
    check(xnn_define_clamp(subgraph_, 0.0F, std::numeric_limits<float>::infinity(), input(step, 0),
                           value(step.output), kNoFlags),
          "cut off in");
  }

  void add_reshape(const TfliteStep& step) override {
    const auto& shape = file_.tensors.at(step.output).shape;
    check(xnn_define_static_reshape(subgraph_, shape.size(), shape.data(), input(step, 0),
                                    value(step.output), kNoFlags),
          "reshape in");
  }

  void add_resize(const TfliteStep& step) override {
    const auto& shape = file_.tensors.at(step.output).shape;
    check(xnn_define_static_resize_bilinear_2d(subgraph_, shape.at(1), shape.at(2), input(step, 0),
                                               value(step.output), kNoFlags),
          "resize in");
  }

  void add_padding(const TfliteStep& step) override {
    // Before and after each dimension in turn.
    const std::vector<std::int32_t>& padding = file_.tensors.at(step.inputs.at(1)).integers;
    std::vector<std::size_t> before, after;
    for (std::size_t i = 0; i + 1 < padding.size(); i += 2) {
      before.push_back(static_cast<std::size_t>(padding[i]));
      after.push_back(static_cast<std::size_t>(padding[i + 1]));
    }
    constexpr float kPaddingValue = 0.0F;
    check(xnn_define_static_constant_pad(subgraph_, before.data(), after.data(), kPaddingValue,
                                         input(step, 0), value(step.output), kNoFlags),
          "pad in");
  }

  const TfliteFile& file_;
  std::vector<std::uint32_t> values_;  // XNNPACK's number of each tensor
  xnn_subgraph_t subgraph_ = nullptr;
};

/// A network as XNNPACK prepared it.
class Runtime {
 public:
  explicit Runtime(const Subgraph* subgraph) {
    constexpr pthreadpool_t kOneThread = nullptr;
    check(xnn_create_runtime_v2(subgraph->get(), kOneThread, kNoFlags, &runtime_), "prepare");
  }
  ~Runtime() { xnn_delete_runtime(runtime_); }
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  void set_up(const std::vector<xnn_external_value>& values) {
    check(xnn_setup_runtime(runtime_, values.size(), values.data()), "set up");
  }
  void run() { check(xnn_invoke_runtime(runtime_), "run"); }

 private:
  xnn_runtime_t runtime_ = nullptr;
};

class XnnpackEngine : public NetworkEngine {
 public:
  explicit XnnpackEngine(const NetworkPart& part) : runtime_(subgraph_of(part).get()) {
    std::vector<xnn_external_value> values = {{0, part.input}};
    for (std::uint32_t i = 0; i < part.outputs.size(); ++i)
      values.push_back({i + 1, part.output_numbers.at(i)});
    runtime_.set_up(values);
  }
  void run() override { runtime_.run(); }

 private:
  static std::unique_ptr<Subgraph> subgraph_of(const NetworkPart& part) {
    check(xnn_initialize(nullptr), "start on this processor for");
    std::vector<std::uint32_t> external = {part.file.input};
    external.insert(external.end(), part.outputs.begin(), part.outputs.end());
    auto subgraph = std::make_unique<Subgraph>(part.file, external);
    for (const TfliteStep& step : part.steps) subgraph->add(step);
    return subgraph;
  }

  Runtime runtime_;
};

}  // namespace

std::unique_ptr<NetworkEngine> make_xnnpack_engine(const NetworkPart& part) {
  static_assert(kExtraNumbers * sizeof(float) >= XNN_EXTRA_BYTES);
  return std::make_unique<XnnpackEngine>(part);
}

}  // namespace limbcast::segmenter
