#pragma once

#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/lcm_io/log_file.hpp"
#include "modules/pose_fitter/stage.hpp"
#include "modules/reconstructor/stage.hpp"
#include "modules/segmenter/stage.hpp"
#include "modules/tracker/stage.hpp"

namespace limbcast::replay {

/// Messages of the chain in the order in which they are made from one another.
enum class Level { kImages = 0, kClouds = 1, kSegments = 2, kPoses = 3 };

/// What one sensor saw at one moment.
struct Frame {
  std::string sensor;
  std::int64_t utime = 0;
  bool operator<(const Frame& other) const {
    return std::tie(sensor, utime) < std::tie(other.sensor, other.utime);
  }
};

struct ChainOptions {
  reconstructor::StageOptions reconstructor;
  segmenter::StageOptions segmenter;
  pose_fitter::StageOptions pose_fitter;
  tracker::StageOptions tracker;
};

/// What became of one frame.
struct FrameResult {
  std::vector<lcm_io::LogEvent> events;  ///< made from it, in the order of the chain
  int persons = 0;
  std::string malformed;  ///< why the message was dropped, empty where it was not
  std::string failure;    ///< why a stage could not work on it, empty where it could
};

/// Reconstructor, segmenter and pose fitter in one process, with the same stages as the three
/// processes and through the same messages. Frames are independent of one another so far; the
/// tracker, which needs them in order, comes after.
class Chain {
 public:
  explicit Chain(const ChainOptions& options);

  /// Level of the messages on that channel; nothing for channels outside the chain.
  std::optional<Level> level_of(const std::string& channel) const;
  bool is_calibration(const std::string& channel) const;
  /// Frame to which a message of the chain belongs; nothing where it is malformed.
  std::optional<Frame> frame_of(const lcm_io::LogEvent& event) const;
  /// True for images that need a calibration, which comes in a message of its own.
  bool needs_calibration(const std::string& channel) const;
  bool has_calibration(const std::string& sensor) const;

  /// Takes a calibration over, for the frames that come later. Throws MessageError or what the
  /// reconstructor says.
  void on_calibration(const lcm_io::LogEvent& event);
  /// The same for a sensor that has none yet; one that cannot be used is passed over.
  void on_first_calibration(const lcm_io::LogEvent& event);
  /// The work on a frame; to be called later, from any thread, without this object changing under
  /// it.
  std::function<FrameResult()> prepare(lcm_io::LogEvent event) const;

 private:
  using Reconstructor = std::shared_ptr<const reconstructor::StereoReconstructor>;
  void from_images(const lcm_io::LogEvent& event, const Reconstructor& stereo,
                   FrameResult& result) const;
  void from_cloud(std::int64_t utime, const point_cloud_t& cloud, FrameResult& result) const;
  void from_segments(std::int64_t utime, const segments_t& segments, FrameResult& result) const;
  void work(const lcm_io::LogEvent& event, const Reconstructor& stereo, FrameResult& result) const;

  ChainOptions options_;
  reconstructor::Stage reconstructor_;
  segmenter::Stage segmenter_;
  pose_fitter::Stage pose_fitter_;
};

}  // namespace limbcast::replay
