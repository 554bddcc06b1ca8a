// Trains the network of the surface classifier and writes
// modules/segmenter/classifiers/surface_network.inc: limbcast-train-surfaces OUT.inc FOLDER...
// reads each folder's camera frames that have masks (pairs through the reconstructor). Frames that
// show bodies D4 or D5 are left out: they are for checking. train.sh makes the simulated folders
// and runs it on all that it was trained on.

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "modules/segmenter/classifiers/surface_classifier.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "modules/segmenter/scene/surfaces.hpp"
#include "tests/segmenter/classifiers/point_training.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// Points taken of the bodies and of other things in a frame.
constexpr std::size_t kBodyPoints = 150, kOtherPoints = 250;
/// What only one camera of a pair sees beside the edge, as disparity at 1 m [lattice px]: of a
/// camera with a baseline of 12 cm.
constexpr float kStripPxM = 31.0F;

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
SortedPoints sorted_points(const LoadedFrame& frame, const Lattice& lattice,
                           const HiddenHeadParams& params) {
  const PointSorter sorter(frame);
  const Surfaces surfaces = find_surfaces(lattice, params.surface);
  SortedPoints all;
  for (std::uint32_t i = 0; i < lattice.size(); ++i) {
    if (surfaces.of_point[i] >= 0) sorter.add(lattice, i, all);
  }
  const auto is_too_small_or_large = [&](std::uint32_t point) {
    const Surface& surface = surfaces.all[static_cast<std::size_t>(surfaces.of_point[point])];
    return surface.area_m2 < params.min_area_m2 || surface.area_m2 > params.max_area_m2 ||
           surface.extent_m > params.max_extent_m;
  };
  all[0].erase(std::remove_if(all[0].begin(), all[0].end(), is_too_small_or_large), all[0].end());
  return all;
}

void add_examples(const LoadedFrame& frame, const Lattice& lattice, const Params& params,
                  std::mt19937& random, std::vector<Example>& examples) {
  SortedPoints sorted = sorted_points(frame, lattice, params.hidden_heads);
  const auto input_of = [&](std::uint32_t point, bool mirrored) -> std::vector<float> {
    const SurfaceInput input = surface_input(lattice, point, mirrored);
    return {input.begin(), input.end()};
  };
  add_drawn_points(sorted, kBodyPoints, kOtherPoints, input_of, random, examples);
}

/// The frame as it is, and cut through the middle of what it shows, left and right.
void add_views(const LoadedFrame& frame, const Params& params, std::mt19937& random,
               std::vector<Example>& examples) {
  const Lattice lattice = look_at(frame.cloud, params).lattice;
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
  return train_on_points(argc, argv, {"limbcast-train-surfaces", "kSurfaceNetwork", 12, add_views});
}
