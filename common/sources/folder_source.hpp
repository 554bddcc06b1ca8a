#pragma once

#include "common/sources/pair_source.hpp"

namespace limbcast {

struct FolderParams {
  RecordingParams recording;
  bool loop = false;  ///< start again at the end; times and sequence numbers go on rising
};

/// A recorded folder (find_recording). JPEG and depth files are handed on byte by byte; truth
/// beside a frame comes with it.
class FolderSource : public PairSource {
 public:
  FolderSource(std::string folder, PairFormat format, const FolderParams& params);

  std::optional<FramePair> next() override;
  bool ended() const override { return index_ >= recording_.frames.size(); }
  bool live() const override { return false; }
  std::optional<std::int64_t> num_frames() const override {
    return static_cast<std::int64_t>(recording_.frames.size());
  }
  std::string description() const override;

 private:
  FramePair read(const RecordedFrame& frame) const;
  void step();

  std::string folder_;
  PairFormat format_;
  bool loop_;
  Recording recording_;
  std::size_t index_ = 0;
  std::int64_t sequence_ = 0;
  std::int64_t loop_offset_us_ = 0;
  std::int64_t round_duration_us_ = 0;
};

}  // namespace limbcast
