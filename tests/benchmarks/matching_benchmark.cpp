// Matching of a VGA pair of the demo log on one core, whole and in its steps, beside OpenCV's
// matchers.

#include <benchmark/benchmark.h>

#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/reconstructor/colors.hpp"
#include "modules/reconstructor/matcher.hpp"
#include "modules/reconstructor/near_look.hpp"
#include "modules/reconstructor/rectifier.hpp"
#include "tests/reconstructor/opencv_matcher.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::reconstructor {
namespace {

constexpr int kNumDisparities = 64;
/// As far as the default near limit.
constexpr int kMostDisparities = 157;

template <typename Message>
Message first_message(const std::string& channel) {
  lcm_io::LogReader log(test::repository_file("logs/demo.log"));
  while (const auto event = log.next()) {
    Message message;
    const int size = static_cast<int>(event->data.size());
    if (event->channel == channel && message.decode(event->data.data(), 0, size) == size)
      return message;
  }
  throw std::runtime_error("logs/demo.log holds nothing on " + channel);
}

const RectifiedPair& demo_pair() {
  static const RectifiedPair pair = [] {
    cv::setNumThreads(1);
    const Rectifier rectifier(
        lcm_io::from_message(first_message<stereo_calibration_t>("STEREO_CALIBRATION")));
    const StereoImages images =
        lcm_io::from_message(first_message<stereo_images_t>("STEREO_IMAGES"));
    return rectifier.rectify(images.left, images.right);
  }();
  return pair;
}

MatcherParams demo_params() {
  MatcherParams params;
  params.semi_global.num_disparities = kNumDisparities;
  return params;
}

void limbcast_match(benchmark::State& state) {
  const RectifiedPair& pair = demo_pair();
  for (auto _ : state) benchmark::DoNotOptimize(match(pair.left, pair.right, demo_params()));
}
BENCHMARK(limbcast_match)->Unit(benchmark::kMillisecond);

void limbcast_near_look(benchmark::State& state) {
  const RectifiedPair& pair = demo_pair();
  for (auto _ : state)
    benchmark::DoNotOptimize(find_num_disparities(pair, kNumDisparities, kMostDisparities));
}
BENCHMARK(limbcast_near_look)->Unit(benchmark::kMillisecond);

void limbcast_semi_global(benchmark::State& state) {
  const cv::Mat1b left = grey_of(demo_pair().left), right = grey_of(demo_pair().right);
  for (auto _ : state)
    benchmark::DoNotOptimize(match_semi_global(left, right, demo_params().semi_global));
}
BENCHMARK(limbcast_semi_global)->Unit(benchmark::kMillisecond);

void limbcast_subpixel(benchmark::State& state) {
  const cv::Mat1b left = grey_of(demo_pair().left), right = grey_of(demo_pair().right);
  const cv::Mat1f coarse_px = match_semi_global(left, right, demo_params().semi_global);
  for (auto _ : state) {
    cv::Mat1f disparity_px = coarse_px;
    refine_disparities(left, right, demo_params().subpixel, disparity_px);
    benchmark::DoNotOptimize(disparity_px);
  }
}
BENCHMARK(limbcast_subpixel)->Unit(benchmark::kMillisecond);

void run_opencv(benchmark::State& state, cv::StereoMatcher& matcher) {
  const RectifiedPair& pair = demo_pair();
  for (auto _ : state) benchmark::DoNotOptimize(test::run_opencv(matcher, pair));
}

void opencv_bm_9(benchmark::State& state) {
  run_opencv(state, *cv::StereoBM::create(kNumDisparities, 9));
}
BENCHMARK(opencv_bm_9)->Unit(benchmark::kMillisecond);

void opencv_sgbm_3_ways(benchmark::State& state) {
  run_opencv(state, *test::opencv_sgbm(kNumDisparities, cv::StereoSGBM::MODE_SGBM_3WAY));
}
BENCHMARK(opencv_sgbm_3_ways)->Unit(benchmark::kMillisecond);

void opencv_sgbm_5_ways(benchmark::State& state) {
  run_opencv(state, *test::opencv_sgbm(kNumDisparities, cv::StereoSGBM::MODE_SGBM));
}
BENCHMARK(opencv_sgbm_5_ways)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limbcast::reconstructor

BENCHMARK_MAIN();
