#include <cstdio>
#include <filesystem>

#include "common/camera/calibration_io.hpp"
#include "common/camera/yaml_reader.hpp"
#include "common/config/log.hpp"
#include "common/lcm_io/module.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/mounting.hpp"
#include "modules/calibrate/pair_input.hpp"

namespace limbcast::calibrate {
namespace {

/// The file to write: the calibration itself, unless it is of a kind that is not written.
std::string output_of(const std::string& output, const std::string& calibration) {
  if (!output.empty()) return output;
  const bool opencv = !calibration.empty() && !std::filesystem::is_directory(calibration) &&
                      !YamlReader(calibration).has("camera_matrix");
  if (!opencv)
    throw config::UsageError("--output is missing: only an OpenCV calibration file is completed");
  return calibration;
}

}  // namespace

bool run_mounting(int argc, const char* const* argv) {
  SourceOptions source;
  std::string calibration_file;
  std::string output;
  int max_pairs = 10;
  config::Section section("calibrate");
  declare_source(section, source);
  section.add("calibration", calibration_file,
              "calibration to complete; default: the one in the log");
  section.add("output", output, "calibration file to write; default: the one given");
  section.add("pairs", max_pairs, "", "look at so many pairs, from the first on", {1, 100000});
  config::Parser parser("limbcast-calibrate mounting",
                        "Adds gravity and the camera's height, from the ground that a recording "
                        "shows, to a calibration.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  config::configure_log("calibrate", parser.common().log_level);
  lcm_io::install_signal_handlers();

  StereoCalibration calibration = find_calibration(calibration_file, source.source);
  output = output_of(output, calibration_file);
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
