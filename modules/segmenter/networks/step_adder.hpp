#pragma once

#include "modules/segmenter/networks/tflite_file.hpp"

namespace limbcast::segmenter {

/// Tells a library of a network's steps, in the order in which they are computed.
class StepAdder {
 public:
  StepAdder() = default;
  virtual ~StepAdder() = default;
  StepAdder(const StepAdder&) = delete;
  StepAdder& operator=(const StepAdder&) = delete;

  /// Throws std::runtime_error where the step's kind is not known.
  void add(const TfliteStep& step);

 private:
  virtual void add_convolution(const TfliteStep& step) = 0;
  virtual void add_depthwise_convolution(const TfliteStep& step) = 0;
  virtual void add_sum(const TfliteStep& step) = 0;
  virtual void add_max_pool(const TfliteStep& step) = 0;
  virtual void add_sigmoid(const TfliteStep& step) = 0;
  virtual void add_relu(const TfliteStep& step) = 0;
  virtual void add_reshape(const TfliteStep& step) = 0;
  virtual void add_resize(const TfliteStep& step) = 0;
  virtual void add_padding(const TfliteStep& step) = 0;
};

}  // namespace limbcast::segmenter
