#pragma once

#include "common/sources/live_capture.hpp"
#include "common/sources/pair_source.hpp"

namespace limbcast {

/// Both images in one picture, side by side, from one camera.
class SideBySideSource : public PairSource {
 public:
  SideBySideSource(OpenReader open, const LiveCaptureParams& params, PairFormat format);

  std::optional<FramePair> next() override;
  bool ended() const override { return capture_.ended(); }
  bool live() const override { return true; }
  std::optional<SourceStatistics> statistics() const override;
  std::string problem() const override;
  std::string description() const override { return name_ + " (live, side by side)"; }

 private:
  std::string name_;
  PairFormat format_;
  LiveCapture capture_;
  std::int64_t sequence_ = 0;
  std::int64_t replaced_ = 0;
};

/// Two cameras, paired by the time of capture.
class TwoCameraSource : public PairSource {
 public:
  TwoCameraSource(OpenReader open_first, const LiveCaptureParams& first_params,
                  OpenReader open_second, const LiveCaptureParams& second_params, PairFormat format,
                  std::int64_t tolerance_us);

  std::optional<FramePair> next() override;
  bool ended() const override { return first_.ended() || second_.ended(); }
  bool live() const override { return true; }
  std::optional<SourceStatistics> statistics() const override;
  std::string problem() const override;
  std::string description() const override { return names_ + " (live, paired by time)"; }

 private:
  std::string names_;
  PairFormat format_;
  LiveCapture first_, second_;
  PairMatcher matcher_;
  std::int64_t sequence_ = 0;
  std::int64_t replaced_ = 0;
};

}  // namespace limbcast
