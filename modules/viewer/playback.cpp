#include "modules/viewer/playback.hpp"

#include <algorithm>

namespace limbcast::viewer {

void Playback::apply(Command command) {
  switch (command) {
    case Command::kPause:
      // From the last frame there is nothing to go on to but the first.
      if (paused_ && frame_ == num_frames_ - 1) frame_ = 0;
      paused_ = !paused_;
      return;
    case Command::kNext:
      return seek(frame_ + 1);
    case Command::kPrevious:
      return seek(frame_ - 1);
    case Command::kForward:
      return seek(frame_ + kStride);
    case Command::kBack:
      return seek(frame_ - kStride);
    case Command::kFirst:
      return seek(0);
    case Command::kLast:
      return seek(num_frames_ - 1);
    case Command::kQuit:
      ended_ = true;
      return;
  }
}

void Playback::seek(int frame) {
  frame_ = std::clamp(frame, 0, std::max(0, num_frames_ - 1));
  paused_ = true;
}

void Playback::advance() {
  if (paused_) return;
  if (frame_ + 1 < num_frames_)
    ++frame_;
  else
    paused_ = true;
}

}  // namespace limbcast::viewer
