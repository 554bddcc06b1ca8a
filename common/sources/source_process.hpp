#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/options.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"
#include "common/sources/open_source.hpp"
#include "common/sources/pacer.hpp"

namespace limbcast {

/// How often a camera's calibration is sent, for the modules that start after it.
inline constexpr std::chrono::seconds kCalibrationPeriod{1};

/// Options that every process with a source of image pairs has.
struct SourceProcessOptions {
  SourceOptions source;
  std::string calibration;
  std::string sensor;
  std::string log;  ///< write an LCM log instead of publishing; empty: publish
  std::string down;
  double sensor_height_m = 0.0;  ///< 0: not told
  double start_time_s = 0.0;
  bool restamp = false;
  std::string truth_channel = "GROUND_TRUTH";
};

/// Declares those of a recording and its playback: sensor, log, rate, loop, times, gravity.
void declare_playback(config::Section& section, SourceProcessOptions& options);
/// Declares those of live cameras: size, rate, exposure, gain, pairing.
void declare_cameras(config::Section& section, SourceOptions& options);
/// Declares all; `second_key` is the option for the second camera, e.g. "source-right".
void declare(config::Section& section, SourceProcessOptions& options,
             const std::string& second_key);

/// Throws config::UsageError unless source and, for all but a log, calibration are given. With
/// `second_will_do` a second camera alone is enough.
void require_input(const SourceProcessOptions& options, const std::string& program,
                   bool second_will_do = false);

/// Throws config::UsageError where one of these options, which are for live sensors, stands on the
/// command line beside a recording.
void refuse_live_options(const std::string& recording, const std::vector<std::string>& keys,
                         const config::Parser& parser);
/// Throws config::UsageError where the source is a recording, but the command line gives options of
/// live cameras, or a second camera (its option is `second_key`) beside a folder or log. A robot's
/// configuration file may tell them: of no use then, and such a second camera is taken out.
void keep_camera_options_out(SourceOptions& options, const std::string& second_key,
                             const config::Parser& parser);

/// Throws config::UsageError where the command line gives the time of the first frame, but the
/// source has times of its own: a folder with timestamps.csv, a log, or a camera. A robot's
/// configuration file may tell it: of no use then.
void keep_start_time_out(const SourceOptions& options, const config::Parser& parser);
/// The same of other sources, which their program knows to have times of their own.
void keep_start_time_out(const std::string& source, bool has_own_times,
                         const config::Parser& parser);

/// Throws config::UsageError for a log that would never end.
void require_end(const SourceProcessOptions& options);

/// Throws config::UsageError where the log cannot be written, or would be over a file that is read.
void check_log_file(const SourceProcessOptions& options);

/// Mounting as the options tell it. Throws config::UsageError for a `down` that is no unit vector.
Mounting mounting_of(const SourceProcessOptions& options);

/// Where messages go: onto LCM or into a log.
class Outlet {
 public:
  explicit Outlet(lcm_io::Module& module) : module_(&module) {}
  explicit Outlet(lcm_io::LogWriter& log) : log_(&log) {}

  /// A message that belongs to the frame of `utime`.
  template <class Message>
  void send(std::int64_t utime, const std::string& channel, const Message& message) {
    if (log_ != nullptr) {
      log_->write(utime, channel, message);
    } else {
      module_->publish(channel, message);
    }
  }
  /// The frame itself, which is counted.
  template <class Message>
  void send_frame(const std::string& channel, const Message& message) {
    if (log_ != nullptr) {
      log_->write(message.stamp.utime, channel, message);
    } else {
      module_->publish_frame(channel, message);
    }
  }
  /// A problem that the program survives: logged, and in the status.
  void report_problem(const std::string& text);
  /// What a user wants to know besides: in the status, where there is one.
  void set_note(const std::string& text);
  /// The clock of what is sent once a second: the log's, or this host's [us].
  std::int64_t now(std::int64_t frame_utime) const {
    return log_ != nullptr ? frame_utime : lcm_io::utime_now();
  }

 private:
  lcm_io::Module* module_ = nullptr;
  lcm_io::LogWriter* log_ = nullptr;
};

/// Returns when `due` has come or the program is told to end; the module's status goes on.
void wait_until(Pacer::Clock::time_point due, lcm_io::Module& module);

/// Puts what a source counts, if it counts anything, into the status.
void show_statistics(const std::optional<SourceStatistics>& statistics, lcm_io::Module& module);

/// Tells what is wrong with a live source, in the status and the log, and when that is over.
class ProblemReport {
 public:
  explicit ProblemReport(lcm_io::Module& module) : module_(module) {}
  /// `problem`: what is wrong now; empty: nothing.
  void tell(const std::string& problem);

 private:
  lcm_io::Module& module_;
  std::string last_;
};

/// Sends one frame with what belongs to it.
using SendFrame = std::function<void(Outlet&, const FramePair&)>;

/// Sends the frames of the source until it ends or the program is told to: a recording at its rate,
/// cameras as they come, a log as fast as it can. `calibration` is the mounting of the calibration
/// file.
void run_source(const std::string& module_name, const SourceProcessOptions& options,
                const config::CommonOptions& common, const PairFormat& format,
                const Mounting& calibration, const SendFrame& send);

}  // namespace limbcast
