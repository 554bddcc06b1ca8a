// Trains the two networks of the head classifier and writes
// modules/segmenter/classifiers/head_networks.inc: limbcast-train-heads OUT.inc FOLDER... reads
// each folder's labelled frames (pairs through the reconstructor). Frames that show bodies D4 or D5
// are left out: they are for checking. train.sh makes the simulated folders and runs it on all that
// it was trained on.

#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "modules/segmenter/classifiers/head_patch.hpp"
#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/growing/joint_growing.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "tests/segmenter/classifiers/network_training.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// A candidate whose centre is this near to a head's, across the ray, is that head; one farther off
/// than the second is none; what lies between is not trained on.
constexpr float kSameHead_m = 0.10F, kOtherPlace_m = 0.15F;
/// The same for whole people: a cluster from a seed beside the head may be a good one.
constexpr float kOtherPerson_m = 0.24F;
/// Patches taken of each head and of each other place, all but the first varied.
constexpr int kHeadPatches = 5, kOtherPatches = 2;
/// Share of the varied ones that are shown as without ground.
constexpr float kUnknownGround = 0.25F;

using Random = std::mt19937;

float uniform(Random& random) { return static_cast<float>(random()) / 4294967296.0F; }

float normal(Random& random) {
  float sum = 0.0F;
  for (int i = 0; i < 12; ++i) sum += uniform(random);
  return sum - 6.0F;
}

/// One frame, ready for the search; small enough to keep thousands.
struct TrainingScene {
  Lattice lattice;
  std::vector<Eigen::Vector3f> heads_m;  ///< level frame, hidden ones too
  std::vector<bool> visible;
  std::vector<HeadCandidate> candidates;
  std::size_t fold = 0;
};

/// Candidates of the template and the best place on each visible head, which the template may miss.
void find_candidates(const Params& params, TrainingScene& scene) {
  scene.candidates = find_heads(scene.lattice, params.head);
  for (std::size_t h = 0; h < scene.heads_m.size(); ++h) {
    if (!scene.visible[h]) continue;
    HeadCandidate best;
    float nearest_m = kSameHead_m;
    for (std::size_t i = 0; i < scene.lattice.size(); ++i) {
      if (scene.lattice.depth_m[i] <= 0.0F) continue;
      const Eigen::Vector3f center_m = head_center(scene.lattice, scene.lattice.level_m[i]);
      const float distance_m = (center_m - scene.heads_m[h]).norm();
      if (distance_m >= nearest_m) continue;
      nearest_m = distance_m;
      best.u = static_cast<int>(i) % scene.lattice.width;
      best.v = static_cast<int>(i) / scene.lattice.width;
      best.surface_m = scene.lattice.level_m[i];
      best.center_m = center_m;
    }
    if (nearest_m < kSameHead_m) scene.candidates.push_back(best);
  }
}

TrainingScene make_scene(const LoadedFrame& frame, const Params& params) {
  TrainingScene scene;
  scene.lattice = look_at(frame.cloud, params).lattice;
  for (const TruePerson& person : frame.persons) {
    const auto head = person.joints_m.find("head");
    if (head == person.joints_m.end()) continue;
    scene.heads_m.push_back(scene.lattice.frame.to_level(head->second));
    scene.visible.push_back(person.head_visible());
  }
  find_candidates(params, scene);
  return scene;
}

/// The scene as a depth camera tells it that fills holes and smooths: silhouettes grow by up to
/// `reach_px` and take the place of what lies behind them, as those of a RealSense do.
TrainingScene with_grown_silhouettes(TrainingScene scene, int reach_px, const Params& params) {
  constexpr float kNothing_m = 100.0F, kSmooth = 0.05F;
  Lattice& lattice = scene.lattice;
  cv::Mat1f depth = cv::Mat1f(lattice.height, lattice.width, lattice.depth_m.data()).clone();
  depth.setTo(kNothing_m, depth == 0.0F);
  const int size = 2 * reach_px + 1;
  cv::erode(depth, depth, cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size}));
  cv::Mat1f mean;
  cv::blur(depth, mean, {5, 5});
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const int k = static_cast<int>(i);
    float z_m = depth(k);
    // Holes far from all that was measured stay holes.
    if (z_m >= kNothing_m || lattice.depth_m[i] <= 0.0F) continue;
    if (std::abs(mean(k) - z_m) < kSmooth * z_m) z_m = mean(k);
    const Eigen::Vector3f ray = lattice.frame.to_sensor(lattice.level_m[i]) / lattice.depth_m[i];
    lattice.level_m[i] = lattice.frame.to_level(ray * z_m);
    lattice.depth_m[i] = z_m;
  }
  find_candidates(params, scene);
  return scene;
}

/// Distance of the nearest head; along the ray the noise of the sensor is taken off.
float distance_to_heads_m(const TrainingScene& scene, const Eigen::Vector3f& center_m) {
  float nearest_m = 1e9F;
  const Eigen::Vector3f sensor_m(0.0F, 0.0F, scene.lattice.frame.sensor_height_m);
  for (const Eigen::Vector3f& head : scene.heads_m) {
    const Eigen::Vector3f ray = (head - sensor_m).normalized();
    const Eigen::Vector3f offset = center_m - head;
    const float along_m = std::abs(offset.dot(ray));
    const float across_m = (offset - offset.dot(ray) * ray).norm();
    const float noise_m = 2.0F * scene.lattice.depth_noise.sigma_m((head - sensor_m).norm());
    nearest_m = std::min(nearest_m, std::hypot(across_m, std::max(0.0F, along_m - noise_m)));
  }
  return nearest_m;
}

/// Noise and holes of another sensor, from none to severe.
void corrupt(std::vector<float>& patch, Random& random) {
  constexpr float kMostNoise = 0.12F, kMostHoles = 0.25F;
  const float noise = kMostNoise * std::pow(uniform(random), 2.0F);
  const float holes = kMostHoles * std::pow(uniform(random), 3.0F);
  for (std::size_t i = 0; i + 1 < 2 * static_cast<std::size_t>(count_samples(kPatchGrids));
       i += 2) {
    if (patch[i + 1] <= 0.0F) continue;
    if (uniform(random) < holes)
      patch[i] = patch[i + 1] = 0.0F;
    else
      patch[i] = std::clamp(patch[i] + noise * normal(random), -1.0F, 1.0F);
  }
}

/// As where no ground is in sight.
void forget_ground(std::vector<float>& patch) {
  patch[kPatchHeight] = patch[kPatchHeight + 1] = 0.0F;
}

/// Patches of one candidate; all but the first shifted, scaled, mirrored and corrupted.
void add_patches(const Lattice& lattice, const HeadCandidate& candidate, bool positive,
                 Random& random, std::vector<Example>& examples) {
  const auto at = static_cast<std::uint32_t>(lattice.index(candidate.u, candidate.v));
  for (int i = 0; i < (positive ? kHeadPatches : kOtherPatches); ++i) {
    const float varied = i == 0 ? 0.0F : 1.0F;
    const float spread_px = varied * 0.025F * lattice.focal_px / lattice.depth_m[at];
    PatchPlace place = place_of_point(lattice, at, i % 2 == 1);
    place.u += spread_px * normal(random);
    place.v += spread_px * normal(random);
    const float farther_m = varied * 0.02F * normal(random);
    place.depth_m += farther_m;
    place.away_m += farther_m;
    place.height_m = candidate.surface_m.z() + varied * 0.05F * normal(random);
    place.scale = 1.0F + varied * 0.06F * normal(random);
    examples.push_back({sample_patch(lattice, place), positive});
    if (i > 0) corrupt(examples.back().input, random);
    if (i > 0 && uniform(random) < kUnknownGround) forget_ground(examples.back().input);
  }
}

void add_patch_examples(const TrainingScene& scene, Random& random,
                        std::vector<Example>& examples) {
  for (const HeadCandidate& candidate : scene.candidates) {
    const float d = distance_to_heads_m(scene, candidate.center_m);
    if (d < kSameHead_m || d > kOtherPlace_m)
      add_patches(scene.lattice, candidate, d < kSameHead_m, random, examples);
  }
}

void add_person_examples(const TrainingScene& scene, const HeadClassifier& classifier,
                         const Params& params, std::vector<Example>& examples) {
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
      if (d < kOtherPlace_m || d > kOtherPerson_m)
        examples.push_back({person_input(scene.lattice, heads[k], figures[k]), d < kOtherPlace_m});
      if (d <= kOtherPerson_m) kept.push_back(heads[k]);
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

std::vector<TrainingScene> load_scenes(const std::vector<std::string>& folders,
                                       const Params& params) {
  constexpr int kMostReach_px = 6;  // of the thinned lattice: 5 cm at 2.3 m
  Random random(11);
  std::vector<TrainingScene> scenes;
  for (const std::string& folder : folders) {
    const FrameReader reader(folder, DepthFrom::kReconstructor);
    for (std::size_t i = 0; i < reader.paths().size(); ++i) {
      // Of the recorded rooms without people every second one is for checking.
      if (folder.find("stereo_dev/nohuman") != std::string::npos && i % 2 == 1) continue;
      const LoadedFrame frame = reader.read(reader.paths()[i]);
      if (!frame.labelled || frame.for_checking()) continue;
      scenes.push_back(make_scene(frame, params));
      // Neighbouring frames of a recording look alike, so they go to one fold.
      scenes.back().fold = i / 8 % 2;
      if (!frame.cloud.organized() || reader.is_stereo()) continue;
      const int reach_px = 1 + static_cast<int>(random() % kMostReach_px);
      scenes.push_back(with_grown_silhouettes(scenes.back(), reach_px, params));
    }
    std::printf("%s: %zu scenes so far\n", folder.c_str(), scenes.size());
    std::fflush(stdout);
  }
  return scenes;
}

/// Gigabytes: moved, not copied.
std::vector<Example> joined(std::vector<Example>&& a, std::vector<Example>&& b) {
  std::vector<Example> all = std::move(a);
  all.insert(all.end(), std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()));
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
  const std::vector<TrainingScene> scenes = load_scenes(folders, params);
  for (const TrainingScene& scene : scenes)
    add_patch_examples(scene, random, folds[scene.fold].patches);
  // The second network must see the first one's odds as they are on frames that it was not trained
  // on.
  TrainingParams patch_params;
  patch_params.hidden = 80;
  patch_params.epochs = 20;
  const Network unused{};
  const Network first_patch = train(folds[0].patches, patch_params);
  const HeadClassifier first(first_patch, unused);
  const HeadClassifier second(train(folds[1].patches, patch_params), unused);
  report("patches, fold 1 on fold 2", first_patch, folds[1].patches);
  for (const TrainingScene& scene : scenes)
    add_person_examples(scene, scene.fold == 0 ? second : first, params, folds[scene.fold].persons);
  TrainingParams person_params;
  person_params.hidden = 8;
  person_params.epochs = 300;
  person_params.rate = 0.01F;
  person_params.decay = 1e-3F;
  report("persons, fold 1 on fold 2", train(folds[0].persons, person_params), folds[1].persons);
  const std::string out = argv[1];
  const Network patch =
      train(joined(std::move(folds[0].patches), std::move(folds[1].patches)), patch_params);
  const std::vector<Example> persons =
      joined(std::move(folds[0].persons), std::move(folds[1].persons));
  const Network person = train(persons, person_params);
  report("persons, all", person, persons);
  write_networks({{"kPatchNetwork", patch}, {"kPersonNetwork", person}}, out);
  return 0;
}
