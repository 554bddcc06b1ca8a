#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limbcast {

/// One line of timestamps.csv.
struct FrameTime {
  std::string name;
  std::int64_t utime = 0;               ///< [us since the Unix epoch]
  std::optional<Eigen::Vector3f> down;  ///< unit gravity vector in the sensor's frame
};

/// Reads "name,utime" with, optionally, "down_x,down_y,down_z" (header line first), sorted by time.
/// Throws InputError with the line's number for a torn line, no number, a name or time told twice.
std::vector<FrameTime> read_timestamps(const std::string& path);

/// How the two files of one frame are told apart.
struct FilePair {
  std::string first, second;  ///< "left" and "right", or "color" and "depth"
};

/// One frame of a folder: its times and the paths of its two files.
struct RecordedFrame {
  FrameTime time;
  std::string first_path, second_path;  ///< first: empty where there is none
  std::string truth_path;               ///< NAME_gt.json, empty where there is none
};

struct Recording {
  std::vector<RecordedFrame> frames;  ///< in the order of time
  bool has_timestamps = false;        ///< false: times were made from the index and the rate
  int frames_without_time = 0;        ///< in the folder but not in timestamps.csv: left out
};

struct RecordingParams {
  double rate_hz = 10.0;  ///< of a folder without timestamps.csv: utime = start + index / rate
  std::int64_t start_utime = 0;  ///< of its first frame [us]
  /// No frame needs the first of its two files where none has one.
  bool first_is_optional = false;
};

/// Finds the frames NAME_first.EXT + NAME_second.EXT (files: jpg, jpeg or png) in `folder`, ordered
/// by timestamps.csv where there is one, else by name. Throws InputError where the folder is
/// missing or has no frame, where a file has no partner, or where timestamps.csv names a frame that
/// is not there.
Recording find_recording(const std::string& folder, const FilePair& pair,
                         const RecordingParams& params);

/// Same for frames of one file each, NAME.EXT with one of these extensions (".pcd"); `second_path`
/// is empty.
Recording find_recording_of_files(const std::string& folder,
                                  const std::vector<std::string>& extensions,
                                  const RecordingParams& params);

/// How long a recording lasts that is played again and again, with the mean time between frames
/// from its last frame to the first of the next round [us]; of a single frame 1 / rate.
std::int64_t round_duration_us(const Recording& recording, double rate_hz);

}  // namespace limbcast
