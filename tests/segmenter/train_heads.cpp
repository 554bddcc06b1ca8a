// Trains the two networks of the head classifier and writes modules/segmenter/head_networks.inc:
// limbcast-train-heads OUT.inc FOLDER... reads each folder's frames (pairs through the
// reconstructor, and with their true depth). Frames that show bodies D4 or D5 are left out: they
// are for checking.

#include <array>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "modules/segmenter/cluster_figures.hpp"
#include "modules/segmenter/head_patch.hpp"
#include "modules/segmenter/joint_growing.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "modules/segmenter/skin_seeds.hpp"
#include "tests/segmenter/network_training.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

constexpr float kSameHead_m = 0.13F;    ///< a candidate this near to a head is one
constexpr float kOtherPlace_m = 0.24F;  ///< one this far from all heads is none

/// One frame, ready for the search; small enough to keep hundreds.
struct Scene {
  PinholeCamera camera;
  Lattice lattice;
  std::vector<Eigen::Vector3f> heads_m;  ///< level frame, hidden ones too
  std::vector<bool> visible;
  std::vector<HeadCandidate> candidates;
};

using Random = std::mt19937;

float normal(Random& random) {
  float sum = 0.0F;
  for (int i = 0; i < 12; ++i) sum += static_cast<float>(random()) / 4294967296.0F;
  return sum - 6.0F;
}

Scene make_scene(const LoadedFrame& frame, const Params& params) {
  Scene scene;
  scene.camera = *frame.cloud.camera;
  int step = 1;
  scene.lattice = make_lattice(
      frame.cloud,
      make_level_frame(frame.cloud.stamp.gravity, find_ground(frame.cloud, params.ground)), step);
  for (const TruePerson& person : frame.persons) {
    const auto head = person.joints_m.find("head");
    if (head == person.joints_m.end()) continue;
    scene.heads_m.push_back(scene.lattice.frame.to_level(head->second));
    scene.visible.push_back(person.head_visible());
  }
  HeadShapeParams loose = params.head;
  loose.min_score -= 0.1F;
  scene.candidates = find_heads(scene.lattice, loose);
  static const SkinColor skin;
  for (const HeadCandidate& part : find_skin_parts(frame.cloud, scene.lattice, skin, params.skin)) {
    scene.candidates.push_back(part);
  }
  return scene;
}

float distance_to_heads_m(const Scene& scene, const Eigen::Vector3f& center_m) {
  float nearest_m = 1e9F;
  for (const Eigen::Vector3f& head : scene.heads_m)
    nearest_m = std::min(nearest_m, (head - center_m).norm());
  return nearest_m;
}

/// Patches of one candidate, shifted, scaled and mirrored.
void add_patches(const Scene& scene, const HeadCandidate& candidate, bool positive, int count,
                 Random& random, std::vector<Example>& examples) {
  const Lattice& lattice = scene.lattice;
  for (int i = 0; i < count; ++i) {
    PatchPlace place;
    const float depth_m = lattice.depth_m[lattice.index(candidate.u, candidate.v)];
    const float spread_px = (i == 0 ? 0.0F : 0.025F) * lattice.focal_px / depth_m;
    place.u = static_cast<float>(candidate.u) + spread_px * normal(random);
    place.v = static_cast<float>(candidate.v) + spread_px * normal(random);
    place.depth_m = depth_m + (i == 0 ? 0.0F : 0.02F) * normal(random);
    place.height_m = candidate.surface_m.z() + 0.05F * normal(random);
    place.scale = 1.0F + (i == 0 ? 0.0F : 0.06F) * normal(random);
    place.mirrored = i % 2 == 1;
    examples.push_back({sample_patch(lattice, place), positive, 1.0F});
  }
}

/// The candidate that the template would give if it looked at this head.
bool seed_at_head(const Lattice& lattice, const PinholeCamera& camera,
                  const Eigen::Vector3f& head_m, HeadCandidate& seed) {
  const Eigen::Vector2f px = camera.project(lattice.frame.to_sensor(head_m)) * lattice.focal_px /
                             static_cast<float>(camera.fx);
  const int u = static_cast<int>(px.x()), v = static_cast<int>(px.y());
  if (u < 0 || v < 0 || u >= lattice.width || v >= lattice.height) return false;
  const std::size_t i = lattice.index(u, v);
  if (lattice.depth_m[i] <= 0.0F) return false;
  seed = {u, v, lattice.level_m[i], head_center(lattice, lattice.level_m[i])};
  return (seed.center_m - head_m).norm() < kSameHead_m;
}

void add_patch_examples(const Scene& scene, Random& random, std::vector<Example>& examples) {
  for (std::size_t h = 0; h < scene.heads_m.size(); ++h) {
    HeadCandidate seed;
    if (scene.visible[h] && seed_at_head(scene.lattice, scene.camera, scene.heads_m[h], seed)) {
      add_patches(scene, seed, true, 6, random, examples);
    }
  }
  for (const HeadCandidate& candidate : scene.candidates) {
    const float d = distance_to_heads_m(scene, candidate.center_m);
    if (d < kSameHead_m)
      add_patches(scene, candidate, true, 4, random, examples);
    else if (d > kOtherPlace_m)
      add_patches(scene, candidate, false, 3, random, examples);
  }
}

void add_person_examples(const Scene& scene, const HeadClassifier& classifier, const Params& params,
                         std::vector<Example>& examples) {
  std::vector<RejectedHead> rejected;
  std::vector<HeadCandidate> heads =
      likely_heads(scene.lattice, scene.candidates, classifier, params.classifier, rejected);
  // As the search does: all together, then again without those that are none.
  for (int round = 0; round < 2; ++round) {
    const auto labels = grow_together(scene.lattice, heads, params.joint, params.reach);
    const auto figures = measure_clusters(scene.lattice, heads, labels, params.joint, params.reach);
    std::vector<HeadCandidate> kept;
    for (std::size_t k = 0; k < heads.size(); ++k) {
      const float d = distance_to_heads_m(scene, heads[k].center_m);
      if (d < kSameHead_m)
        examples.push_back({person_input(scene.lattice, heads[k], figures[k]), true, 1.0F});
      else if (d > kOtherPlace_m)
        examples.push_back({person_input(scene.lattice, heads[k], figures[k]), false, 1.0F});
      if (d <= kOtherPlace_m) kept.push_back(heads[k]);
    }
    heads = kept;
  }
}

struct Fold {
  std::vector<Example> patches, persons;
};

void report(const char* what, const Network& network, const std::vector<Example>& examples) {
  std::array<std::array<int, 2>, 2> table{};
  for (const Example& e : examples)
    ++table[e.positive ? 1 : 0][network.log_odds(e.input) > 0.0F ? 1 : 0];
  std::printf("%s: right positives %d of %d, false positives %d of %d\n", what, table[1][1],
              table[1][0] + table[1][1], table[0][1], table[0][0] + table[0][1]);
  std::fflush(stdout);
}

bool for_checking(const LoadedFrame& frame) {
  for (const TruePerson& person : frame.persons) {
    if (person.for_checking()) return true;
  }
  return false;
}

std::vector<Scene> load_scenes(const std::vector<std::string>& folders, const Params& params) {
  std::vector<Scene> scenes;
  for (const std::string& folder : folders) {
    for (const DepthFrom depth_from : {DepthFrom::kReconstructor, DepthFrom::kTruth}) {
      const FrameReader reader(folder, depth_from);
      if (depth_from == DepthFrom::kTruth && !reader.is_stereo()) continue;
      for (std::size_t i = 0; i < reader.paths().size(); ++i) {
        // Of recorded rooms without people every second one is for checking.
        if (reader.is_stereo() && folder.find("nohuman") != std::string::npos && i % 2 == 1)
          continue;
        const LoadedFrame frame = reader.read(reader.paths()[i]);
        if (frame.labelled && !for_checking(frame)) scenes.push_back(make_scene(frame, params));
      }
    }
  }
  return scenes;
}

std::vector<Example> joined(const std::vector<Example>& a, const std::vector<Example>& b) {
  std::vector<Example> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-train-heads OUT.inc FOLDER...\n");
    return 2;
  }
  const std::vector<std::string> folders(argv + 2, argv + argc);
  const Params params;
  Random random(7);
  std::array<Fold, 2> folds;
  const std::vector<Scene> scenes = load_scenes(folders, params);
  // Neighbouring frames of a recording look alike, so they go to one fold.
  const auto fold_of = [](std::size_t i) { return i / 8 % 2; };
  for (std::size_t i = 0; i < scenes.size(); ++i)
    add_patch_examples(scenes[i], random, folds[fold_of(i)].patches);
  // The second network must see the first one's odds as they are on frames that it was not trained
  // on.
  TrainingParams patch_params;
  const Network unused{};
  const Network first_patch = train(folds[0].patches, patch_params);
  const HeadClassifier first(first_patch, unused);
  const HeadClassifier second(train(folds[1].patches, patch_params), unused);
  report("patches, fold 1 on fold 2", first_patch, folds[1].patches);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    add_person_examples(scenes[i], fold_of(i) == 0 ? second : first, params,
                        folds[fold_of(i)].persons);
  }
  TrainingParams person_params;
  person_params.hidden = 8;
  person_params.epochs = 300;
  person_params.rate = 0.01F;
  person_params.decay = 1e-3F;
  report("persons, fold 1 on fold 2", train(folds[0].persons, person_params), folds[1].persons);
  const std::string out = argv[1];
  const Network patch = train(joined(folds[0].patches, folds[1].patches), patch_params);
  const Network person = train(joined(folds[0].persons, folds[1].persons), person_params);
  report("persons, all", person, joined(folds[0].persons, folds[1].persons));
  write_networks({{"kPatchNetwork", patch}, {"kPersonNetwork", person}}, out);
  return 0;
}
