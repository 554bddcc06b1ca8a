#include "modules/viewer/frame_assembler.hpp"

#include <algorithm>

namespace limbcast::viewer {

ViewFrame& FrameAssembler::frame_of(const Stamp& stamp) {
  const Key key(stamp.utime, stamp.sensor);
  const auto known = std::find_if(frames_.begin(), frames_.end(),
                                  [&key](const Entry& entry) { return entry.key == key; });
  ViewFrame& frame = (known != frames_.end() ? *known : frames_.emplace_back(Entry{key, {}})).frame;
  // The chain finds gravity on the way; the truth's may be another one.
  if (frame.stamp.utime == 0) frame.stamp = stamp;
  return frame;
}

void FrameAssembler::add(Cloud cloud) {
  ViewFrame& frame = frame_of(cloud.stamp);
  frame.stamp = cloud.stamp;
  frame.cloud = std::move(cloud);
}

void FrameAssembler::add(Segments segments) {
  ViewFrame& frame = frame_of(segments.stamp);
  frame.segments = std::move(segments);
}

void FrameAssembler::add(BodyPoses poses) {
  ViewFrame& frame = frame_of(poses.stamp);
  frame.poses = std::move(poses);
}

void FrameAssembler::add_truth(BodyPoses truth) {
  ViewFrame& frame = frame_of(truth.stamp);
  frame.truth = std::move(truth);
}

std::optional<ViewFrame> FrameAssembler::take(std::list<Entry>::iterator place) {
  ViewFrame frame = std::move(place->frame);
  frames_.erase(place);
  if (!frame.cloud && !frame.segments && !frame.poses) return std::nullopt;
  frame.number = num_taken_++;
  return frame;
}

std::optional<ViewFrame> FrameAssembler::next() {
  while (static_cast<int>(frames_.size()) > kGiveUp) {
    if (auto frame = take(frames_.begin())) return frame;
  }
  for (auto place = frames_.begin(); place != frames_.end(); ++place) {
    if (place->frame.poses) return take(place);
  }
  return std::nullopt;
}

std::optional<ViewFrame> FrameAssembler::next_at_end() {
  while (!frames_.empty()) {
    if (auto frame = take(frames_.begin())) return frame;
  }
  return std::nullopt;
}

}  // namespace limbcast::viewer
