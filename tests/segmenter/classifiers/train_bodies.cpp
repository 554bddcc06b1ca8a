// Trains the network of the body classifier and writes
// modules/segmenter/classifiers/body_network.inc: limbcast-train-bodies OUT.inc FOLDER... reads
// each folder's camera frames that have masks (pairs through the reconstructor). Frames that show
// bodies D4 or D5 are left out: they are for checking. train.sh makes the simulated folders and
// runs it on all that it was trained on.

#include <cstdint>
#include <random>
#include <vector>

#include "modules/segmenter/classifiers/body_classifier.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "tests/segmenter/classifiers/point_training.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// A lattice's point whose head would be this near to the true one is on that head [m].
constexpr float kSameHead_m = 0.14F;
/// Points taken of the bodies and of other things in a frame.
constexpr std::size_t kBodyPoints = 60, kOtherPoints = 120;

/// The heads that the lattice shows.
std::vector<HeadCandidate> true_heads(const LoadedFrame& frame, const Lattice& lattice) {
  std::vector<HeadCandidate> heads;
  for (const TruePerson& person : frame.persons) {
    const auto joint = person.joints_m.find("head");
    if (joint == person.joints_m.end()) continue;
    const Eigen::Vector3f head_m = lattice.frame.to_level(joint->second);
    HeadCandidate best;
    float nearest_m = kSameHead_m;
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      if (lattice.depth_m[i] <= 0.0F) continue;
      const Eigen::Vector3f center_m = head_center(lattice, lattice.level_m[i]);
      const float distance_m = (center_m - head_m).norm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      best.u = static_cast<int>(i) % lattice.width;
      best.v = static_cast<int>(i) / lattice.width;
      best.surface_m = lattice.level_m[i];
      best.center_m = center_m;
    }
    if (nearest_m < kSameHead_m) heads.push_back(best);
  }
  return heads;
}

void add_examples(const LoadedFrame& frame, const Params& params, std::mt19937& random,
                  std::vector<Example>& examples) {
  const Lattice lattice = look_at(frame.cloud, params).lattice;
  const std::vector<HeadCandidate> heads = true_heads(frame, lattice);
  if (heads.empty()) return;
  const auto labels = grow_together(lattice, heads, params.joint, params.reach);
  const PointSorter sorter(frame);
  SortedPoints sorted;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != kNobody) sorter.add(lattice, i, sorted);
  }
  const auto input_of = [&](std::uint32_t point, bool mirrored) -> std::vector<float> {
    const HeadCandidate& head = heads[static_cast<std::size_t>(labels[point])];
    const PointInput input = point_input(lattice, head, point, mirrored);
    return {input.begin(), input.end()};
  };
  add_drawn_points(sorted, kBodyPoints, kOtherPoints, input_of, random, examples);
}

}  // namespace

int main(int argc, char** argv) {
  return train_on_points(argc, argv, {"limbcast-train-bodies", "kBodyNetwork", 10, add_examples});
}
