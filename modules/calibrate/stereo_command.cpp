#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "common/camera/calibration_writer.hpp"
#include "common/camera/picture_file.hpp"
#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/formatted.hpp"
#include "common/lcm_io/module.hpp"
#include "common/sources/source_process.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/pair_input.hpp"
#include "modules/calibrate/report.hpp"
#include "modules/calibrate/verdict.hpp"

namespace limbcast::calibrate {
namespace {

constexpr const char* kFisheye = "fisheye";

struct Options {
  SourceOptions source;
  BoardOptions board;
  std::string lens = "pinhole", output, picture;
  CompletionParams completion;
};

void declare(config::Section& section, Options& options) {
  declare_source(section, options.source);
  declare(section, options.board);
  section.add_choice("lens", options.lens, {"pinhole", kFisheye},
                     "how both lenses are made: pinhole, with k1 k2 p1 p2 k3 (ROS: plumb_bob), or "
                     "fisheye, with k1 to k4 of the angle (ROS: equidistant)");
  section.add("output", options.output, "calibration file to write (OpenCV YAML)");
  section.add_name("picture", options.picture,
                   "picture to draw of the covered area and the errors, .png or .jpg");
  section.add("views", options.completion.most_views, "",
              "from a video or camera, stop when so many views are taken, or earlier where nothing "
              "is missing",
              {5, 500});
}

LensModel model_of(const Options& options) {
  return options.lens == kFisheye ? LensModel::kFisheye : LensModel::kPinhole;
}

void print(const std::string& words) { std::fputs(words.c_str(), stdout); }

void print_now(const std::string& words) {
  print(words);
  std::fflush(stdout);
}

/// Tells those who hold the board why nothing happens, not for each frame.
class Hints {
 public:
  void tell(const RejectedView& frame) {
    constexpr std::chrono::seconds kPeriod{2};
    const auto now = std::chrono::steady_clock::now();
    if (now - told_at_ < kPeriod) return;
    config::log(config::LogLevel::kInfo, frame.name + ": " + frame.reason.text);
    told_at_ = now;
  }

 private:
  std::chrono::steady_clock::time_point told_at_ = std::chrono::steady_clock::now();
};

void tell_taken(const ViewCollector& collector, const SeenAreas& seen) {
  const std::vector<View>& views = collector.views();
  config::log(
      config::LogLevel::kInfo,
      formatted("%s: view %zu taken, boards cover %.0f %% of the image", views.back().name.c_str(),
                views.size(), 100.0 * least_coverage(views, seen)));
  for (const std::string& sentence : advise_places(views, seen))
    config::log(config::LogLevel::kInfo, sentence);
}

ViewCollector collect_shots(const SourceOptions& source, const Board& board) {
  config::log(config::LogLevel::kInfo,
              formatted("%s: looks for the board in %zu pairs", source.source.c_str(),
                        count_pairs(source.source)));
  ViewCollector collector(board, false);
  visit_pairs(source, [&](const GreyPair& pair) {
    // Told at once: where there is no board it is looked for longest, a second in large pictures.
    if (!collector.add(pair)) print_now(rejected_table({collector.rejected().back()}));
    return true;
  });
  return collector;
}

ViewCollector collect_from_video(const Options& options, const Board& board) {
  ViewCollector collector(board, true);
  Hints hints;
  visit_pairs(options.source, [&](const GreyPair& pair) {
    if (!collector.add(pair)) {
      hints.tell(collector.rejected().back());
      return true;
    }
    const SeenAreas seen = collector.seen_areas(model_of(options));
    tell_taken(collector, seen);
    return !complete(collector.views(), board, seen, model_of(options), options.completion);
  });
  return collector;
}

void print_advice(const std::vector<std::string>& advice) {
  for (const std::string& sentence : advice) print("to add: " + sentence + "\n");
}

/// True: the result may be used; else it says why not.
bool accept(const StereoFit& fit, const SeenAreas& seen) {
  const Verdict verdict = judge(fit, least_coverage(fit.views, seen));
  for (const std::string& warning : verdict.warnings) print("warning: " + warning + "\n");
  for (const std::string& fault : verdict.faults) print("refused: " + fault + "\n");
  return verdict.faults.empty();
}

bool calibrate(const Options& options) {
  const Board board = to_board(options.board);
  const ViewCollector collector = in_sequence(options.source.source)
                                      ? collect_from_video(options, board)
                                      : collect_shots(options.source, board);
  check_enough(collector.views(), collector.rejected());
  const SeenAreas seen = collector.seen_areas(model_of(options));
  const StereoFit fit =
      fit_stereo(collector.views(), board, collector.image_size(), model_of(options));
  print(rejected_table(fit.outliers) + left_out_table(fit.outlying_points) +
        view_table(fit.figures) + summary_text(fit, seen));
  print_advice(advise(fit, seen));
  const bool accepted = accept(fit, seen);
  if (accepted) {
    check_not_told_to_end();
    write_stereo_calibration(options.output, fit.calibration);
    print("written: " + options.output + "\n");
  }
  // Last: a picture that cannot be written costs no calibration.
  if (!options.picture.empty()) write_picture(options.picture, draw_report(fit, seen));
  return accepted;
}

}  // namespace

bool run_stereo(int argc, const char* const* argv) {
  Options options;
  config::Section section("calibrate");
  declare(section, options);
  config::Parser parser("limbcast-calibrate",
                        "Calibrates a stereo camera from pairs of pictures of a board. Other "
                        "commands: board, check, mounting (--help for each).");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  config::configure_log("calibrate", parser.common().log_level);
  lcm_io::install_signal_handlers();
  if (options.output.empty()) throw config::UsageError("--output is missing; see --help");
  keep_camera_options_out(options.source, kSecondKey, parser);
  const std::vector<std::string> inputs = pictures_read(options.source);
  config::check_output_file("--output", options.output, inputs);
  config::check_output_file("--picture", options.picture, inputs);
  config::check_outputs_differ("--picture", options.picture, "--output", options.output);
  check_picture_ending(options.picture);
  return calibrate(options);
}

}  // namespace limbcast::calibrate
