// Trains the network of the body classifier and writes modules/segmenter/body_network.inc:
// limbcast-train-bodies OUT.inc FOLDER... reads each folder's camera frames that have masks (pairs
// through the reconstructor). Frames that show bodies D4 or D5 are left out: they are for checking.
// train.sh makes the simulated folders and runs it on all that it was trained on.

#include <algorithm>
#include <array>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "modules/segmenter/body_classifier.hpp"
#include "modules/segmenter/joint_growing.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/network_training.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// Sensors' silhouettes are wider than the true masks by up to this: not trained on [px].
constexpr int kUnsureBand_px = 4;
/// A lattice's point whose head would be this near to the true one is on that head [m].
constexpr float kSameHead_m = 0.14F;
/// Points taken of the bodies and of other things in a frame.
constexpr std::size_t kBodyPoints = 60, kOtherPoints = 120;
/// Eight neighbouring frames go to one block; of four blocks the last tells how good it became.
constexpr std::size_t kBlock = 8, kBlocks = 4;

bool for_checking(const LoadedFrame& frame) {
  return std::any_of(frame.persons.begin(), frame.persons.end(),
                     [](const TruePerson& person) { return person.for_checking(); });
}

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

/// Grown points on other things, and on bodies.
std::array<std::vector<std::uint32_t>, 2> sorted_points(const LoadedFrame& frame,
                                                        const Lattice& lattice,
                                                        const std::vector<std::int16_t>& labels) {
  const cv::Mat1b body = frame.mask > 0;
  cv::Mat1b wide;
  constexpr int kSize_px = 2 * kUnsureBand_px + 1;
  cv::dilate(body, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, {kSize_px, kSize_px}));
  std::array<std::vector<std::uint32_t>, 2> points;
  for (std::uint32_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNobody) continue;
    const int pixel = static_cast<int>(lattice.source[i]);
    if (body(pixel) != 0)
      points[1].push_back(i);
    else if (wide(pixel) == 0)
      points[0].push_back(i);
  }
  return points;
}

void add_examples(const LoadedFrame& frame, const Params& params, std::mt19937& random,
                  std::vector<Example>& examples) {
  const LevelFrame level =
      make_level_frame(frame.cloud.stamp.gravity, find_ground(frame.cloud, params.ground));
  int step = 1;
  const Lattice lattice = make_lattice(frame.cloud, level, step);
  const std::vector<HeadCandidate> heads = true_heads(frame, lattice);
  if (heads.empty()) return;
  const auto labels = grow_together(lattice, heads, params.joint, params.reach);
  auto sorted = sorted_points(frame, lattice, labels);
  for (const bool positive : {false, true}) {
    std::vector<std::uint32_t>& points = sorted[positive ? 1 : 0];
    const std::size_t count = std::min(positive ? kBodyPoints : kOtherPoints, points.size());
    for (std::size_t k = 0; k < count; ++k) {
      std::swap(points[k], points[k + random() % (points.size() - k)]);
      const HeadCandidate& head = heads[static_cast<std::size_t>(labels[points[k]])];
      const bool mirrored = random() % 2 == 0;
      const PointInput input = point_input(lattice, head, points[k], mirrored);
      examples.push_back({{input.begin(), input.end()}, positive});
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-train-bodies OUT.inc FOLDER...\n");
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
      add_examples(frame, params, random, check ? checked_on : trained_on);
    }
    std::printf("%s: %zu examples so far\n", argv[k], trained_on.size());
    std::fflush(stdout);
  }
  TrainingParams training;
  training.hidden = 32;
  training.epochs = 10;
  training.decay = 0.01F;
  const Network network = train(trained_on, training);
  print_decisions("trained on", network, trained_on);
  print_decisions("not trained on", network, checked_on);
  write_networks({{"kBodyNetwork", network}}, argv[1]);
  return 0;
}
