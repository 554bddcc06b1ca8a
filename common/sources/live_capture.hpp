#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/sources/pair_matcher.hpp"

namespace limbcast {

/// A camera that is open.
class FrameReader {
 public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;
  /// Waits for the next frame. Nothing: the camera failed, was unplugged or the stream ended; where
  /// it tells why it failed, throws InputError.
  virtual std::optional<CapturedFrame> read() = 0;
};

/// Opens the camera; throws InputError where that is not possible.
using OpenReader = std::function<std::unique_ptr<FrameReader>()>;

struct LiveCaptureParams {
  std::string name;  ///< of the camera, for problems
  /// Frames held for the taker; more push out the oldest. Few, because a frame that waits is late.
  std::size_t held_frames = 3;
  /// Without a frame for this long the camera counts as stalled.
  std::chrono::milliseconds stall_timeout{2000};
  /// Open a camera that failed or ended again, after this long each time.
  bool reopen = true;
  std::chrono::milliseconds reopen_interval{1000};
  /// The first opening must succeed or fail within this time.
  std::chrono::milliseconds open_timeout{10000};
};

struct CaptureStatistics {
  std::int64_t captured = 0, dropped = 0, reopened = 0;
  std::string problem;  ///< what is wrong now, empty = nothing
};

/// Reads a camera in a thread of its own, so that the newest frame is always at hand and a camera
/// that hangs does not hang the program.
class LiveCapture {
 public:
  /// Opens the camera. Throws what `open` throws, or InputError where it does not come back in
  /// time.
  LiveCapture(OpenReader open, LiveCaptureParams params);
  /// Ends the thread; one that hangs in the driver is left behind.
  ~LiveCapture();
  LiveCapture(const LiveCapture&) = delete;
  LiveCapture& operator=(const LiveCapture&) = delete;

  /// Frames that came since the last call, the oldest first; waits for one, at most `timeout`.
  std::vector<CapturedFrame> take(std::chrono::milliseconds timeout);
  CaptureStatistics statistics() const;
  /// The camera ended, and is not to be opened again; all frames are taken.
  bool ended() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace limbcast
