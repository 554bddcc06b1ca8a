#include <cstdio>

#include "common/config/log.hpp"
#include "common/lcm_io/module.hpp"
#include "common/sources/source_process.hpp"
#include "modules/calibrate/check.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/pair_input.hpp"

namespace limbcast::calibrate {

bool run_check(int argc, const char* const* argv) {
  SourceOptions source;
  BoardOptions board;
  std::string calibration;
  int max_pairs = 20;
  config::Section section("calibrate");
  declare_source(section, source);
  declare(section, board);
  section.add("calibration", calibration, "calibration to check; default: the one in the log");
  section.add("pairs", max_pairs, "", "look at so many pairs, from the first on", {1, 100000});
  config::Parser parser("limbcast-calibrate check",
                        "Measures how well a calibration fits a recording; exits with 1 where it "
                        "does not.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  config::configure_log("calibrate", parser.common().log_level);
  lcm_io::install_signal_handlers();

  keep_camera_options_out(source, kSecondKey, parser);
  const StereoCalibration cameras = find_calibration(calibration, source.source);
  CalibrationCheck check(cameras, to_board(board));
  visit_pairs(source, [&](const GreyPair& pair) {
    check_sizes(pair, cameras);
    check.add(pair);
    return check.result().pairs < max_pairs;
  });
  const CheckResult& result = check.result();
  std::printf("%d pairs, %d with a board, %zu matched points\n", result.pairs, result.board_pairs,
              result.row_differences_px.size());
  std::printf("epipolar error %.2f px (median), vertical shift %+.2f px (median)\n",
              result.median_epipolar_px(), result.median_shift_px());
  if (result.median_length_error())
    std::printf("lengths on the board %+.2f %% (median)\n", 100.0 * *result.median_length_error());
  const std::vector<std::string> faults = check.faults();
  for (const std::string& fault : faults) std::printf("bad: %s\n", fault.c_str());
  if (faults.empty()) std::printf("good\n");
  return faults.empty();
}

}  // namespace limbcast::calibrate
