#include <cstdio>
#include <string>

#include "common/camera/calibration_writer.hpp"
#include "common/config/log.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/module.hpp"
#include "common/sources/source_process.hpp"
#include "modules/calibrate/commands.hpp"
#include "modules/calibrate/depth_input.hpp"
#include "modules/calibrate/mounting.hpp"
#include "modules/calibrate/pair_input.hpp"
#include "modules/reconstructor/reconstructor.hpp"

namespace limbcast::calibrate {
namespace {

struct MountingOptions {
  SourceOptions source;
  std::string depth_source, calibration, output;
  int max_frames = 10;
};

constexpr const char* kDepthKey = "source-depth";

/// The ground is looked for here.
reconstructor::ReconstructorOptions without_ground() {
  reconstructor::ReconstructorOptions options;
  options.ground_plane = false;
  return options;
}

Mounting report(const MountingFinder& finder) {
  const Mounting mounting = finder.mounting();
  const Eigen::Vector3d& down = *mounting.down;
  std::printf("%d of %d frames show the ground: down %.3f, %.3f, %.3f, camera %.2f m above it\n",
              finder.frames_with_ground(), finder.frames(), down.x(), down.y(), down.z(),
              *mounting.sensor_height_m);
  return mounting;
}

// What a calibration tells already must not hide what the ground says: it is taken out first.

void complete_stereo(const MountingOptions& options) {
  StereoCalibration calibration = find_calibration(options.calibration, options.source.source);
  calibration.mounting = {};
  const reconstructor::StereoReconstructor reconstructor(calibration, without_ground());
  MountingFinder finder;
  visit_pairs(options.source, [&](const GreyPair& pair) {
    check_sizes(pair, calibration);
    finder.add(reconstructor.reconstruct({{}, pair.left, pair.right}));
    return finder.frames() < options.max_frames;
  });
  calibration.mounting = report(finder);
  write_stereo_calibration(options.output, calibration);
}

void complete_depth(const MountingOptions& options) {
  DepthCalibration calibration = find_depth_calibration(options.calibration, options.source.source);
  calibration.mounting = {};
  const reconstructor::DepthReconstructor reconstructor(calibration, without_ground());
  MountingFinder finder;
  visit_depth_frames(options.source, calibration, [&](const DepthImages& images) {
    finder.add(reconstructor.reconstruct({{}, {}, images.depth}));
    return finder.frames() < options.max_frames;
  });
  calibration.mounting = report(finder);
  write_depth_calibration(options.output, calibration);
}

}  // namespace

bool run_mounting(int argc, const char* const* argv) {
  MountingOptions options;
  config::Section section("calibrate");
  declare_source(section, options.source);
  section.add(kDepthKey, options.depth_source,
              "depth camera or its video, beside or without --source for the colours");
  section.add(
      "calibration", options.calibration,
      "calibration to complete, of a stereo or a depth camera; default: the one in the log");
  section.add("output", options.output, "calibration file to write");
  section.add("pairs", options.max_frames, "", "look at so many frames, from the first on",
              {1, 100000});
  config::Parser parser("limbcast-calibrate mounting",
                        "Adds gravity and the camera's height, from the ground that a recording "
                        "shows, to a calibration.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return true;
  if (options.output.empty()) throw config::UsageError("--output is missing; see --help");
  const bool with_depth_camera = !options.depth_source.empty();
  if (with_depth_camera && !options.source.second_source.empty())
    throw config::UsageError(
        "--source-right is of a stereo camera, --source-depth of a depth camera; give one of them");
  if (with_depth_camera) options.source.second_source = options.depth_source;
  keep_camera_options_out(options.source, with_depth_camera ? kDepthKey : kSecondKey, parser);
  config::check_output_file("--output", options.output, pictures_read(options.source));
  config::configure_log("calibrate", parser.common().log_level);
  lcm_io::install_signal_handlers();

  const bool by_depth_camera = with_depth_camera && !options.source.second_source.empty();
  if (by_depth_camera || is_of_depth_camera(options.source.source))
    complete_depth(options);
  else
    complete_stereo(options);
  std::printf("written: %s\n", options.output.c_str());
  return true;
}

}  // namespace limbcast::calibrate
