#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stamp_t.hpp>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "common/bounded_map.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/pace.hpp"
#include "common/lcm_io/status_counter.hpp"

namespace limbcast::lcm_io {

inline constexpr const char* kStatusChannel = "MODULE_STATUS";

/// Microseconds since the Unix epoch by this host's clock.
std::int64_t utime_now();

/// Ends the program cleanly on SIGINT, SIGTERM and, unless it is ignored as under nohup, SIGHUP
/// (a closed terminal): they set what stop_requested() tells.
void install_signal_handlers();
bool stop_requested();
/// Ends Module::run as a signal does.
void request_stop();

/// A process of the chain: bus, log, a clean end on signals, and the status once a second from a
/// thread of its own, so that it goes out also while a message takes long.
///
///     Module module("segmenter", parser.common());
///     module.subscribe<point_cloud_t>(options.input, [&](const point_cloud_t& message) { ... });
///     module.run();
class Module {
 public:
  /// `name` as in the configuration file, e.g. "segmenter".
  /// Returns when the network is there.
  Module(const std::string& name, const config::CommonOptions& options);
  ~Module();
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  /// Frames (messages that begin with a stamp): of each sensor the newest only, so none that others
  /// overtook on the way; counted, and gaps in their sequence too. What the handler throws is
  /// logged and put in the status, and the module goes on.
  template <class Message>
  void subscribe_frames(const std::string& channel, std::function<void(const Message&)> handler) {
    check_channel(channel);
    const auto guarded_handler = [this, channel,
                                  handler = std::move(handler)](const Message& message) {
      if (!count_received(message.stamp)) return;
      guarded(channel, [&] { handler(message); });
    };
    bus_.subscribe<Message>(channel, Keep::kNewest, guarded_handler, &sensor_of);
  }
  /// What must not be skipped, such as a calibration.
  template <class Message>
  void subscribe_all(const std::string& channel, std::function<void(const Message&)> handler) {
    check_channel(channel);
    bus_.subscribe<Message>(channel, Keep::kAll,
                            [this, channel, handler = std::move(handler)](const Message& message) {
                              guarded(channel, [&] { handler(message); });
                            });
  }

  /// The result for a frame: counted, with its age, and numbered, so that whoever hears it can tell
  /// what was lost on the way from what this module or one before it left out. Returns the number.
  template <class Message>
  std::int64_t publish_frame(const std::string& channel, Message message) {
    message.stamp.sequence = next_sequence_[channel].get(message.stamp.sensor)++;
    publish(channel, message);
    count_published(message.stamp);
    pace_.published(message.stamp.sensor, message.stamp.utime, std::chrono::steady_clock::now());
    return message.stamp.sequence;
  }
  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    const std::string fault = channel_fault(channel);
    if (!fault.empty()) return report_problem("messages cannot be sent: " + fault);
    const std::string reason = bus_.publish(channel, message);
    if (!reason.empty())
      report_problem("messages cannot be sent: " + reason + "; check link and multicast route");
  }

  /// Takes up no more frames than the stage after this one gets done, which answers on `channel`
  /// (pace.hpp): what it would skip is not made.
  template <class Answer>
  void keep_pace_with(const std::string& channel) {
    subscribe_all<Answer>(channel, [this](const Answer& answer) {
      pace_.answered(answer.stamp.sensor, answer.stamp.utime);
    });
    bus_.set_gate([this] { return pace_.may_go_on(std::chrono::steady_clock::now()); });
  }

  /// Lets the stages after this one have the processor first, by five steps of nice(2) for each:
  /// they skip frames where it is short, and with a frame all that was spent on it before. A camera
  /// of 30 frames/s gives half as many poses again on two cores. To be called between subscribing
  /// and run(): LCM's thread must go on to read in time, or messages are lost. Who launches a
  /// module may add steps, or take some back.
  void give_way(int num_stages_after);

  /// Handles messages until a signal ends it.
  void run();
  /// For sources: handles what has come and returns at once.
  void spin_once() { bus_.handle(std::chrono::milliseconds(0)); }

  /// What a user wants to know besides, e.g. who told gravity; shown in the status.
  void set_note(const std::string& note);
  /// A problem that the module survives: logged when it is new, and shown in the status.
  void report_problem(const std::string& text);
  /// The problem of this text is over: logged, as it is when it comes again.
  void end_problem(const std::string& text);

 private:
  /// Why LCM takes no message for a channel of this name; empty: it does.
  static std::string channel_fault(const std::string& channel);
  /// Throws config::UsageError where it takes none.
  static void check_channel(const std::string& channel);
  bool count_received(const stamp_t& stamp);
  void count_published(const stamp_t& stamp);
  void guarded(const std::string& channel, const std::function<void()>& body);
  void on_malformed(const std::string& channel, const std::string& reason);
  /// Until the module ends.
  void send_statuses();
  void send_status(double period_s);
  module_status_t make_status(double period_s);

  std::string name_;
  Bus bus_;
  Pace pace_;
  std::map<std::string, BoundedMap<std::int64_t>> next_sequence_;  ///< channel, sensor
  std::atomic<bool> is_working_ = false;                           ///< a handler is
  std::mutex mutex_;                                               ///< of what follows
  std::condition_variable ends_;
  bool ending_ = false;
  StatusCounter counter_;
  std::string note_;
  std::string last_logged_problem_;
  std::thread statuses_;
};

}  // namespace limbcast::lcm_io
