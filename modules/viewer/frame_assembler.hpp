#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <utility>

#include "modules/viewer/view_frame.hpp"

namespace limbcast::viewer {

/// Puts the messages of one moment of one sensor together, in whatever order they come.
class FrameAssembler {
 public:
  void add(Cloud cloud);
  void add(Segments segments);
  void add(BodyPoses poses);
  void add_truth(BodyPoses truth);

  /// The next frame that is ready, the one that came first: one with poses, or one for whose poses
  /// it waited too long. Frames of which only the truth came are dropped.
  std::optional<ViewFrame> next();
  /// Where nothing more comes: the next of the frames that are left.
  std::optional<ViewFrame> next_at_end();

 private:
  using Key = std::pair<std::int64_t, std::string>;  ///< utime, sensor
  struct Entry {
    Key key;
    ViewFrame frame;
  };
  /// Frames in the making; bounds the memory where poses never come.
  static constexpr int kGiveUp = 24;

  ViewFrame& frame_of(const Stamp& stamp);
  std::optional<ViewFrame> take(std::list<Entry>::iterator place);

  int num_taken_ = 0;
  /// As they came: the times of a recording that is played again jump back.
  std::list<Entry> frames_;
};

}  // namespace limbcast::viewer
