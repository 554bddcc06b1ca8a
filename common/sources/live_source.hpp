#pragma once

#include <functional>

#include "common/sources/live_capture.hpp"
#include "common/sources/pair_source.hpp"

namespace limbcast {

/// What live sources share: how a captured pair becomes a frame.
class LivePairSource : public PairSource {
 public:
  bool live() const override { return true; }
  std::string problem() const override;

 protected:
  LivePairSource(std::string name, PairFormat format);

  /// Makes a frame of a pair. The first that does not fit the calibration throws InputError; a
  /// later one, of a camera that came back otherwise than it went, is dropped and is the source's
  /// problem until one fits again.
  std::optional<FramePair> frame_of(const std::function<CapturedPair()>& take);
  /// Of the cameras themselves.
  virtual std::string capture_problem() const = 0;

  const std::string& name() const { return name_; }
  /// Frames that a newer one replaced, or that did not fit.
  std::int64_t left_out() const { return left_out_; }
  void leave_out(std::size_t frames) { left_out_ += static_cast<std::int64_t>(frames); }

 private:
  FramePair make_frame(const CapturedPair& pair);

  std::string name_;
  PairFormat format_;
  std::int64_t sequence_ = 0, left_out_ = 0;
  std::string misfit_;
};

/// One camera: a picture holds all that there is of a frame.
class OneCameraSource : public LivePairSource {
 public:
  OneCameraSource(OpenReader open, const LiveCaptureParams& params, PairFormat format);

  std::optional<FramePair> next() override;
  bool ended() const override { return capture_.ended(); }
  std::optional<SourceStatistics> statistics() const override;

 private:
  virtual CapturedPair pair_of(const CapturedFrame& frame) const = 0;
  std::string capture_problem() const override { return capture_.statistics().problem; }

  LiveCapture capture_;
};

/// Both images in one picture, side by side.
class SideBySideSource : public OneCameraSource {
 public:
  using OneCameraSource::OneCameraSource;
  std::string description() const override { return name() + " (live, side by side)"; }

 private:
  CapturedPair pair_of(const CapturedFrame& frame) const override;
};

/// A depth camera that has no colour camera beside it: the first image is empty.
class DepthAloneSource : public OneCameraSource {
 public:
  using OneCameraSource::OneCameraSource;
  std::string description() const override { return name() + " (live, depth without colour)"; }

 private:
  CapturedPair pair_of(const CapturedFrame& frame) const override;
};

/// Two cameras, paired by the time of capture.
class TwoCameraSource : public LivePairSource {
 public:
  TwoCameraSource(OpenReader open_first, const LiveCaptureParams& first_params,
                  OpenReader open_second, const LiveCaptureParams& second_params, PairFormat format,
                  std::int64_t tolerance_us);

  std::optional<FramePair> next() override;
  bool ended() const override { return first_.ended() || second_.ended(); }
  std::optional<SourceStatistics> statistics() const override;
  std::string description() const override { return name() + " (live, paired by time)"; }

 private:
  std::string capture_problem() const override;

  LiveCapture first_, second_;
  PairMatcher matcher_;
};

}  // namespace limbcast
