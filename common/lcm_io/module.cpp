#include "common/lcm_io/module.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "common/config/log.hpp"
#include "common/config/version.hpp"
#include "common/formatted.hpp"
#include "common/lcm_io/module_status_codec.hpp"

namespace limbcast::lcm_io {
namespace {

constexpr std::chrono::milliseconds kStatusPeriod{1000};
/// How long the module may take to see a signal.
constexpr std::chrono::milliseconds kWait{50};

constexpr const char* kWaiting = "waiting";

volatile std::sig_atomic_t g_stop_requested = 0;

static_assert(config::kLongestChannel == LCM_MAX_CHANNEL_NAME_LENGTH);

void on_signal(int /*signal*/) { g_stop_requested = 1; }

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

/// Images and clouds are freed with each frame and needed again with the next: given back to the
/// system in between, their pages are cleared anew, a tenth of the whole chain's time.
void keep_freed_memory() {
  constexpr int kLargestKept_bytes = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestKept_bytes);
  mallopt(M_TRIM_THRESHOLD, kLargestKept_bytes);
}

/// While it lives, a message is worked on.
class Working {
 public:
  explicit Working(std::atomic<bool>& is_working) : is_working_(is_working) { is_working_ = true; }
  ~Working() { is_working_ = false; }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

 private:
  std::atomic<bool>& is_working_;
};

/// Until signals are handled they end a module that waits here, as they should.
const std::string& url_of_network(const std::string& name, const config::CommonOptions& options) {
  config::configure_log(name, options.log_level);
  wait_for_network(options.lcm_url);
  return options.lcm_url;
}

std::string age_text(float age_ms) {
  if (std::isnan(age_ms)) return "nothing sent";
  return is_age_of_live_data(age_ms) ? formatted("age p50 %.1f ms", age_ms) : "recorded data";
}

std::string summary(const module_status_t& status) {
  return formatted("%.1f frames/s in, %.1f out, %s, %lld lost, %lld skipped, %lld malformed",
                   status.rate_in_hz, status.rate_out_hz, age_text(status.latency_p50_ms).c_str(),
                   static_cast<long long>(status.num_lost),
                   static_cast<long long>(status.num_skipped),
                   static_cast<long long>(status.num_malformed));
}

}  // namespace

std::int64_t utime_now() {
  using namespace std::chrono;
  return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  // nohup has it ignored, so that the program outlives its terminal.
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool stop_requested() { return g_stop_requested != 0; }

void request_stop() { g_stop_requested = 1; }

Module::Module(const std::string& name, const config::CommonOptions& options)
    : name_(name), bus_(url_of_network(name, options)) {
  keep_freed_memory();
  install_signal_handlers();
  // Whoever read the log may leave; the poses go on.
  std::signal(SIGPIPE, SIG_IGN);
  bus_.set_on_malformed([this](const std::string& channel, const std::string& reason) {
    on_malformed(channel, reason);
  });
  config::log(config::LogLevel::kInfo,
              std::string("version ") + config::kVersion + " on " + effective_url(options.lcm_url));
  statuses_ = std::thread([this] { send_statuses(); });
}

Module::~Module() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ends_.notify_all();
  statuses_.join();
}

void Module::give_way(int num_stages_after) {
  constexpr int kStepsPerStage = 5;
  errno = 0;
  if (nice(kStepsPerStage * num_stages_after) == -1 && errno != 0)
    config::log(config::LogLevel::kWarning,
                std::string("stays at its priority: ") + std::strerror(errno));
}

void Module::run() {
  while (!stop_requested()) bus_.handle(kWait);
  config::log(config::LogLevel::kInfo, "ends");
}

void Module::send_statuses() {
  std::unique_lock lock(mutex_);
  auto last = std::chrono::steady_clock::now();
  while (!ends_.wait_until(lock, last + kStatusPeriod, [this] { return ending_; })) {
    lock.unlock();
    const auto now = std::chrono::steady_clock::now();
    send_status(std::chrono::duration<double>(now - last).count());
    last = now;
    lock.lock();
  }
}

std::string Module::channel_fault(const std::string& channel) {
  if (!channel.empty() && channel.size() <= config::kLongestChannel) return "";
  return "channel '" + channel + "' has " + std::to_string(channel.size()) +
         " characters, LCM takes 1 to " + std::to_string(config::kLongestChannel) +
         "; choose another name";
}

void Module::check_channel(const std::string& channel) {
  const std::string fault = channel_fault(channel);
  if (!fault.empty()) throw config::UsageError(fault);
}

bool Module::count_received(const stamp_t& stamp) {
  const std::lock_guard lock(mutex_);
  return counter_.received(stamp.sensor, stamp.sequence);
}

void Module::count_published(const stamp_t& stamp) {
  const std::lock_guard lock(mutex_);
  counter_.published(stamp.utime, utime_now());
}

void Module::set_note(const std::string& note) {
  const std::lock_guard lock(mutex_);
  note_ = note;
}

void Module::guarded(const std::string& channel, const std::function<void()>& body) {
  const Working working(is_working_);
  try {
    body();
  } catch (const MessageError&) {
    throw;
  } catch (const std::exception& error) {
    report_problem(channel + ": " + error.what());
  }
}

void Module::report_problem(const std::string& text) {
  const std::lock_guard lock(mutex_);
  counter_.failed(text);
  // A fault that repeats with every frame would bury the log; the status goes on telling it.
  if (text != last_logged_problem_) config::log(config::LogLevel::kError, text);
  last_logged_problem_ = text;
}

void Module::end_problem(const std::string& text) {
  const std::lock_guard lock(mutex_);
  config::log(config::LogLevel::kInfo, "over: " + text);
  last_logged_problem_.clear();
}

void Module::on_malformed(const std::string& channel, const std::string& reason) {
  const std::string text = channel + ": message dropped: " + reason;
  const std::lock_guard lock(mutex_);
  counter_.malformed(text);
  if (text != last_logged_problem_) config::log(config::LogLevel::kWarning, text);
  last_logged_problem_ = text;
}

module_status_t Module::make_status(double period_s) {
  const std::lock_guard lock(mutex_);
  const StatusCounter::Period period = counter_.finish_period(period_s);
  module_status_t status{};
  status.utime = utime_now();
  status.module = name_;
  status.host = host_name();
  status.pid = static_cast<std::int32_t>(getpid());
  status.version = config::kVersion;
  const bool idle = period.rate_in_hz == 0.0F && period.rate_out_hz == 0.0F && !is_working_;
  status.state = period.failing ? "failing" : idle ? kWaiting : "running";
  status.rate_in_hz = period.rate_in_hz;
  status.rate_out_hz = period.rate_out_hz;
  status.latency_p50_ms = period.latency_p50_ms;
  status.latency_p99_ms = period.latency_p99_ms;
  status.latency_max_ms = period.latency_max_ms;
  status.num_received = counter_.num_received();
  status.num_published = counter_.num_published();
  status.num_skipped = bus_.skipped() + counter_.num_late();
  status.num_lost = std::max<std::int64_t>(0, counter_.num_gaps() - bus_.skipped());
  status.num_malformed = counter_.num_malformed();
  status.last_error = counter_.last_error();
  status.note = note_;
  return status;
}

void Module::send_status(double period_s) {
  const module_status_t status = make_status(period_s);
  // Logged first: whoever hears the status may end the program, whose last line is another.
  if (status.state != kWaiting) config::log(config::LogLevel::kInfo, summary(status));
  publish(kStatusChannel, status);
}

}  // namespace limbcast::lcm_io
