#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module_status_codec.hpp"
#include "modules/viewer/frame_assembler.hpp"

namespace limbcast::viewer {

/// What is drawn, by the channels on which it comes.
struct ViewChannels {
  std::string point_cloud = "POINT_CLOUD", segments = "SEGMENTS", poses = "BODY_POSES";
  std::string truth = "GROUND_TRUTH", status = "MODULE_STATUS";
};

/// How a module fares, in the words of the sheet.
ModuleFigures figures_of(const lcm_io::ModuleStatus& status);

/// The frames of a log by their time, any of them at once: the log is read through to learn where
/// their messages stand.
class LogFrames {
 public:
  /// Throws config::UsageError where the log cannot be used.
  LogFrames(const std::string& log, const ViewChannels& channels);

  int count() const { return static_cast<int>(frames_.size()); }
  /// Without what cannot be decoded.
  ViewFrame frame(int number);

  bool has_poses() const { return has_poses_; }
  /// That carry poses, but neither those that are drawn nor the truth.
  const std::set<std::string>& other_pose_channels() const { return other_pose_channels_; }
  std::int64_t torn_bytes() const { return torn_bytes_; }
  /// Messages met so far that were dropped; warns of the first.
  int num_malformed() const { return static_cast<int>(malformed_.size()); }

 private:
  using Key = std::pair<std::int64_t, std::string>;  ///< utime, sensor
  struct Place {
    std::vector<std::int64_t> events;    ///< begins in the log [byte]
    bool has_more_than_truth = false;    ///< truth alone makes no frame
    std::vector<ModuleFigures> modules;  ///< as last told before its first message
  };
  void note(const lcm_io::LogEvent& event, std::int64_t begin, std::map<Key, Place>& places);
  void take_status(const lcm_io::LogEvent& event);
  void drop(const lcm_io::LogEvent& event, std::int64_t begin, const std::string& reason);

  ViewChannels channels_;
  lcm_io::LogReader reader_;
  std::map<std::string, ModuleFigures> modules_;
  std::vector<Place> frames_;
  std::set<std::int64_t> malformed_;
  bool has_poses_ = false;
  std::set<std::string> other_pose_channels_;
  std::int64_t torn_bytes_ = 0;
};

}  // namespace limbcast::viewer
