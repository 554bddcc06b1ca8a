#pragma once

namespace limbcast::viewer {

/// What a user can ask for while frames are shown.
enum class Command { kPause, kNext, kPrevious, kForward, kBack, kFirst, kLast, kQuit };

/// Which frame of a log is to be shown. Knows neither window nor clock.
class Playback {
 public:
  /// How far kForward and kBack go [frames].
  static constexpr int kStride = 10;

  explicit Playback(int num_frames) : num_frames_(num_frames) {}

  void apply(Command command);
  /// To a frame, as the slider does; the nearest one where there is none of that number. Pauses.
  void seek(int frame);
  /// The frame was shown for its time: goes on where it plays, and pauses at the last.
  void advance();

  int frame() const { return frame_; }
  bool paused() const { return paused_; }
  bool ended() const { return ended_; }

 private:
  int num_frames_;
  int frame_ = 0;
  bool paused_ = false, ended_ = false;
};

}  // namespace limbcast::viewer
