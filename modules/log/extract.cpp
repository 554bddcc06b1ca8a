#include "modules/log/extract.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "common/camera/calibration_writer.hpp"
#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/joined.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stamp_codec.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "common/whole_file.hpp"
#include "modules/log/extracted_files.hpp"
#include "modules/log/message_types.hpp"
#include "modules/log/next_of.hpp"

namespace limbcast::logs {
namespace {

using config::UsageError;
using lcm_io::decode;
using lcm_io::LogEvent;

const std::set<std::string>& types_of(Extracted what) {
  static const std::map<Extracted, std::set<std::string>> types = {
      {Extracted::kImages, {stereo_images_t::getTypeName(), depth_images_t::getTypeName()}},
      {Extracted::kClouds, {point_cloud_t::getTypeName()}},
      {Extracted::kPoses, {body_poses_t::getTypeName()}}};
  return types.at(what);
}

/// Frames of two runs would be taken for one recording.
void require_no_recording(const std::string& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder + "/timestamps.csv", error))
    throw UsageError(folder +
                     ": holds a recording already; choose another folder or delete this one");
}

/// Channels may be called what they want, files may not: "../CLOUDS" would be another folder's.
std::string file_name_of(const std::string& channel) {
  std::string name = channel;
  for (char& letter : name) {
    const bool is_safe = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
                         letter == '-' || letter == '.';
    if (!is_safe) letter = '_';
  }
  const bool is_hidden = name.empty() || name.front() == '.';
  return (is_hidden ? "_" : "") + name + ".jsonl";
}

UsageError no_such_sensor(const ExtractOptions& options, const std::set<std::string>& sensors) {
  return UsageError(options.in + ": holds nothing of sensor '" + options.sensor + "', but of " +
                    joined(sensors));
}

/// First pass: which sensor's frames are meant.
std::string chosen_sensor(const ExtractOptions& options) {
  std::set<std::string> sensors;
  lcm_io::LogReader reader(options.in);
  while (const auto event = reader.next()) {
    if (!options.channels.takes(event->channel)) continue;
    const MessageSummary summary = summarize(*event);
    if (summary.stamp && types_of(options.what).count(summary.type) > 0)
      sensors.insert(summary.stamp->sensor);
  }
  if (!options.sensor.empty() && sensors.count(options.sensor) > 0) return options.sensor;
  if (sensors.empty())
    throw UsageError(options.in +
                     ": holds nothing of the kind; limbcast-log info shows what it has");
  if (!options.sensor.empty()) throw no_such_sensor(options, sensors);
  if (sensors.size() > 1)
    throw UsageError(options.in +
                     ": holds several sensors; choose one with --sensor: " + joined(sensors));
  return *sensors.begin();
}

std::string so_far(const ExtractOptions& options, std::int64_t frames) {
  return options.folder + " holds the " + std::to_string(frames) + " frames extracted so far";
}

/// What was written of a frame whose second file could not be.
void remove_begun(const std::string& path) {
  std::error_code ignored;
  for (const char* ending : {"_left.jpg", "_left.png", "_color.jpg", "_color.png"})
    std::filesystem::remove(path + ending, ignored);
}

/// Writes the frames of one sensor into a folder.
class FrameWriter {
 public:
  FrameWriter(const ExtractOptions& options, std::string sensor)
      : options_(options), sensor_(std::move(sensor)) {
    config::make_output_folder("FOLDER", options.folder);
    lock_.emplace(options.folder);
    require_no_recording(options.folder);
  }

  void take(const LogEvent& event) {
    try {
      take_in(event);
    } catch (const lcm_io::MessageError&) {
      throw;
    } catch (const std::exception& error) {
      // The times need far less room than a frame does; where there is none either, that is said.
      const std::int64_t frames = finish(true);
      throw std::runtime_error(std::string(error.what()) + "; " + so_far(options_, frames));
    }
  }

  std::int64_t finish(bool /*interrupted*/) {
    std::sort(stamps_.begin(), stamps_.end(),
              [](const Stamp& a, const Stamp& b) { return a.utime < b.utime; });
    // Without a frame, as where the program was told to end, the folder is no recording.
    if (!stamps_.empty()) write_timestamps(options_.folder + "/timestamps.csv", stamps_);
    for (const auto& [utime, truth] : truths_)
      if (written_.count(utime) > 0)
        write_truth(options_.folder + "/" + frame_name(truth.stamp) + "_gt.json", truth);
    return static_cast<std::int64_t>(stamps_.size());
  }

 private:
  void take_in(const LogEvent& event) {
    const MessageSummary summary = summarize(event);
    if (summary.type == stereo_calibration_t::getTypeName()) return take_calibration(event);
    if (!summary.stamp || summary.stamp->sensor != sensor_) return;
    if (event.channel == options_.truth_channel && summary.type == body_poses_t::getTypeName())
      return take_truth(event);
    if (types_of(options_.what).count(summary.type) == 0) return;
    const Stamp stamp = lcm_io::from_message(*summary.stamp);
    if (written_.count(stamp.utime) > 0) return;  // heard by two loggers
    const std::string path = options_.folder + "/" + frame_name(stamp);
    try {
      write(event, summary.type, path);
    } catch (...) {
      remove_begun(path);
      throw;
    }
    written_.insert(stamp.utime);
    stamps_.push_back(stamp);
  }

  void take_calibration(const LogEvent& event) {
    const auto message = decode<stereo_calibration_t>(event.data);
    if (has_calibration_ || options_.what != Extracted::kImages || message.sensor != sensor_)
      return;
    write_stereo_calibration(calibration_path(), lcm_io::from_message(message));
    has_calibration_ = true;
  }

  void take_truth(const LogEvent& event) {
    const BodyPoses truth = lcm_io::from_message(decode<body_poses_t>(event.data));
    truths_[truth.stamp.utime] = truth;
  }

  void write(const LogEvent& event, const std::string& type, const std::string& path) {
    if (type == stereo_images_t::getTypeName()) {
      const auto message = decode<stereo_images_t>(event.data);
      write_picture(path + "_left", message.left);
      write_picture(path + "_right", message.right);
    } else if (type == depth_images_t::getTypeName()) {
      write_depth(decode<depth_images_t>(event.data), path);
    } else {
      write_cloud(path + ".pcd", lcm_io::from_message(decode<point_cloud_t>(event.data)));
    }
  }

  void write_depth(const depth_images_t& message, const std::string& path) {
    if (!has_calibration_)
      write_depth_calibration(calibration_path(), lcm_io::from_message(message).calibration);
    has_calibration_ = true;
    if (message.color.width > 0) write_picture(path + "_color", message.color);
    write_picture(path + "_depth", message.depth);
  }

  std::string calibration_path() const { return options_.folder + "/calibration.yml"; }

  const ExtractOptions& options_;
  std::string sensor_;
  std::optional<config::FolderLock> lock_;  ///< timestamps.csv comes last
  bool has_calibration_ = false;
  std::set<std::int64_t> written_;
  std::vector<Stamp> stamps_;
  std::map<std::int64_t, BodyPoses> truths_;
};

/// Writes poses as lines, a file a channel, which takes its place when it is whole.
class PoseWriter {
 public:
  explicit PoseWriter(const ExtractOptions& options) : options_(options) {
    config::make_output_folder("FOLDER", options.folder);
  }

  void take(const LogEvent& event) {
    if (summarize(event).type != body_poses_t::getTypeName()) return;
    const BodyPoses poses = lcm_io::from_message(decode<body_poses_t>(event.data));
    if (!options_.sensor.empty() && poses.stamp.sensor != options_.sensor) {
      other_sensors_.insert(poses.stamp.sensor);
      return;
    }
    std::ofstream& file = file_of(event.channel);
    errno = 0;
    file << pose_json::to_line(poses) << '\n';
    if (!file) throw cannot_write(event.channel);
    ++lines_;
  }

  std::int64_t finish(bool interrupted) {
    for (auto& [channel, file] : files_) {
      errno = 0;
      file.close();
      if (!file) throw cannot_write(channel);
      if (!interrupted) finish_file(path_of(channel));
    }
    if (lines_ > 0 || interrupted) return lines_;
    if (!other_sensors_.empty()) throw no_such_sensor(options_, other_sensors_);
    throw UsageError(options_.in + ": holds no poses; limbcast-replay adds them");
  }

 private:
  std::ofstream& file_of(const std::string& channel) {
    std::ofstream& file = files_[channel];
    if (file.is_open()) return file;
    const auto [owner, is_new] = owners_.emplace(file_name_of(channel), channel);
    if (!is_new)
      throw UsageError(options_.in + ": poses of '" + owner->second + "' and '" + channel +
                       "' would both be " + owner->first + "; choose one with --channel");
    const std::string unfinished = unfinished_file(path_of(channel));
    // A pipe would be waited for by one who reads it.
    if (!std::filesystem::is_other(unfinished)) locks_.emplace_back(unfinished);
    file.open(unfinished);
    return file;
  }
  std::string path_of(const std::string& channel) const {
    return options_.folder + "/" + file_name_of(channel);
  }
  std::runtime_error cannot_write(const std::string& channel) const {
    return std::runtime_error(unfinished_file(path_of(channel)) + ": cannot be written (" +
                              std::strerror(errno) + "); make room or choose another folder");
  }

  const ExtractOptions& options_;
  std::list<lcm_io::FileLock> locks_;           ///< no other process writes the files
  std::map<std::string, std::ofstream> files_;  ///< by channel
  std::map<std::string, std::string> owners_;   ///< the channel of each file's name
  std::set<std::string> other_sensors_;
  std::int64_t lines_ = 0;
};

template <class Writer>
ExtractSummary extract_with(Writer& writer, const ExtractOptions& options) {
  ExtractSummary summary;
  lcm_io::LogReader reader(options.in);
  while (const auto event = next_of(reader)) {
    if (!options.channels.takes(event->channel)) continue;
    try {
      writer.take(*event);
    } catch (const lcm_io::MessageError&) {
      ++summary.malformed;
    }
  }
  const bool interrupted = !reader.at_end();
  summary.frames = writer.finish(interrupted);
  if (interrupted) throw std::runtime_error("interrupted; " + so_far(options, summary.frames));
  summary.torn_bytes = reader.torn_bytes();
  summary.damaged_bytes = reader.damaged_bytes();
  return summary;
}

}  // namespace

ExtractSummary extract(const ExtractOptions& options) {
  if (options.what == Extracted::kPoses) {
    PoseWriter writer(options);
    return extract_with(writer, options);
  }
  FrameWriter writer(options, chosen_sensor(options));
  return extract_with(writer, options);
}

}  // namespace limbcast::logs
