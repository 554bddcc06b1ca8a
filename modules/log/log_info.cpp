#include "modules/log/log_info.hpp"

#include <algorithm>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <tuple>

#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/units.hpp"
#include "modules/log/message_types.hpp"

namespace limbcast::logs {
namespace {

using lcm_io::LogEvent;

double baseline_of(const stereo_calibration_t& message) {
  return lcm_io::from_message(message).T.norm();
}

class Survey {
 public:
  explicit Survey(const ChannelFilter& filter) : filter_(filter) {}

  LogInfo read(const std::string& path) {
    lcm_io::LogReader reader(path);
    info_.path = path;
    info_.size_bytes = reader.size_bytes();
    while (const auto event = reader.next())
      if (filter_.takes(event->channel)) add(*event);
    info_.torn_bytes = reader.torn_bytes();
    info_.damaged_bytes = reader.damaged_bytes();
    for (auto& [key, module] : modules_) info_.modules.push_back(std::move(module));
    return std::move(info_);
  }

 private:
  void add(const LogEvent& event) {
    add_times(event);
    const MessageSummary summary = summarize(event);
    add_message(event, summary);
    if (!summary.malformed.empty()) return;
    try {
      if (summary.type == module_status_t::getTypeName()) add_status(event);
      if (summary.type == stereo_calibration_t::getTypeName()) add_stereo_camera(event);
      if (summary.type == depth_images_t::getTypeName()) add_depth_camera(event);
    } catch (const lcm_io::MessageError& error) {
      add_malformed(info_.channels[event.channel], error.what());
    }
  }

  void add_times(const LogEvent& event) {
    if (info_.events == 0) {
      info_.first_utime = info_.last_utime = event.utime;
      info_.first_number = event.number;
    } else {
      info_.missing_numbers += std::max<std::int64_t>(0, event.number - info_.last_number - 1);
      info_.backward_steps += event.utime < previous_utime_ ? 1 : 0;
    }
    info_.first_utime = std::min(info_.first_utime, event.utime);
    info_.last_utime = std::max(info_.last_utime, event.utime);
    info_.last_number = event.number;
    previous_utime_ = event.utime;
    ++info_.events;
  }

  void add_message(const LogEvent& event, const MessageSummary& summary) {
    ChannelInfo& channel = info_.channels[event.channel];
    const std::string type = summary.type.empty() ? fingerprint_text(event) : summary.type;
    if (channel.messages == 0) {
      channel.type = type;
      channel.foreign = summary.type.empty();
      channel.first_utime = channel.last_utime = event.utime;
    }
    channel.several_types = channel.several_types || type != channel.type;
    channel.longest_gap_us = std::max(channel.longest_gap_us, event.utime - channel.last_utime);
    channel.last_utime = event.utime;
    ++channel.messages;
    channel.bytes += static_cast<std::int64_t>(event.data.size());
    if (!summary.malformed.empty()) add_malformed(channel, summary.malformed);
    if (summary.stamp) add_frame(channel.sensors[summary.stamp->sensor], summary.stamp->sequence);
  }

  static void add_malformed(ChannelInfo& channel, const std::string& reason) {
    if (channel.malformed++ == 0) channel.first_malformed = reason;
  }

  static void add_frame(SensorInfo& sensor, std::int64_t sequence) {
    if (sensor.frames++ > 0) {
      if (sequence == sensor.last_sequence) ++sensor.repeated;
      if (sequence < sensor.last_sequence) ++sensor.restarts;
      if (sequence > sensor.last_sequence) sensor.lost += sequence - sensor.last_sequence - 1;
    }
    sensor.last_sequence = sequence;
  }

  void add_status(const LogEvent& event) {
    const auto status = lcm_io::decode<module_status_t>(event.data);
    modules_[{status.host, status.module, status.pid}] = {
        status.host,       status.module,      status.version,      status.state,
        status.last_error, status.pid,         status.num_received, status.num_published,
        status.num_lost,   status.num_skipped, status.num_malformed};
  }

  void add_stereo_camera(const LogEvent& event) {
    const auto message = lcm_io::decode<stereo_calibration_t>(event.data);
    CameraInfo camera{message.left.width,
                      message.left.height,
                      message.left.fx,
                      baseline_of(message),
                      message.mounting.has_down != 0,
                      0,
                      {}};
    // The time of sending differs in each; the rest tells whether the calibration is another.
    stereo_calibration_t timeless = message;
    timeless.utime = 0;
    camera.last_bytes = lcm_io::encode(timeless);
    add_camera(message.sensor, std::move(camera));
  }

  void add_depth_camera(const LogEvent& event) {
    const auto message = lcm_io::decode<depth_images_t>(event.data);
    add_camera(message.stamp.sensor, {message.lens.width,
                                      message.lens.height,
                                      message.lens.fx,
                                      0.0,
                                      message.mounting.has_down != 0,
                                      0,
                                      {}});
  }

  void add_camera(const std::string& sensor, CameraInfo camera) {
    const auto known = info_.cameras.find(sensor);
    if (known != info_.cameras.end())
      camera.changes =
          known->second.changes + (known->second.last_bytes == camera.last_bytes ? 0 : 1);
    info_.cameras[sensor] = std::move(camera);
  }

  const ChannelFilter& filter_;
  LogInfo info_;
  std::int64_t previous_utime_ = 0;
  std::map<std::tuple<std::string, std::string, int>, ModuleInfo> modules_;
};

}  // namespace

double ChannelInfo::rate_hz() const {
  const auto duration_s =
      static_cast<double>(last_utime - first_utime) / kMicrosecondsPerSecond<double>;
  return messages > 1 && duration_s > 0.0 ? static_cast<double>(messages - 1) / duration_s : 0.0;
}

double LogInfo::duration_s() const {
  return static_cast<double>(last_utime - first_utime) / kMicrosecondsPerSecond<double>;
}

LogInfo read_info(const std::string& path, const ChannelFilter& filter) {
  return Survey(filter).read(path);
}

}  // namespace limbcast::logs
