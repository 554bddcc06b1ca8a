// Prints how well matchers do on people, against the truth of the rendered recordings:
//   matching-accuracy [STEP]     every STEP-th frame (1: all)
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "common/config/options.hpp"
#include "modules/reconstructor/reconstructor.hpp"
#include "tests/reconstructor/matching_figures.hpp"
#include "tests/reconstructor/opencv_matcher.hpp"
#include "tests/reconstructor/stereo_truth.hpp"

namespace {

using namespace limbcast;
using reconstructor::RectifiedPair;
using reconstructor::StereoReconstructor;

struct Matcher {
  std::string name;
  std::function<cv::Mat1f(const StereoReconstructor&, const RectifiedPair&)> run;
};

std::vector<Matcher> matchers() {
  const auto rounded = [](const StereoReconstructor& r) {
    return (r.num_disparities() + 15) / 16 * 16;
  };
  return {{"OpenCV BM 9",
           [=](const StereoReconstructor& r, const RectifiedPair& pair) {
             return test::run_opencv(*cv::StereoBM::create(rounded(r), 9), pair);
           }},
          {"OpenCV SGBM 3-way",
           [=](const StereoReconstructor& r, const RectifiedPair& pair) {
             const auto sgbm = test::opencv_sgbm(rounded(r), cv::StereoSGBM::MODE_SGBM_3WAY);
             return test::run_opencv(*sgbm, pair);
           }},
          {"limbcast", [](const StereoReconstructor& r, const RectifiedPair& pair) {
             return cv::Mat1f(r.match(pair).disparity_px);
           }}};
}

void print_row(const std::string& name, const test::MatchingFigures& f, double ms) {
  if (f.empty()) return;
  std::printf("%-20s %6.1f %6.2f %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %7.1f\n", name.c_str(),
              100.0 * f.valid_share(), 100.0 * f.bad_share(), f.median_error_px(), f.mad_px(),
              f.window_error_px(), f.locking_px(), f.precision(), f.recall(), f.thin_recall(), ms);
}

struct Tally {
  test::MatchingFigures tuning, checking;
  double cpu_seconds = 0.0;
  int frames = 0;
};

struct Options {
  std::string data = LIMBCAST_DATA_DIR;
  int step = 1;
};

void evaluate(const std::string& set, const Options& options, const std::vector<Matcher>& all,
              std::vector<Tally>& tallies) {
  const std::string folder = options.data + "/stereo_dev/" + set;
  const StereoReconstructor reconstructor(test::read_calibration(folder), {});
  const double focal_baseline =
      reconstructor.rectifier().camera().fx * reconstructor.rectifier().baseline_m();
  const auto names = test::frame_names(folder);
  for (std::size_t i = 0; i < names.size(); i += options.step) {
    const auto frame = test::read_true_frame(folder, names[i], focal_baseline);
    const RectifiedPair pair = reconstructor.rectifier().rectify(frame.left, frame.right);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const std::clock_t start = std::clock();  // of all threads, on a busy machine too
      const cv::Mat1f disparity = all[m].run(reconstructor, pair);
      tallies[m].cpu_seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      ++tallies[m].frames;
      (frame.is_tuning ? tallies[m].tuning : tallies[m].checking).add(disparity, frame);
    }
  }
}

void print_table(const Options& options) {
  cv::setNumThreads(1);  // so that the times are those of one core
  const std::vector<Matcher> all = matchers();
  std::printf("%-20s %6s %6s %7s %7s %7s %7s %7s %7s %7s %7s\n", "", "valid%", "bad2%", "median",
              "MAD", "window", "locking", "precis.", "recall", "thin", "CPU ms");
  for (const std::vector<std::string>& sets :
       {std::vector<std::string>{"pointing", "general"}, {"multi"}, {"distorted"}, {"hd"}}) {
    std::vector<Tally> tallies(all.size());
    for (const std::string& set : sets) evaluate(set, options, all, tallies);
    std::printf("%s%s\n", sets[0].c_str(), sets.size() > 1 ? ", general" : "");
    for (std::size_t m = 0; m < all.size(); ++m) {
      const double ms = 1e3 * tallies[m].cpu_seconds / tallies[m].frames;
      print_row(all[m].name + ", tuning", tallies[m].tuning, ms);
      print_row(all[m].name + ", check", tallies[m].checking, ms);
    }
  }
}

constexpr const char* kProgram = "matching-accuracy";

}  // namespace

int main(int argc, char** argv) {
  return config::run_program(kProgram, [&] {
    Options options;
    config::Section section("figures");
    section.add("data", options.data, "folder of the data, which holds stereo_dev");
    section.add("step", options.step, "frames", "look at every frame of so many", {1, 1000});
    config::Parser parser(kProgram, "Prints how well people's pixels are matched, beside OpenCV.");
    parser.add(section);
    if (parser.parse(argc, argv)) print_table(options);
  });
}
