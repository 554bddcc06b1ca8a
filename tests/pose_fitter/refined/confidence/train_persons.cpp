// Trains the boosted trees of a person's confidence and writes
// modules/pose_fitter/refined/confidence/person_trees.inc:
// limbcast-train-persons OUT.inc FOLDER... runs the chain on each folder's frames, with a segmenter
// that takes more things for people than it does by default, and asks the truth which bodies were
// people's. Prints how often what was told came true, and what each limit lets through, of frames
// that were not trained on; what is written is trained on all. Frames that show bodies D4 or D5 are
// left out: they are for checking. train.sh makes the simulated folders and runs it on all that the
// trees were trained on.

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "modules/pose_fitter/refined/confidence/confidence.hpp"
#include "tests/pose_fitter/refined/confidence/fitted_frames.hpp"
#include "tests/pose_fitter/refined/confidence/reliability.hpp"
#include "tests/pose_fitter/refined/confidence/tree_boosting.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::pose_fitter;
using refined::PersonFeatures;
using refined::Tree;

/// The segmenter's limits of the log odds of heads and of bodies without one are lower by this:
/// more things to tell people from.
constexpr float kLowerHeadOdds = 1.0F;

struct Case {
  PersonFeatures features;
  bool person = false;
};

segmenter::Params eager_params() {
  segmenter::Params params;
  params.classifier.min_head_odds -= kLowerHeadOdds;
  params.hidden_heads.min_seen_odds -= kLowerHeadOdds;
  return params;
}

std::vector<Tree> train(const std::vector<Case>& cases) {
  Cases columns;
  columns.features.resize(static_cast<Eigen::Index>(cases.size()),
                          PersonFeatures::RowsAtCompileTime);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    columns.features.row(static_cast<Eigen::Index>(i)) = cases[i].features.transpose();
    columns.positive.push_back(cases[i].person);
  }
  return boost_trees(columns, BoostingParams{});
}

std::vector<Told> told_of(const std::vector<Tree>& trees, const std::vector<Case>& cases) {
  std::vector<Told> told;
  for (const Case& asked : cases) {
    double log_odds = 0.0;
    for (const Tree& tree : trees) log_odds += tree.value_of(asked.features);
    told.push_back({1.0 / (1.0 + std::exp(-log_odds)), asked.person});
  }
  return told;
}

/// How many people, and how many things, each limit lets through.
void print_limits(const std::vector<Told>& cases) {
  std::printf("limit  people told   things told\n");
  for (const double limit : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
    int people = 0, people_told = 0, things = 0, things_told = 0;
    for (const Told& told : cases) {
      ++(told.came_true ? people : things);
      if (told.probability >= limit) ++(told.came_true ? people_told : things_told);
    }
    std::printf("%5.2f  %4d of %4d  %4d of %4d\n", limit, people_told, people, things_told, things);
  }
}

template <class Values>
void write_list(const Values& values, const char* suffix, std::ostream& file) {
  file << "{{";
  for (const auto value : values) file << value << suffix << ",";
  file << "}},";
}

void write_trees(const std::vector<Tree>& trees, std::ostream& file) {
  file.setf(std::ios::scientific);
  file.precision(std::numeric_limits<float>::max_digits10 - 1);
  file << "// Written by limbcast-train-persons, which train.sh runs; not to be edited.\n"
          "// clang-format off\n"
          "constexpr Tree kPersonTrees[] = {\n";
  for (const Tree& tree : trees) {
    file << "{";
    write_list(tree.feature, "", file);
    write_list(tree.threshold, "F", file);
    write_list(tree.value, "F", file);
    file << "},\n";
  }
  file << "};\n// clang-format on\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-train-persons OUT.inc FOLDER...\n");
    return 2;
  }
  std::vector<Case> all, trained_on, checked_on;
  for (int k = 2; k < argc; ++k) {
    // Of the recorded rooms without people every second one is for checking.
    const bool halved = std::string(argv[k]).find("stereo_dev/nohuman") != std::string::npos;
    fit_frames(argv[k], eager_params(), [&](const FittedFrame& frame, std::size_t number) {
      if (halved && number % 2 == 1) return;
      for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        const bool person = frame.matching.kinds[i] == evaluate::ReportKind::kMatched;
        all.push_back({refined::person_features(frame.bodies[i]), person});
        (is_checked_on(number) ? checked_on : trained_on).push_back(all.back());
      }
    });
    std::printf("%s: %zu people and things so far\n", argv[k], all.size());
    std::fflush(stdout);
  }
  const std::vector<Told> told = told_of(train(trained_on), checked_on);
  print_reliability("not trained on", told);
  print_limits(told);

  std::ofstream file(argv[1]);
  write_trees(train(all), file);
  if (!file) {
    std::fprintf(stderr, "limbcast-train-persons: %s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
