#include "common/sources/log_playback.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <map>
#include <set>

#include "common/config/log.hpp"
#include "common/input_error.hpp"
#include "common/joined.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/sources/pacer.hpp"
#include "common/units.hpp"

namespace limbcast {
namespace {

/// Times of one round through the log.
struct Round {
  std::int64_t first_utime = 0, last_utime = 0;
  std::int64_t frames = 0;
  std::set<std::string> channels;
};

template <class Message>
class LogPlayer {
 public:
  LogPlayer(const SourceProcessOptions& options, const PlaybackChannels& channels,
            lcm_io::Module& module)
      : options_(options), channels_(channels), module_(module), pacer_(options.source.rate_hz) {}

  Round play(std::int64_t offset_us) {
    lcm_io::LogReader reader(options_.source.source);
    Round round;
    while (!lcm_io::stop_requested()) {
      const std::optional<lcm_io::LogEvent> event = reader.next();
      if (!event) break;
      round.channels.insert(event->channel);
      try {
        send(*event, offset_us, round);
      } catch (const lcm_io::MessageError& error) {
        module_.report_problem(options_.source.source + ": " + event->channel +
                               ": message left out: " + error.what());
      }
    }
    if (reader.torn_bytes() > 0)
      module_.report_problem(options_.source.source + ": torn, " +
                             std::to_string(reader.torn_bytes()) +
                             " bytes at its end hold no whole message");
    return round;
  }

 private:
  void send(const lcm_io::LogEvent& event, std::int64_t offset_us, Round& round) {
    if (event.channel == channels_.frames) {
      send_frame(lcm_io::decode<Message>(event.data), offset_us, round);
    } else if (event.channel == channels_.truth) {
      auto truth = lcm_io::decode<body_poses_t>(event.data);
      // Truth follows its frame; without one before it, it belongs to another camera.
      if (round.frames == 0 || truth.stamp.utime != recorded_utime_) return;
      truth.stamp.utime = sent_utime_;
      truth.stamp.sequence = sent_sequence_;
      module_.publish(channels_.truth, truth);
    } else if (event.channel == channels_.calibration) {
      const auto calibration = lcm_io::decode<stereo_calibration_t>(event.data);
      calibrations_[calibration.sensor] = calibration;
      send_calibrations();
    }
  }

  void send_calibrations() {
    for (const auto& [sensor, calibration] : calibrations_)
      module_.publish(channels_.calibration, calibration);
    calibrations_sent_at_ = Pacer::Clock::now();
  }

  void send_frame(Message frame, std::int64_t offset_us, Round& round) {
    recorded_utime_ = frame.stamp.utime;
    if (round.frames++ == 0) round.first_utime = frame.stamp.utime;
    round.last_utime = frame.stamp.utime;
    wait_until(pacer_.due(frame.stamp.utime + offset_us, Pacer::Clock::now()), module_);
    if (Pacer::Clock::now() - calibrations_sent_at_ >= kCalibrationPeriod) send_calibrations();
    sent_utime_ = options_.restamp ? lcm_io::utime_now() : frame.stamp.utime + offset_us;
    frame.stamp.utime = sent_utime_;
    sent_sequence_ = module_.publish_frame(channels_.frames, frame);
  }

  const SourceProcessOptions& options_;
  const PlaybackChannels& channels_;
  lcm_io::Module& module_;
  Pacer pacer_;
  std::map<std::string, stereo_calibration_t> calibrations_;  ///< the last of each sensor
  Pacer::Clock::time_point calibrations_sent_at_;
  std::int64_t recorded_utime_ = 0, sent_utime_ = 0, sent_sequence_ = 0;
};

}  // namespace

bool is_lcm_log(const std::string& source) {
  const bool named_like_one = std::filesystem::path(source).extension() == ".log" &&
                              std::filesystem::is_regular_file(source);
  return named_like_one || begins_as_lcm_log(source);
}

bool begins_as_lcm_log(const std::string& source) {
  constexpr std::array<char, 4> kSyncWord = {'\xED', '\xA1', '\xDA', '\x01'};
  if (!std::filesystem::is_regular_file(source)) return false;
  std::array<char, 4> head{};
  std::ifstream(source, std::ios::binary).read(head.data(), head.size());
  return head == kSyncWord;
}

template <class Message>
void play_log(const std::string& module_name, const SourceProcessOptions& options,
              const config::CommonOptions& common, const PlaybackChannels& channels) {
  if (!options.log.empty()) throw config::UsageError("'source' is a log already; leave out 'log'");
  lcm_io::Module module(module_name, common);
  LogPlayer<Message> player(options, channels, module);
  // Moves a round's times, so that they go on rising when the log starts again.
  std::int64_t offset_us = 0;
  std::int64_t frames = 0;
  do {
    const Round round = player.play(offset_us);
    if (round.frames == 0 && !lcm_io::stop_requested())
      throw InputError(options.source.source + ": holds no frame on " + channels.frames +
                       (round.channels.empty() ? "" : " but " + joined(round.channels)) +
                       "; choose their channel with --images-channel, or play other messages "
                       "with lcm-logplayer");
    frames += round.frames;
    const double pause_s =
        1.0 / (options.source.rate_hz > 0.0 ? options.source.rate_hz : kDefaultRate_hz);
    offset_us += round.last_utime - round.first_utime +
                 std::llround(kMicrosecondsPerSecond<double> * pause_s);
  } while (options.source.loop && !lcm_io::stop_requested());
  config::log(config::LogLevel::kInfo, std::to_string(frames) + " frames sent");
}

template void play_log<stereo_images_t>(const std::string&, const SourceProcessOptions&,
                                        const config::CommonOptions&, const PlaybackChannels&);
template void play_log<depth_images_t>(const std::string&, const SourceProcessOptions&,
                                       const config::CommonOptions&, const PlaybackChannels&);

}  // namespace limbcast
