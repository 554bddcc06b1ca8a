#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/config/log.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/whole_log.hpp"
#include "common/sources/frame_source.hpp"
#include "common/sources/pacer.hpp"
#include "common/sources/source_process.hpp"

namespace limbcast {

/// Completes frames of one source as the options say, and sends them.
template <class Frame>
class FrameSender {
 public:
  using Send = std::function<void(Outlet&, Frame&)>;

  FrameSender(const SourceProcessOptions& options, const Mounting& calibration, Send send)
      : options_(options),
        option_mounting_(mounting_of(options)),
        calibration_mounting_(calibration),
        send_(std::move(send)) {}

  void send(Outlet& outlet, Frame frame) {
    apply_mounting(option_mounting_, calibration_mounting_, frame.stamp.gravity);
    if (options_.restamp) {
      frame.stamp.utime = lcm_io::utime_now();
      if (frame.truth) frame.truth->stamp.utime = frame.stamp.utime;
    }
    send_(outlet, frame);
    if (frame.truth) {
      outlet.send(frame.stamp.utime, options_.truth_channel, lcm_io::to_message(*frame.truth));
    }
    ++num_sent_;
  }
  std::int64_t num_sent() const { return num_sent_; }

 private:
  const SourceProcessOptions& options_;
  Mounting option_mounting_, calibration_mounting_;
  Send send_;
  std::int64_t num_sent_ = 0;
};

template <class Frame>
void publish(FrameSource<Frame>& source, FrameSender<Frame>& sender, lcm_io::Module& module,
             double rate_hz) {
  Outlet outlet(module);
  Pacer pacer(rate_hz);
  ProblemReport problems(module);
  while (!source.ended() && !lcm_io::stop_requested()) {
    std::optional<Frame> frame = source.next();
    show_statistics(source.statistics(), module);
    problems.tell(source.problem());
    if (frame && !source.live()) {
      wait_until(pacer.due(frame->stamp.utime, Pacer::Clock::now()), module);
    }
    if (frame && !lcm_io::stop_requested()) sender.send(outlet, std::move(*frame));
    module.spin_once();
  }
  show_statistics(source.statistics(), module);
  problems.tell(source.problem());
}

/// Did all come that there is? A live source has no end: to be told to is how its recording is
/// complete. Of some recordings only the attempt to read on tells that nothing is left.
template <class Frame>
bool is_complete(FrameSource<Frame>& source) {
  return source.live() || source.ended() || (!source.next() && source.ended());
}

template <class Frame>
void write_log(FrameSource<Frame>& source, FrameSender<Frame>& sender, const std::string& path) {
  lcm_io::WholeLog log(path);
  bool complete = false;
  try {
    while (!source.ended() && !lcm_io::stop_requested()) {
      std::optional<Frame> frame = source.next();
      if (!frame) continue;
      Outlet outlet(log.writer());
      sender.send(outlet, std::move(*frame));
    }
    complete = is_complete(source);
  } catch (...) {
    if (log.begun()) config::log(config::LogLevel::kWarning, log.what_is_left("sent"));
    throw;
  }
  if (!source.problem().empty()) config::log(config::LogLevel::kError, source.problem());
  log.close();
  if (complete) {
    if (!log.begun()) throw std::runtime_error(path + ": was not written, as no frame came");
    return log.finish();
  }
  const std::optional<std::int64_t> num_frames = source.num_frames();
  throw std::runtime_error("interrupted: " + std::to_string(sender.num_sent()) +
                           (num_frames ? " of " + std::to_string(*num_frames) : "") + " frames; " +
                           log.what_is_left("sent"));
}

/// Sends the frames of the source until it ends or the program is told to: a recording at its rate,
/// sensors as they come, a log as fast as it can. `start` says at the start what there is to say.
template <class Frame>
void run_frames(const std::string& module_name, const SourceProcessOptions& options,
                const config::CommonOptions& common, FrameSource<Frame>& source,
                FrameSender<Frame>& sender, const std::string& description) {
  if (options.log.empty()) {
    lcm_io::Module module(module_name, common);
    config::log(config::LogLevel::kInfo, description);
    publish(source, sender, module, options.source.rate_hz);
  } else {
    check_log_file(options);
    config::configure_log(module_name, common.log_level);
    lcm_io::install_signal_handlers();
    config::log(config::LogLevel::kInfo, description);
    write_log(source, sender, options.log);
  }
  config::log(config::LogLevel::kInfo, std::to_string(sender.num_sent()) + " frames sent");
}

}  // namespace limbcast
