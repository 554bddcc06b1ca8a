#include "common/sources/folder_source.hpp"

#include <utility>

#include "common/human_model/ground_truth_json.hpp"

namespace limbcast {
namespace {

Recording find_frames(const std::string& folder, const PairFormat& format, RecordingParams params) {
  params.first_is_optional = format.first_is_optional;
  return find_recording(folder, format.names, params);
}

}  // namespace

FolderSource::FolderSource(std::string folder, PairFormat format, const FolderParams& params)
    : folder_(std::move(folder)),
      format_(std::move(format)),
      loop_(params.loop),
      recording_(find_frames(folder_, format_, params.recording)) {
  round_duration_us_ = round_duration_us(recording_, params.recording.rate_hz);
}

std::optional<FramePair> FolderSource::next() {
  if (ended()) return std::nullopt;
  FramePair frame = read(recording_.frames[index_]);
  step();
  return frame;
}

FramePair FolderSource::read(const RecordedFrame& recorded) const {
  FramePair frame;
  if (!recorded.first_path.empty()) frame.first = read_encoded_image(recorded.first_path);
  frame.second = read_encoded_image(recorded.second_path);
  check_8_bit(frame.first, recorded.first_path);
  if (!format_.second_is_depth) check_8_bit(frame.second, recorded.second_path);
  check_pair(format_, frame.first, frame.second, folder_ + "/" + recorded.time.name);
  frame.first =
      coded_for_sending(std::move(frame.first), format_.jpeg_quality, recorded.first_path);
  frame.second =
      coded_for_sending(std::move(frame.second), format_.jpeg_quality, recorded.second_path);
  frame.second_name = recorded.second_path;

  frame.stamp.utime = recorded.time.utime + loop_offset_us_;
  frame.stamp.sequence = sequence_;
  frame.stamp.sensor = format_.sensor;
  frame.stamp.frame = format_.frame;
  if (recorded.time.down) {
    frame.stamp.gravity.down = *recorded.time.down;
    frame.stamp.gravity.source = GravitySource::kRecording;
  }
  if (!recorded.truth_path.empty()) {
    frame.truth = read_truth_of(frame.stamp, recorded.truth_path);
  }
  return frame;
}

void FolderSource::step() {
  ++sequence_;
  ++index_;
  if (loop_ && ended()) {
    index_ = 0;
    loop_offset_us_ += round_duration_us_;
  }
}

std::string FolderSource::description() const {
  std::string text = folder_ + ": " + std::to_string(recording_.frames.size()) +
                     " frames, times from " +
                     (recording_.has_timestamps ? "timestamps.csv" : "the rate");
  if (recording_.frames_without_time > 0) {
    text.append("; left out, as it does not name them: ")
        .append(std::to_string(recording_.frames_without_time));
  }
  return text;
}

}  // namespace limbcast
