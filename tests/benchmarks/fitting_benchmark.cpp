// Fitting of one person candidate of the demo log, by both methods. CPU is that of all threads.

#include <benchmark/benchmark.h>

#include <stdexcept>
#include <vector>

#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/pose_fitter/paper/paper_fitter.hpp"
#include "modules/pose_fitter/refined/refined_fitter.hpp"
#include "modules/reconstructor/stage.hpp"
#include "modules/segmenter/stage.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast {
namespace {

/// Every so many frames: people who point, stand, sit, walk, alone and in groups.
constexpr int kFrameStep = 6;

struct Candidate {
  Segment segment;
  Stamp stamp;
};

std::vector<Candidate> make_candidates() {
  reconstructor::Stage reconstructor{reconstructor::StageOptions{}};
  const segmenter::Stage segmenter{segmenter::StageOptions{}};
  std::vector<Candidate> candidates;
  lcm_io::LogReader log(test::repository_file("logs/demo.log"));
  int frame = 0;
  while (const auto event = log.next()) {
    const int size = static_cast<int>(event->data.size());
    stereo_calibration_t calibration;
    stereo_images_t images;
    if (event->channel == "STEREO_CALIBRATION" &&
        calibration.decode(event->data.data(), 0, size) == size) {
      reconstructor.on_calibration(calibration);
    } else if (event->channel == "STEREO_IMAGES" &&
               images.decode(event->data.data(), 0, size) == size && frame++ % kFrameStep == 0) {
      const auto camera = reconstructor.find(lcm_io::from_message(images).stamp.sensor);
      const point_cloud_t cloud = reconstructor::Stage::process(*camera, images);
      const Segments segments = lcm_io::from_message(segmenter.process(cloud));
      for (const Segment& segment : segments.segments) {
        if (segment.valid()) candidates.push_back({segment, segments.stamp});
      }
    }
  }
  if (candidates.empty()) throw std::runtime_error("logs/demo.log holds no person candidate");
  return candidates;
}

const std::vector<Candidate>& candidates() {
  static const std::vector<Candidate> all = make_candidates();
  return all;
}

/// One iteration fits one candidate; all in turn.
template <class Fitter>
void fit_person(benchmark::State& state) {
  const Fitter fitter;
  const std::vector<Candidate>& all = candidates();
  std::size_t next = 0;
  for ([[maybe_unused]] const auto iteration : state) {
    const Candidate& candidate = all[next++ % all.size()];
    benchmark::DoNotOptimize(fitter.fit(candidate.segment, candidate.stamp));
  }
  state.counters["candidates"] = static_cast<double>(all.size());
}

BENCHMARK_TEMPLATE(fit_person, pose_fitter::PaperFitter)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_TEMPLATE(fit_person, pose_fitter::RefinedFitter)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace limbcast

BENCHMARK_MAIN();
