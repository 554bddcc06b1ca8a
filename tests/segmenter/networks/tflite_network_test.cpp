#include "modules/segmenter/networks/tflite_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "modules/segmenter/faces_and_joints/blaze_face.hpp"
#include "modules/segmenter/faces_and_joints/blaze_pose.hpp"
#include "modules/segmenter/faces_and_joints/move_net.hpp"

namespace limbcast::segmenter {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::HasSubstr;

/// A network that is put together step by step.
class SmallNetwork {
 public:
  SmallNetwork(NetworkLibrary library, std::vector<std::size_t> input_shape) : library_(library) {
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
  /// The last step's result.
  std::uint32_t last() const { return file_.outputs.back(); }
  /// `count` numbers of the last step's result, where no other is wanted or those of all steps.
  std::vector<float> run(const std::vector<float>& input, std::size_t count) const {
    return run(input, count, {last()});
  }
  std::vector<float> run_all(const std::vector<float>& input, std::size_t count) const {
    return run(input, count, file_.outputs);
  }

 private:
  std::vector<float> run(const std::vector<float>& input, std::size_t count,
                         const std::vector<std::uint32_t>& wanted) const {
    std::vector<std::string> names;
    for (const std::uint32_t output : wanted) names.push_back(file_.tensors.at(output).name);
    TfliteNetwork network(file_, names, library_);
    std::copy(input.begin(), input.end(), network.input());
    network.run();
    const float* last = network.output(names.size() - 1);
    return {last, last + count};
  }

  NetworkLibrary library_;
  TfliteFile file_;
};

class TfliteNetworkBy : public testing::TestWithParam<NetworkLibrary> {};

INSTANTIATE_TEST_SUITE_P(Each, TfliteNetworkBy, testing::ValuesIn(network_libraries()),
                         [](const auto& tested) {
                           return tested.param == NetworkLibrary::kOneDnn ? "OneDnn" : "Xnnpack";
                         });

TEST_P(TfliteNetworkBy, ConvolvesAllChannels) {
  SmallNetwork network(GetParam(), {1, 1, 2, 2});
  const auto filter = network.add_tensor({1, 1, 1, 2}, {2.0F, 3.0F});
  const auto bias = network.add_tensor({1}, {0.5F});
  network.add_step(TfliteKind::kConvolution, {0, filter, bias}, {1, 1, 2, 1});
  EXPECT_THAT(network.run({1.0F, 10.0F, 2.0F, 20.0F}, 2), ElementsAre(32.5F, 64.5F));
}

TEST_P(TfliteNetworkBy, ConvolvesEachChannelAlone) {
  SmallNetwork network(GetParam(), {1, 1, 2, 2});
  const auto filter = network.add_tensor({1, 1, 2, 2}, {1.0F, 2.0F, 3.0F, 4.0F});
  const auto bias = network.add_tensor({2}, {0.0F, 0.5F});
  network.add_step(TfliteKind::kDepthwiseConvolution, {0, filter, bias}, {1, 1, 1, 2});
  EXPECT_THAT(network.run({1.0F, 10.0F, 2.0F, 20.0F}, 2), ElementsAre(7.0F, 100.5F));
}

TEST_P(TfliteNetworkBy, CutsOffWhatIsNegative) {
  SmallNetwork network(GetParam(), {1, 1, 3, 1});
  network.add_step(TfliteKind::kRelu, {0}, {1, 1, 3, 1});
  EXPECT_THAT(network.run({-2.0F, 0.5F, 7.0F}, 3), ElementsAre(0.0F, 0.5F, 7.0F));
}

TEST_P(TfliteNetworkBy, PadsTheOddPixelAfterAsTensorFlowDoes) {
  SmallNetwork network(GetParam(), {1, 1, 4, 1});
  const auto filter = network.add_tensor({1, 1, 3, 1}, {1.0F, 10.0F, 100.0F});
  const auto bias = network.add_tensor({1}, {0.0F});
  TfliteStep& step = network.add_step(TfliteKind::kConvolution, {0, filter, bias}, {1, 1, 2, 1});
  step.same_padding = true;
  step.stride_columns = 2;
  EXPECT_THAT(network.run({1.0F, 2.0F, 3.0F, 4.0F}, 2), ElementsAre(321.0F, 43.0F));
}

TEST_P(TfliteNetworkBy, CutsWhatAnActivationCuts) {
  SmallNetwork network(GetParam(), {1, 1, 3, 1});
  const auto other = network.add_tensor({1, 1, 3, 1}, {0.0F, 0.0F, 0.0F});
  TfliteStep& step = network.add_step(TfliteKind::kAdd, {0, other}, {1, 1, 3, 1});
  step.output_min = 0.0F;
  step.output_max = 6.0F;
  EXPECT_THAT(network.run({-1.0F, 5.0F, 7.0F}, 3), ElementsAre(0.0F, 5.0F, 6.0F));
}

/// Of so many rows that 16 bits are enough for what is no output.
const std::vector<std::size_t> kTallShape = {1, 8, 1, 1};
const std::vector<float> kTallInput = {-1.0F, 0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};

TEST_P(TfliteNetworkBy, GoesOnFromAnOutput) {
  SmallNetwork network(GetParam(), kTallShape);
  const auto filter = network.add_tensor({1, 1, 1, 1}, {2.0F});
  const auto bias = network.add_tensor({1}, {1.0F});
  const std::uint32_t cut = network.add_step(TfliteKind::kRelu, {0}, kTallShape).output;
  network.add_step(TfliteKind::kConvolution, {cut, filter, bias}, kTallShape);
  network.add_step(TfliteKind::kAdd, {network.last(), cut}, kTallShape);
  EXPECT_THAT(network.run_all(kTallInput, 8),
              ElementsAre(1.0F, 1.0F, 4.0F, 7.0F, 10.0F, 13.0F, 16.0F, 19.0F));
}

TEST_P(TfliteNetworkBy, KeepsWhatIsNeededInAnotherShape) {
  SmallNetwork network(GetParam(), kTallShape);
  const auto filter = network.add_tensor({1, 1, 1, 1}, {2.0F});
  const auto bias = network.add_tensor({1}, {1.0F});
  const std::uint32_t cut = network.add_step(TfliteKind::kRelu, {0}, kTallShape).output;
  const std::uint32_t shaped = network.add_step(TfliteKind::kReshape, {cut}, kTallShape).output;
  network.add_step(TfliteKind::kConvolution, {shaped, filter, bias}, kTallShape);
  network.add_step(TfliteKind::kConvolution, {network.last(), filter, bias}, kTallShape);
  network.add_step(TfliteKind::kAdd, {network.last(), shaped}, kTallShape);
  EXPECT_THAT(network.run(kTallInput, 8),
              ElementsAre(3.0F, 3.0F, 8.0F, 13.0F, 18.0F, 23.0F, 28.0F, 33.0F));
}

TEST_P(TfliteNetworkBy, PadsBeforeAndAfter) {
  SmallNetwork network(GetParam(), {1, 1, 2, 1});
  const auto padding = network.add_tensor({4, 2}, {}, {0, 0, 0, 0, 2, 1, 0, 0});
  network.add_step(TfliteKind::kPad, {0, padding}, {1, 1, 5, 1});
  EXPECT_THAT(network.run({1.0F, 2.0F}, 5), ElementsAre(0.0F, 0.0F, 1.0F, 2.0F, 0.0F));
}

TEST_P(TfliteNetworkBy, TakesTheLargestOfAPool) {
  SmallNetwork network(GetParam(), {1, 2, 4, 1});
  TfliteStep& step = network.add_step(TfliteKind::kMaxPool, {0}, {1, 1, 2, 1});
  step.pool_rows = step.pool_columns = step.stride_rows = step.stride_columns = 2;
  EXPECT_THAT(network.run({1.0F, 2.0F, 3.0F, 4.0F, 8.0F, 7.0F, 6.0F, 5.0F}, 2),
              ElementsAre(8.0F, 6.0F));
}

TEST_P(TfliteNetworkBy, TakesTheSigmoidAndReshapes) {
  SmallNetwork network(GetParam(), {1, 1, 1, 2});
  TfliteStep& sigmoid = network.add_step(TfliteKind::kSigmoid, {0}, {1, 1, 1, 2});
  const std::uint32_t seen = sigmoid.output;
  network.add_step(TfliteKind::kReshape, {seen}, {1, 2});
  EXPECT_THAT(network.run({0.0F, std::log(3.0F)}, 2), ElementsAre(0.5F, FloatEq(0.75F)));
}

TEST_P(TfliteNetworkBy, ResizesBetweenTheMiddlesOfPixels) {
  SmallNetwork network(GetParam(), {1, 1, 2, 1});
  network.add_step(TfliteKind::kResizeBilinear, {0}, {1, 2, 4, 1});
  EXPECT_THAT(network.run({0.0F, 4.0F}, 8),
              ElementsAre(0.0F, 1.0F, 3.0F, 4.0F, 0.0F, 1.0F, 3.0F, 4.0F));
}

TEST_P(TfliteNetworkBy, RefusesAStepThatItDoesNotKnow) {
  SmallNetwork network(GetParam(), {1, 1, 1, 1});
  constexpr int kRankOfAMatrix = 110;
  network.add_step(static_cast<TfliteKind>(kRankOfAMatrix), {0}, {1});
  try {
    network.run({1.0F}, 1);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("kind that is not known (110)"));
  }
}

/// Picture that a network sees people's limbs in or not; what counts is that it is no even one.
void draw_waves(std::size_t count, float* numbers) {
  for (std::size_t i = 0; i < count; ++i)
    numbers[i] = static_cast<float>(0.5 + 0.4 * std::sin(0.01 * static_cast<double>(i)));
}

TEST(TfliteNetwork, GivesNearlyTheSameByEachLibrary) {
  std::vector<std::vector<float>> results;
  for (const NetworkLibrary library : network_libraries()) {
    TfliteNetwork network(BlazeFace::file(), {"reshaped_classifier_face_4"}, library);
    draw_waves(std::size_t{192} * 192 * 3, network.input());
    network.run();
    results.emplace_back(network.output(0), network.output(0) + std::size_t{48} * 48);
  }
  const auto [least, most] = std::minmax_element(results[0].begin(), results[0].end());
  EXPECT_GT(*most - *least, 2.0F) << "an even picture tells nothing";
  // Brain floats have 8 bits, over some 60 layers.
  for (const auto& result : results)
    for (std::size_t i = 0; i < result.size(); ++i)
      ASSERT_NEAR(result[i], results[0][i], 0.3F) << i;
}

#ifdef __x86_64__
/// On a processor that has no more than these instructions, as oneDNN names them: it asks for them
/// once a process, so another one answers.
bool onednn_comes_first(const char* instructions) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  setenv("ONEDNN_MAX_CPU_ISA", instructions, 1);
  constexpr int kYes = 10, kNo = 11;
  int answer = 0;
  const auto is_answer = [&](int status) {
    answer = WEXITSTATUS(status);
    return answer == kYes || answer == kNo;
  };
  EXPECT_EXIT(std::exit(network_libraries().front() == NetworkLibrary::kOneDnn ? kYes : kNo),
              is_answer, "");
  unsetenv("ONEDNN_MAX_CPU_ISA");
  return answer == kYes;
}

TEST(NetworkLibraries, BeginWithOneDnnOnProcessorsWithAvx2AndNoAvx512) {
  EXPECT_FALSE(onednn_comes_first("SSE41"));
  const bool has_avx2 = __builtin_cpu_supports("avx2"),
             has_avx512 = __builtin_cpu_supports("avx512bw");
  EXPECT_EQ(onednn_comes_first("AVX2"), has_avx2);
  EXPECT_EQ(onednn_comes_first("AVX512_CORE"), has_avx2 && !has_avx512);
}
#endif

TEST_P(TfliteNetworkBy, GivesTheSameAgainAndAgain) {
  TfliteNetwork network(BlazeFace::file(), {"reshaped_regressor_face_4"}, GetParam());
  constexpr std::size_t kNumbers = std::size_t{48} * 48 * 16;
  draw_waves(std::size_t{192} * 192 * 3, network.input());
  network.run();
  const std::vector<float> first(network.output(0), network.output(0) + kNumbers);
  std::fill_n(network.input(), std::size_t{192} * 192 * 3, 0.0F);
  network.run();
  EXPECT_NE(first, std::vector<float>(network.output(0), network.output(0) + kNumbers));
  draw_waves(std::size_t{192} * 192 * 3, network.input());
  network.run();
  EXPECT_EQ(first, std::vector<float>(network.output(0), network.output(0) + kNumbers));
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
