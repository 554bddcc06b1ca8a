#include <cstdio>

#include "common/camera/calibration_io.hpp"
#include "common/config/log.hpp"
#include "common/formatted.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/coverage.hpp"
#include "modules/calibrate/output.hpp"
#include "modules/calibrate/pair_input.hpp"
#include "modules/calibrate/report.hpp"

namespace limbcast::calibrate {
namespace {

struct Options {
  SourceOptions source;
  BoardOptions board;
  std::string output, picture;
  int views = 30;
};

void declare(config::Section& section, Options& options) {
  declare_source(section, options.source);
  declare(section, options.board);
  section.add("output", options.output, "calibration file to write (OpenCV YAML)");
  section.add("picture", options.picture,
              "picture to draw of the covered area and the errors (PNG)");
  section.add("views", options.views, "",
              "from a video or camera, stop when so many views are taken", {5, 500});
}

ViewCollector collect(const Options& options, const Board& board) {
  const bool sequence = in_sequence(options.source.source);
  ViewCollector collector(board, sequence);
  visit_pairs(options.source, [&](const GreyPair& pair) {
    if (!collector.add(pair)) return true;
    const auto taken = static_cast<int>(collector.views().size());
    config::log(config::LogLevel::kInfo, formatted("%s: view %d taken", pair.name.c_str(), taken));
    return !sequence || taken < options.views;
  });
  return collector;
}

void print(const std::string& words) { std::fputs(words.c_str(), stdout); }

void print_advice(const std::vector<std::string>& advice) {
  for (const std::string& sentence : advice) print("to add: " + sentence + "\n");
}

/// True: the result may be used; else it says why not.
bool accept(const StereoFit& fit, const cv::Size& size) {
  const double coverage = std::min(share_of(covered_area(fit.views, Side::kLeft, size)),
                                   share_of(covered_area(fit.views, Side::kRight, size)));
  const Verdict verdict = judge(fit, coverage);
  for (const std::string& warning : verdict.warnings) print("warning: " + warning + "\n");
  for (const std::string& fault : verdict.faults) print("refused: " + fault + "\n");
  return verdict.faults.empty();
}

bool calibrate(const Options& options) {
  const Board board = to_board(options.board);
  const ViewCollector collector = collect(options, board);
  if (!in_sequence(options.source.source)) print(rejected_table(collector.rejected()));
  const StereoFit fit = fit_stereo(collector.views(), board, collector.image_size());
  print(rejected_table(fit.outliers) + view_table(fit.figures) + summary_text(fit));
  print_advice(advise(fit, collector.image_size()));
  if (!options.picture.empty()) write_picture(options.picture, draw_report(fit));
  if (!accept(fit, collector.image_size())) return false;
  write_stereo_calibration(options.output, fit.calibration);
  print("written: " + options.output + "\n");
  return true;
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
  return calibrate(options);
}

}  // namespace limbcast::calibrate
