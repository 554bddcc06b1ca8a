#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace limbcast {

/// Counted since the start.
struct SourceStatistics {
  std::int64_t dropped = 0;   ///< live frames that a newer one replaced before they were taken
  std::int64_t unpaired = 0;  ///< live frames of one camera without a partner in time
  std::int64_t reopened = 0;  ///< times that a camera was opened again
};

/// Where frames come from: a recording, a video, a sensor. Frame has a `stamp` and the `truth` of a
/// recording.
template <class Frame>
class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// The next frame. Nothing: at the end, or where a live source had none within 100 ms. Throws
  /// InputError for a frame that cannot be used.
  virtual std::optional<Frame> next() = 0;
  virtual bool ended() const = 0;
  /// Live: frames come when the sensor gives them. Else: as fast as they are asked for.
  virtual bool live() const = 0;
  /// Of a recording, once through; nothing where that is not known before its end.
  virtual std::optional<std::int64_t> num_frames() const { return std::nullopt; }
  /// Nothing where there is nothing to count.
  virtual std::optional<SourceStatistics> statistics() const { return std::nullopt; }
  /// What is wrong now with a live source, or with a recording that was read to its end; empty:
  /// nothing.
  virtual std::string problem() const { return ""; }
  /// For the log at start: what it is, how many frames.
  virtual std::string description() const = 0;
};

}  // namespace limbcast
