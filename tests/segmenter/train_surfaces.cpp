// Trains the network of the surface classifier and writes modules/segmenter/surface_network.inc:
// limbcast-train-surfaces OUT.inc FOLDER... reads each folder's camera frames that have masks
// (pairs through the reconstructor). Frames that show bodies D4 or D5 are left out: they are for
// checking. train.sh makes the simulated folders and runs it on all that it was trained on.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "modules/segmenter/joint_growing.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "modules/segmenter/surface_classifier.hpp"
#include "modules/segmenter/surfaces.hpp"
#include "tests/segmenter/network_training.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// Sensors' silhouettes are wider than the true masks by up to this: not trained on [px].
constexpr int kUnsureBand_px = 4;
/// Points taken of the bodies and of other things in a frame.
constexpr std::size_t kBodyPoints = 150, kOtherPoints = 250;
/// Eight neighbouring frames go to one block; of four blocks the last tells how good it became.
constexpr std::size_t kBlock = 8, kBlocks = 4;
/// What only one camera of a pair sees beside the edge, as disparity at 1 m [lattice px]: of a
/// camera with a baseline of 12 cm.
constexpr float kStripPxM = 31.0F;

bool for_checking(const LoadedFrame& frame) {
  return std::any_of(frame.persons.begin(), frame.persons.end(),
                     [](const TruePerson& person) { return person.for_checking(); });
}

/// The lattice without the columns left of `from` and right of `to`, and without the strip beside
/// its left edge that a pair does not measure.
Lattice cut_to_columns(const Lattice& whole, int from, int to) {
  Lattice part = whole;
  part.width = to - from;
  part.depth_m.clear();
  part.level_m.clear();
  part.source.clear();
  for (int v = 0; v < whole.height; ++v) {
    for (int u = from; u < to; ++u) {
      const std::size_t i = whole.index(u, v);
      const float z_m = whole.depth_m[i];
      const bool hole = z_m <= 0.0F || static_cast<float>(u - from) < kStripPxM / z_m;
      part.depth_m.push_back(hole ? 0.0F : z_m);
      part.level_m.push_back(hole ? Eigen::Vector3f::Zero() : whole.level_m[i]);
      part.source.push_back(whole.source[i]);
    }
  }
  return part;
}

/// Points on other things and on bodies, of surfaces that are as large as what may be a body.
std::array<std::vector<std::uint32_t>, 2> sorted_points(const LoadedFrame& frame,
                                                        const Lattice& lattice,
                                                        const HiddenHeadParams& params) {
  const cv::Mat1b body = frame.mask > 0;
  cv::Mat1b wide;
  constexpr int kSize_px = 2 * kUnsureBand_px + 1;
  cv::dilate(body, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, {kSize_px, kSize_px}));
  const Surfaces surfaces = find_surfaces(lattice, params.surface);
  std::array<std::vector<std::uint32_t>, 2> points;
  for (std::uint32_t i = 0; i < lattice.size(); ++i) {
    const std::int32_t k = surfaces.of_point[i];
    if (k < 0) continue;
    const int pixel = static_cast<int>(lattice.source[i]);
    const Surface& surface = surfaces.all[static_cast<std::size_t>(k)];
    const bool candidate = surface.area_m2 >= params.min_area_m2 &&
                           surface.area_m2 <= params.max_area_m2 &&
                           surface.extent_m <= params.max_extent_m;
    if (body(pixel) != 0)
      points[1].push_back(i);
    else if (wide(pixel) == 0 && candidate)
      points[0].push_back(i);
  }
  return points;
}

void add_examples(const LoadedFrame& frame, const Lattice& lattice, const Params& params,
                  std::mt19937& random, std::vector<Example>& examples) {
  auto sorted = sorted_points(frame, lattice, params.hidden_heads);
  for (const bool positive : {false, true}) {
    std::vector<std::uint32_t>& points = sorted[positive ? 1 : 0];
    const std::size_t count = std::min(positive ? kBodyPoints : kOtherPoints, points.size());
    for (std::size_t k = 0; k < count; ++k) {
      std::swap(points[k], points[k + random() % (points.size() - k)]);
      const SurfaceInput input = surface_input(lattice, points[k], random() % 2 == 0);
      examples.push_back({{input.begin(), input.end()}, positive});
    }
  }
}

/// The frame as it is, and cut through the middle of what it shows, left and right.
void add_views(const LoadedFrame& frame, const Params& params, std::mt19937& random,
               std::vector<Example>& examples) {
  const LevelFrame level =
      make_level_frame(frame.cloud.stamp.gravity, find_ground(frame.cloud, params.ground));
  int step = 1;
  const Lattice lattice = make_lattice(frame.cloud, level, step);
  add_examples(frame, lattice, params, random, examples);
  const int quarter = lattice.width / 4;
  const int middle = quarter + static_cast<int>(random() % static_cast<unsigned>(2 * quarter));
  if (random() % 2 == 0)
    add_examples(frame, cut_to_columns(lattice, middle, lattice.width), params, random, examples);
  else
    add_examples(frame, cut_to_columns(lattice, 0, middle), params, random, examples);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-train-surfaces OUT.inc FOLDER...\n");
    return 2;
  }
  const Params params;
  std::mt19937 random(7);
  std::vector<Example> trained_on, checked_on;
  for (int k = 2; k < argc; ++k) {
    const FrameReader reader(argv[k], DepthFrom::kReconstructor);
    for (std::size_t i = 0; i < reader.paths().size(); ++i) {
      const LoadedFrame frame = reader.read(reader.paths()[i]);
      if (frame.mask.empty() || !frame.cloud.organized() || for_checking(frame)) continue;
      const bool check = i / kBlock % kBlocks == kBlocks - 1;
      add_views(frame, params, random, check ? checked_on : trained_on);
    }
    std::printf("%s: %zu examples so far\n", argv[k], trained_on.size());
    std::fflush(stdout);
  }
  TrainingParams training;
  training.hidden = 32;
  training.epochs = 12;
  training.decay = 0.01F;
  const Network network = train(trained_on, training);
  print_decisions("trained on", network, trained_on);
  print_decisions("not trained on", network, checked_on);
  write_networks({{"kSurfaceNetwork", network}}, argv[1]);
  return 0;
}
