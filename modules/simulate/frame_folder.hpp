#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "common/config/output_file.hpp"
#include "modules/simulate/simulator.hpp"

namespace limbcast::simulate {

/// Writes frames as the folders that the sources read (data/README.md, Files of a frame):
/// - stereo: NAME_left.jpg, NAME_right.jpg, NAME_depth.png (true), NAME_mask.png;
/// - depth and stereo-depth: NAME_color.jpg, NAME_depth.png (as sensed), NAME_true.png,
/// NAME_mask.png;
/// - laser: NAME.pcd;
/// and for all NAME_gt.json, timestamps.csv, for cameras calibration.yml and NAME_labels.png (body
/// parts).
class FrameFolder {
 public:
  /// Makes the folder where it is missing. Throws config::UsageError where it cannot, and where the
  /// folder holds a recording: frames of two runs would be taken for one set.
  FrameFolder(const std::string& folder, const SimulatorParams& params);

  /// Throws std::runtime_error with the file's name where it cannot be written.
  void write(const SimulatedFrame& frame);

 private:
  std::string path(const SimulatedFrame& frame, const std::string& ending) const;

  std::string folder_;
  SimulatorParams params_;
  std::optional<config::FolderLock> lock_;
  std::ofstream timestamps_;
};

}  // namespace limbcast::simulate
