// Prints, body by body, on how many visible heads each kind of seed stands and how many seeds a
// frame stand elsewhere: a table of modules/segmenter/README.md. limbcast-seed-figures [SET...]

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "modules/segmenter/classifiers/head_classifier.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"
#include "modules/segmenter/seeds/skin_seeds.hpp"
#include "tests/segmenter/recorded_frames.hpp"
#include "tests/support/data_sets.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// A seed whose head's centre would be this near to a true one stands on that head.
constexpr float kSameHead_m = 0.20F;

struct Tally {
  int heads = 0, seeded = 0;
};

/// Seeds of one kind over the frames of a set.
struct Kind {
  const char* name;
  std::map<std::string, Tally> by_body;
  int on_people = 0, elsewhere = 0;
};

struct Frame {
  const LoadedFrame& loaded;
  const Lattice& lattice;
};

bool stands_on(const HeadCandidate& seed, const Frame& frame, const TruePerson& person) {
  const auto head = person.joints_m.find("head");
  return head != person.joints_m.end() &&
         (frame.lattice.frame.to_level(head->second) - seed.center_m).norm() < kSameHead_m;
}

bool on_a_person(const HeadCandidate& seed, const Frame& frame) {
  if (frame.loaded.mask.empty()) return false;
  const auto source = static_cast<int>(frame.lattice.source[frame.lattice.index(seed.u, seed.v)]);
  return frame.loaded.mask.at<std::uint8_t>(source / frame.loaded.mask.cols,
                                            source % frame.loaded.mask.cols) > 0;
}

void count(const Frame& frame, const std::vector<HeadCandidate>& seeds, Kind& kind) {
  for (const TruePerson& person : frame.loaded.persons) {
    if (!person.head_visible()) continue;
    Tally& tally = kind.by_body[person.body];
    ++tally.heads;
    tally.seeded += std::any_of(seeds.begin(), seeds.end(), [&](const HeadCandidate& seed) {
      return stands_on(seed, frame, person);
    });
  }
  for (const HeadCandidate& seed : seeds) {
    const auto& persons = frame.loaded.persons;
    const bool head = std::any_of(persons.begin(), persons.end(), [&](const TruePerson& person) {
      return stands_on(seed, frame, person);
    });
    if (!head) ++(on_a_person(seed, frame) ? kind.on_people : kind.elsewhere);
  }
}

void print(const std::string& set, const Kind& kind, int frames) {
  std::printf("%-22s %-18s", set.c_str(), kind.name);
  for (const auto& [body, tally] : kind.by_body)
    std::printf(" %s %2d/%2d", body.empty() ? "all" : body.c_str(), tally.seeded, tally.heads);
  std::printf("   elsewhere on people %.1f, off people %.1f a frame\n",
              static_cast<double>(kind.on_people) / std::max(1, frames),
              static_cast<double>(kind.elsewhere) / std::max(1, frames));
}

void run_set(const std::string& set, const std::string& folder) {
  static const SkinColor skin;
  static const HeadClassifier classifier;
  const Params params;
  const FrameReader reader(folder, DepthFrom::kReconstructor);
  Kind by_skin{"skin parts", {}, 0, 0}, by_template{"template", {}, 0, 0},
      by_classifier{"template, trained", {}, 0, 0};
  int frames = 0;
  for (const std::string& path : reader.paths()) {
    const LoadedFrame loaded = reader.read(path);
    if (!loaded.labelled) continue;
    ++frames;
    const Lattice lattice = look_at(loaded.cloud, params).lattice;
    const Frame frame{loaded, lattice};
    const std::vector<HeadCandidate> shapes = find_heads(lattice, params.head);
    std::vector<RejectedHead> rejected;
    count(frame, find_skin_parts(loaded.cloud, lattice, skin, params.skin), by_skin);
    count(frame, shapes, by_template);
    count(frame, likely_heads(lattice, shapes, classifier, params.classifier, rejected),
          by_classifier);
  }
  for (const Kind* kind : {&by_skin, &by_template, &by_classifier}) print(set, *kind, frames);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  return test::print_figures("limbcast-seed-figures",
                             "Prints which heads the seeds find, and what else.",
                             {"stereo_dev/general", "stereo_dev/pointing", "stereo_dev/multi",
                              "stereo_dev/nohuman", "rgbd_pointing", "laser_dev"},
                             argc, argv, [](const test::DataSets& sets) {
                               for (const std::string& set : sets.names)
                                 run_set(set, sets.folder(set));
                             });
}
