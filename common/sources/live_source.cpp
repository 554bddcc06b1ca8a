#include "common/sources/live_source.hpp"

#include <utility>

#include "common/sources/video_source.hpp"

namespace limbcast {
namespace {

constexpr std::chrono::milliseconds kLongestWait{100};

FramePair make_frame(const PairFormat& format, const CapturedPair& pair, std::int64_t sequence,
                     const std::string& where) {
  FramePair frame;
  frame.first = coded_for_sending(pair.first, format.jpeg_quality);
  frame.second = coded_for_sending(pair.second, format.jpeg_quality);
  check_pair(format, frame.first, frame.second, where);
  frame.stamp.utime = pair.utime;
  frame.stamp.sequence = sequence;
  frame.stamp.sensor = format.sensor;
  frame.stamp.frame = format.frame;
  return frame;
}

}  // namespace

SideBySideSource::SideBySideSource(OpenReader open, const LiveCaptureParams& params,
                                   PairFormat format)
    : name_(params.name), format_(std::move(format)), capture_(std::move(open), params) {}

std::optional<FramePair> SideBySideSource::next() {
  const std::vector<CapturedFrame> frames = capture_.take(kLongestWait);
  if (frames.empty()) return std::nullopt;
  replaced_ += static_cast<std::int64_t>(frames.size()) - 1;
  const CapturedFrame& newest = frames.back();
  auto [first, second] = split_side_by_side(plain_pixels(newest.picture, name_), name_);
  return make_frame(format_, {newest.utime, {first}, {second}}, sequence_++, name_);
}

std::optional<SourceStatistics> SideBySideSource::statistics() const {
  const CaptureStatistics capture = capture_.statistics();
  return SourceStatistics{capture.dropped + replaced_, 0, capture.reopened};
}

std::string SideBySideSource::problem() const { return capture_.statistics().problem; }

TwoCameraSource::TwoCameraSource(OpenReader open_first, const LiveCaptureParams& first_params,
                                 OpenReader open_second, const LiveCaptureParams& second_params,
                                 PairFormat format, std::int64_t tolerance_us)
    : names_(first_params.name + " and " + second_params.name),
      format_(std::move(format)),
      first_(std::move(open_first), first_params),
      second_(std::move(open_second), second_params),
      matcher_(tolerance_us) {}

std::optional<FramePair> TwoCameraSource::next() {
  for (CapturedFrame& frame : first_.take(kLongestWait / 2)) matcher_.add_first(std::move(frame));
  for (CapturedFrame& frame : second_.take(kLongestWait / 2)) matcher_.add_second(std::move(frame));
  std::optional<CapturedPair> newest;
  while (std::optional<CapturedPair> pair = matcher_.take()) {
    if (newest) ++replaced_;
    newest = std::move(pair);
  }
  if (!newest) return std::nullopt;
  return make_frame(format_, *newest, sequence_++, names_);
}

std::optional<SourceStatistics> TwoCameraSource::statistics() const {
  const CaptureStatistics first = first_.statistics();
  const CaptureStatistics second = second_.statistics();
  return SourceStatistics{first.dropped + second.dropped + replaced_, matcher_.unpaired(),
                          first.reopened + second.reopened};
}

std::string TwoCameraSource::problem() const {
  const std::string first = first_.statistics().problem;
  return first.empty() ? second_.statistics().problem : first;
}

}  // namespace limbcast
