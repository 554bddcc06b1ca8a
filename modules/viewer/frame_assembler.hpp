#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "modules/viewer/view_frame.hpp"

namespace limbcast::viewer {

/// Puts the messages of one moment of one sensor together, in whatever order they come.
class FrameAssembler {
 public:
  /// `wait_frames`: a frame with poses is handed out once so many newer ones have begun, so that
  /// what comes late (truth) is in it; 0 for live views. A frame without poses is given up after
  /// kGiveUp.
  explicit FrameAssembler(int wait_frames) : wait_frames_(wait_frames) {}

  void add(Cloud cloud);
  void add(Segments segments);
  void add(BodyPoses poses);
  void add_truth(BodyPoses truth);

  /// The next frame that is ready, oldest first; frames of which only the truth came are dropped.
  std::optional<ViewFrame> next();
  /// At the end of a log: the next of the frames that are left.
  std::optional<ViewFrame> next_at_end();

 private:
  using Key = std::pair<std::int64_t, std::string>;  ///< utime, sensor
  /// Frames in the making; bounds the memory where poses never come.
  static constexpr int kGiveUp = 24;

  ViewFrame& frame_of(const Stamp& stamp);
  std::optional<ViewFrame> take(std::map<Key, ViewFrame>::iterator place);

  int wait_frames_;
  int num_taken_ = 0;
  std::map<Key, ViewFrame> frames_;
};

}  // namespace limbcast::viewer
