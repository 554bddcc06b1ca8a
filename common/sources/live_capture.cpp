#include "common/sources/live_capture.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "common/input_error.hpp"

namespace limbcast {
namespace {

using Clock = std::chrono::steady_clock;

/// A driver that does not come back within this time is left behind.
constexpr std::chrono::milliseconds kEndTimeout{300};

}  // namespace

/// Belongs to the object and to its thread, which may outlive it.
struct LiveCapture::Shared {
  Shared(OpenReader open_reader, LiveCaptureParams capture_params)
      : open(std::move(open_reader)), params(std::move(capture_params)) {}

  /// The thread's work.
  void run();
  std::unique_ptr<FrameReader> try_open();
  void read_until_failure(FrameReader& reader);
  bool told_to_stop() const;
  void hold(CapturedFrame frame);
  bool wait_before_reopening();

  const OpenReader open;
  const LiveCaptureParams params;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<CapturedFrame> frames;
  CaptureStatistics statistics;
  Clock::time_point last_frame_at = Clock::now();
  std::exception_ptr first_open_error;
  bool opened = false;    ///< the first opening came back
  bool stopping = false;  ///< the thread shall end
  bool finished = false;  ///< the thread ended
};

std::unique_ptr<FrameReader> LiveCapture::Shared::try_open() {
  std::unique_ptr<FrameReader> reader;
  std::exception_ptr error;
  std::string problem;
  try {
    reader = open();
  } catch (const std::exception& failure) {
    error = std::current_exception();
    problem = failure.what();
  }
  const std::lock_guard lock(mutex);
  if (!opened) first_open_error = error;
  // A camera that opens again may still give nothing: only a frame ends the problem.
  if (!reader) statistics.problem = problem;
  if (opened && reader) ++statistics.reopened;
  opened = true;
  last_frame_at = Clock::now();
  changed.notify_all();
  return reader;
}

bool LiveCapture::Shared::told_to_stop() const {
  const std::lock_guard lock(mutex);
  return stopping;
}

void LiveCapture::Shared::hold(CapturedFrame frame) {
  const std::lock_guard lock(mutex);
  frames.push_back(std::move(frame));
  ++statistics.captured;
  statistics.problem.clear();
  if (frames.size() > params.held_frames) {
    frames.pop_front();
    ++statistics.dropped;
  }
  last_frame_at = Clock::now();
  changed.notify_all();
}

void LiveCapture::Shared::read_until_failure(FrameReader& reader) {
  std::string problem = params.name + ": gives no frames any more (unplugged or ended)";
  try {
    while (!told_to_stop()) {
      std::optional<CapturedFrame> frame = reader.read();
      if (!frame) break;
      hold(std::move(*frame));
    }
  } catch (const InputError& failure) {
    problem = failure.what();
  }
  const std::lock_guard lock(mutex);
  statistics.problem = problem;
}

/// False: there is nothing more to do.
bool LiveCapture::Shared::wait_before_reopening() {
  std::unique_lock lock(mutex);
  if (!params.reopen || first_open_error) return false;
  changed.wait_for(lock, params.reopen_interval, [this] { return stopping; });
  return !stopping;
}

void LiveCapture::Shared::run() {
  do {
    const std::unique_ptr<FrameReader> reader = try_open();
    if (reader) read_until_failure(*reader);
  } while (wait_before_reopening());
  const std::lock_guard lock(mutex);
  finished = true;
  changed.notify_all();
}

LiveCapture::LiveCapture(OpenReader open, LiveCaptureParams params)
    : shared_(std::make_shared<Shared>(std::move(open), std::move(params))) {
  std::thread([shared = shared_] { shared->run(); }).detach();
  std::unique_lock lock(shared_->mutex);
  const bool came_back = shared_->changed.wait_for(lock, shared_->params.open_timeout,
                                                   [this] { return shared_->opened; });
  if (came_back && !shared_->first_open_error) return;
  shared_->stopping = true;
  if (shared_->first_open_error) std::rethrow_exception(shared_->first_open_error);
  throw InputError(shared_->params.name +
                   ": did not open in time; does it play in gst-launch-1.0 or ffplay?");
}

LiveCapture::~LiveCapture() {
  std::unique_lock lock(shared_->mutex);
  shared_->stopping = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kEndTimeout, [this] { return shared_->finished; });
}

std::vector<CapturedFrame> LiveCapture::take(std::chrono::milliseconds timeout) {
  std::unique_lock lock(shared_->mutex);
  shared_->changed.wait_for(lock, timeout,
                            [this] { return !shared_->frames.empty() || shared_->finished; });
  std::vector<CapturedFrame> taken(std::make_move_iterator(shared_->frames.begin()),
                                   std::make_move_iterator(shared_->frames.end()));
  shared_->frames.clear();
  return taken;
}

CaptureStatistics LiveCapture::statistics() const {
  const std::lock_guard lock(shared_->mutex);
  CaptureStatistics statistics = shared_->statistics;
  const auto silent_for = Clock::now() - shared_->last_frame_at;
  if (statistics.problem.empty() && silent_for >= shared_->params.stall_timeout) {
    statistics.problem = shared_->params.name + ": stalled, no frame for " +
                         std::to_string(shared_->params.stall_timeout.count()) + " ms";
  }
  return statistics;
}

bool LiveCapture::ended() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->finished && shared_->frames.empty();
}

}  // namespace limbcast
