#include <cstdio>
#include <string>

#include "common/camera/calibration_writer.hpp"
#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/mounting.hpp"
#include "modules/calibrate/pair_input.hpp"

namespace limbcast::calibrate {
bool run_mounting(int argc, const char* const* argv) {
  SourceOptions source;
  std::string calibration_file;
  std::string output;
  int max_pairs = 10;
  config::Section section("calibrate");
  declare_source(section, source);
  section.add("calibration", calibration_file,
              "calibration to complete; default: the one in the log");
  section.add("output", output, "calibration file to write");
  section.add("pairs", max_pairs, "", "look at so many pairs, from the first on", {1, 100000});
  config::Parser parser("limbcast-calibrate mounting",
                        "Adds gravity and the camera's height, from the ground that a recording "
                        "shows, to a calibration.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  if (output.empty()) throw config::UsageError("--output is missing; see --help");
  config::check_output_file("--output", output);
  config::configure_log("calibrate", parser.common().log_level);
  lcm_io::install_signal_handlers();

  StereoCalibration calibration = find_calibration(calibration_file, source.source);
  MountingFinder finder(calibration);
  visit_pairs(source, [&](const GreyPair& pair) {
    finder.add(pair);
    return finder.pairs() < max_pairs;
  });
  calibration.mounting = finder.mounting();
  const Eigen::Vector3d& down = *calibration.mounting.down;
  std::printf("%d of %d pairs show the ground: down %.3f, %.3f, %.3f, camera %.2f m above it\n",
              finder.pairs_with_ground(), finder.pairs(), down.x(), down.y(), down.z(),
              *calibration.mounting.sensor_height_m);
  write_stereo_calibration(output, calibration);
  std::printf("written: %s\n", output.c_str());
  return true;
}

}  // namespace limbcast::calibrate
