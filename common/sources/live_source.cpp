#include "common/sources/live_source.hpp"

#include <utility>

#include "common/input_error.hpp"
#include "common/sources/video_source.hpp"

namespace limbcast {
namespace {

constexpr std::chrono::milliseconds kLongestWait{100};

}  // namespace

LivePairSource::LivePairSource(std::string name, PairFormat format)
    : name_(std::move(name)), format_(std::move(format)) {}

FramePair LivePairSource::make_frame(const CapturedPair& pair) {
  FramePair frame;
  frame.first = coded_for_sending(pair.first, format_.jpeg_quality);
  frame.second = coded_for_sending(pair.second, format_.jpeg_quality);
  check_pair(format_, frame.first, frame.second, name_);
  frame.stamp.utime = pair.utime;
  frame.stamp.sequence = sequence_++;
  frame.stamp.sensor = format_.sensor;
  frame.stamp.frame = format_.frame;
  return frame;
}

std::optional<FramePair> LivePairSource::frame_of(const std::function<CapturedPair()>& take) {
  try {
    FramePair frame = make_frame(take());
    misfit_.clear();
    return frame;
  } catch (const InputError& error) {
    const bool fitted_before = sequence_ > 0;
    if (!fitted_before) throw;
    misfit_ = error.what();
    leave_out(1);
    return std::nullopt;
  }
}

std::string LivePairSource::problem() const {
  const std::string of_capture = capture_problem();
  return of_capture.empty() ? misfit_ : of_capture;
}

OneCameraSource::OneCameraSource(OpenReader open, const LiveCaptureParams& params,
                                 PairFormat format)
    : LivePairSource(params.name, std::move(format)), capture_(std::move(open), params) {}

std::optional<FramePair> OneCameraSource::next() {
  const std::vector<CapturedFrame> frames = capture_.take(kLongestWait);
  if (frames.empty()) return std::nullopt;
  leave_out(frames.size() - 1);
  return frame_of([&] { return pair_of(frames.back()); });
}

std::optional<SourceStatistics> OneCameraSource::statistics() const {
  const CaptureStatistics capture = capture_.statistics();
  return SourceStatistics{capture.dropped + left_out(), 0, capture.reopened};
}

CapturedPair SideBySideSource::pair_of(const CapturedFrame& frame) const {
  auto [first, second] = split_side_by_side(plain_pixels(frame.picture, name()), name());
  return {frame.utime, {first}, {second}};
}

CapturedPair DepthAloneSource::pair_of(const CapturedFrame& frame) const {
  return {frame.utime, {}, frame.picture};
}

TwoCameraSource::TwoCameraSource(OpenReader open_first, const LiveCaptureParams& first_params,
                                 OpenReader open_second, const LiveCaptureParams& second_params,
                                 PairFormat format, std::int64_t tolerance_us)
    : LivePairSource(first_params.name + " and " + second_params.name, std::move(format)),
      first_(std::move(open_first), first_params),
      second_(std::move(open_second), second_params),
      matcher_(tolerance_us) {}

std::optional<FramePair> TwoCameraSource::next() {
  for (CapturedFrame& frame : first_.take(kLongestWait / 2)) matcher_.add_first(std::move(frame));
  for (CapturedFrame& frame : second_.take(kLongestWait / 2)) matcher_.add_second(std::move(frame));
  std::optional<CapturedPair> newest;
  while (std::optional<CapturedPair> pair = matcher_.take()) {
    if (newest) leave_out(1);
    newest = std::move(pair);
  }
  if (!newest) return std::nullopt;
  return frame_of([&] { return std::move(*newest); });
}

std::optional<SourceStatistics> TwoCameraSource::statistics() const {
  const CaptureStatistics first = first_.statistics();
  const CaptureStatistics second = second_.statistics();
  return SourceStatistics{first.dropped + second.dropped + left_out(), matcher_.unpaired(),
                          first.reopened + second.reopened};
}

std::string TwoCameraSource::capture_problem() const {
  const std::string first = first_.statistics().problem;
  return first.empty() ? second_.statistics().problem : first;
}

}  // namespace limbcast
