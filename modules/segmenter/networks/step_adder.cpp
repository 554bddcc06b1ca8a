#include "modules/segmenter/networks/step_adder.hpp"

#include <stdexcept>
#include <string>

namespace limbcast::segmenter {

void StepAdder::add(const TfliteStep& step) {
  switch (step.kind) {
    case TfliteKind::kConvolution:
      return add_convolution(step);
    case TfliteKind::kDepthwiseConvolution:
      return add_depthwise_convolution(step);
    case TfliteKind::kAdd:
      return add_sum(step);
    case TfliteKind::kMaxPool:
      return add_max_pool(step);
    case TfliteKind::kSigmoid:
      return add_sigmoid(step);
    case TfliteKind::kRelu:
      return add_relu(step);
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

}  // namespace limbcast::segmenter
