#include "modules/segmenter/tflite_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "modules/segmenter/blaze_face.hpp"
#include "modules/segmenter/blaze_pose.hpp"
#include "modules/segmenter/move_net.hpp"

namespace limbcast::segmenter {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;

/// A network that is put together step by step.
class SmallNetwork {
 public:
  explicit SmallNetwork(std::vector<std::size_t> input_shape) {
    add_tensor(std::move(input_shape));
  }

  std::uint32_t add_tensor(std::vector<std::size_t> shape, std::vector<float> numbers = {},
                           std::vector<std::int32_t> integers = {}) {
    const auto index = static_cast<std::uint32_t>(file_.tensors.size());
    file_.tensors.push_back(
        {std::to_string(index), std::move(shape), std::move(numbers), std::move(integers)});
    return index;
  }
  /// The step's result, of shape `shape`, becomes an output.
  TfliteStep& add_step(TfliteKind kind, std::vector<std::uint32_t> inputs,
                       std::vector<std::size_t> shape) {
    TfliteStep step;
    step.kind = kind;
    step.inputs = std::move(inputs);
    step.output = add_tensor(std::move(shape));
    file_.outputs.push_back(step.output);
    return file_.steps.emplace_back(step);
  }
  /// `count` numbers of the last step's result.
  std::vector<float> run(const std::vector<float>& input, std::size_t count) const {
    TfliteNetwork network(file_, {file_.tensors.at(file_.outputs.back()).name});
    std::copy(input.begin(), input.end(), network.input());
    network.run();
    return {network.output(0), network.output(0) + count};
  }

 private:
  TfliteFile file_;
};

TEST(TfliteNetwork, ConvolvesAllChannels) {
  SmallNetwork network({1, 1, 2, 2});
  const auto filter = network.add_tensor({1, 1, 1, 2}, {2.0F, 3.0F});
  const auto bias = network.add_tensor({1}, {0.5F});
  network.add_step(TfliteKind::kConvolution, {0, filter, bias}, {1, 1, 2, 1});
  EXPECT_THAT(network.run({1.0F, 10.0F, 2.0F, 20.0F}, 2), ElementsAre(32.5F, 64.5F));
}

TEST(TfliteNetwork, ConvolvesEachChannelAlone) {
  SmallNetwork network({1, 1, 2, 2});
  const auto filter = network.add_tensor({1, 1, 2, 2}, {1.0F, 2.0F, 3.0F, 4.0F});
  const auto bias = network.add_tensor({2}, {0.0F, 0.5F});
  network.add_step(TfliteKind::kDepthwiseConvolution, {0, filter, bias}, {1, 1, 1, 2});
  EXPECT_THAT(network.run({1.0F, 10.0F, 2.0F, 20.0F}, 2), ElementsAre(7.0F, 100.5F));
}

TEST(TfliteNetwork, CutsOffWhatIsNegative) {
  SmallNetwork network({1, 1, 3, 1});
  network.add_step(TfliteKind::kRelu, {0}, {1, 1, 3, 1});
  EXPECT_THAT(network.run({-2.0F, 0.5F, 7.0F}, 3), ElementsAre(0.0F, 0.5F, 7.0F));
}

TEST(TfliteNetwork, PadsTheOddPixelAfterAsTensorFlowDoes) {
  SmallNetwork network({1, 1, 4, 1});
  const auto filter = network.add_tensor({1, 1, 3, 1}, {1.0F, 10.0F, 100.0F});
  const auto bias = network.add_tensor({1}, {0.0F});
  TfliteStep& step = network.add_step(TfliteKind::kConvolution, {0, filter, bias}, {1, 1, 2, 1});
  step.same_padding = true;
  step.stride_columns = 2;
  EXPECT_THAT(network.run({1.0F, 2.0F, 3.0F, 4.0F}, 2), ElementsAre(321.0F, 43.0F));
}

TEST(TfliteNetwork, CutsWhatAnActivationCuts) {
  SmallNetwork network({1, 1, 3, 1});
  const auto other = network.add_tensor({1, 1, 3, 1}, {0.0F, 0.0F, 0.0F});
  TfliteStep& step = network.add_step(TfliteKind::kAdd, {0, other}, {1, 1, 3, 1});
  step.output_min = 0.0F;
  step.output_max = 6.0F;
  EXPECT_THAT(network.run({-1.0F, 5.0F, 7.0F}, 3), ElementsAre(0.0F, 5.0F, 6.0F));
}

TEST(TfliteNetwork, PadsBeforeAndAfter) {
  SmallNetwork network({1, 1, 2, 1});
  const auto padding = network.add_tensor({4, 2}, {}, {0, 0, 0, 0, 2, 1, 0, 0});
  network.add_step(TfliteKind::kPad, {0, padding}, {1, 1, 5, 1});
  EXPECT_THAT(network.run({1.0F, 2.0F}, 5), ElementsAre(0.0F, 0.0F, 1.0F, 2.0F, 0.0F));
}

TEST(TfliteNetwork, TakesTheLargestOfAPool) {
  SmallNetwork network({1, 2, 4, 1});
  TfliteStep& step = network.add_step(TfliteKind::kMaxPool, {0}, {1, 1, 2, 1});
  step.pool_rows = step.pool_columns = step.stride_rows = step.stride_columns = 2;
  EXPECT_THAT(network.run({1.0F, 2.0F, 3.0F, 4.0F, 8.0F, 7.0F, 6.0F, 5.0F}, 2),
              ElementsAre(8.0F, 6.0F));
}

TEST(TfliteNetwork, TakesTheSigmoidAndReshapes) {
  SmallNetwork network({1, 1, 1, 2});
  TfliteStep& sigmoid = network.add_step(TfliteKind::kSigmoid, {0}, {1, 1, 1, 2});
  const std::uint32_t seen = sigmoid.output;
  network.add_step(TfliteKind::kReshape, {seen}, {1, 2});
  EXPECT_THAT(network.run({0.0F, std::log(3.0F)}, 2), ElementsAre(0.5F, FloatEq(0.75F)));
}

TEST(TfliteNetwork, ResizesBetweenTheMiddlesOfPixels) {
  SmallNetwork network({1, 1, 2, 1});
  network.add_step(TfliteKind::kResizeBilinear, {0}, {1, 2, 4, 1});
  EXPECT_THAT(network.run({0.0F, 4.0F}, 8),
              ElementsAre(0.0F, 1.0F, 3.0F, 4.0F, 0.0F, 1.0F, 3.0F, 4.0F));
}

TEST(TfliteNetwork, RefusesAStepThatItDoesNotKnow) {
  SmallNetwork network({1, 1, 1, 1});
  constexpr int kRankOfAMatrix = 110;
  network.add_step(static_cast<TfliteKind>(kRankOfAMatrix), {0}, {1});
  try {
    network.run({1.0F}, 1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("kind that is not known (110)"));
  }
}

TEST(TfliteNetwork, RefusesAnOutputThatTheFileLacks) {
  try {
    const TfliteNetwork network(BlazePose::file(), {"Identity", "hands"});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no output hands"));
  }
}

TEST(TfliteFile, HoldsBlazePose) {
  const TfliteFile& file = BlazePose::file();
  EXPECT_THAT(file.tensors.at(file.input).shape, ElementsAre(1, 256, 256, 3));
  std::vector<std::string> outputs;
  for (const std::uint32_t output : file.outputs) outputs.push_back(file.tensors.at(output).name);
  EXPECT_THAT(outputs,
              ElementsAre("Identity", "Identity_1", "Identity_2", "Identity_3", "Identity_4"));
  const auto first = std::find_if(file.steps.begin(), file.steps.end(), [](const TfliteStep& s) {
    return s.kind == TfliteKind::kConvolution;
  });
  ASSERT_NE(first, file.steps.end());
  EXPECT_FALSE(first->same_padding);
  EXPECT_EQ(first->stride_rows, 2U);
  EXPECT_EQ(first->stride_columns, 2U);
  EXPECT_EQ(first->output_min, 0.0F);
  EXPECT_EQ(first->output_max, 6.0F);
  const TfliteTensor& filter = file.tensors.at(first->inputs.at(1));
  EXPECT_THAT(filter.shape, ElementsAre(24, 3, 3, 3));
  EXPECT_EQ(filter.numbers.size(), 24U * 27U) << "16 bits in the file";
}

TEST(TfliteFile, HoldsBlazeFace) {
  const TfliteFile& file = BlazeFace::file();
  EXPECT_THAT(file.tensors.at(file.input).shape, ElementsAre(1, 192, 192, 3));
  EXPECT_THAT(file.tensors.at(file.outputs.at(0)).shape, ElementsAre(1, 48 * 48, 16));
  EXPECT_THAT(file.tensors.at(file.outputs.at(1)).shape, ElementsAre(1, 48 * 48, 1));
}

TEST(TfliteFile, HoldsMoveNet) {
  const TfliteFile& file = MoveNet::file();
  EXPECT_THAT(file.tensors.at(file.input).shape, ElementsAre(1, 256, 256, 3));
  std::vector<std::string> outputs;
  for (const std::uint32_t output : file.outputs) {
    outputs.push_back(file.tensors.at(output).name);
    EXPECT_EQ(file.tensors.at(output).shape.at(1), 64U);
  }
  EXPECT_THAT(outputs, ElementsAre("center", "heatmap", "regression", "offset"));
}

}  // namespace
}  // namespace limbcast::segmenter
