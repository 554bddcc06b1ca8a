#include "tests/segmenter/classifiers/point_training.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace limbcast::segmenter {
namespace {

/// How much wider than the true mask a silhouette may be [px].
constexpr int kUnsureBand_px = 4;
/// Eight neighbouring frames go to one block; of four blocks the last tells how good it became.
constexpr std::size_t kBlock = 8, kBlocks = 4;

}  // namespace

PointSorter::PointSorter(const LoadedFrame& frame) : body_(frame.mask > 0) {
  constexpr int kSize_px = 2 * kUnsureBand_px + 1;
  cv::dilate(body_, body_and_band_,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {kSize_px, kSize_px}));
}

void PointSorter::add(const Lattice& lattice, std::uint32_t point, SortedPoints& sorted) const {
  const int pixel = static_cast<int>(lattice.source[point]);
  if (body_(pixel) != 0)
    sorted[1].push_back(point);
  else if (body_and_band_(pixel) == 0)
    sorted[0].push_back(point);
}

void add_drawn_points(SortedPoints& sorted, std::size_t max_body_points,
                      std::size_t max_other_points, const PointInputOf& input, std::mt19937& random,
                      std::vector<Example>& examples) {
  for (const bool positive : {false, true}) {
    std::vector<std::uint32_t>& points = sorted[positive ? 1 : 0];
    const std::size_t count =
        std::min(positive ? max_body_points : max_other_points, points.size());
    for (std::size_t k = 0; k < count; ++k) {
      std::swap(points[k], points[k + random() % (points.size() - k)]);
      const bool mirrored = random() % 2 == 0;
      examples.push_back({input(points[k], mirrored), positive});
    }
  }
}

int train_on_points(int argc, char** argv, const PointTraining& training) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s OUT.inc FOLDER...\n", training.program);
    return 2;
  }
  const Params params;
  std::mt19937 random(7);
  std::vector<Example> trained_on, checked_on;
  for (int k = 2; k < argc; ++k) {
    const FrameReader reader(argv[k], DepthFrom::kReconstructor);
    for (std::size_t i = 0; i < reader.paths().size(); ++i) {
      const LoadedFrame frame = reader.read(reader.paths()[i]);
      if (frame.mask.empty() || !frame.cloud.organized() || frame.for_checking()) continue;
      const bool check = i / kBlock % kBlocks == kBlocks - 1;
      training.add_examples(frame, params, random, check ? checked_on : trained_on);
    }
    std::printf("%s: %zu examples so far\n", argv[k], trained_on.size());
    std::fflush(stdout);
  }
  TrainingParams network_training;
  network_training.hidden = 32;
  network_training.epochs = training.epochs;
  network_training.decay = 0.01F;
  const Network network = train(trained_on, network_training);
  print_decisions("trained on", network, trained_on);
  print_decisions("not trained on", network, checked_on);
  write_networks({{training.network, network}}, argv[1]);
  return 0;
}

}  // namespace limbcast::segmenter
