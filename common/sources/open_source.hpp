#pragma once

#include <memory>
#include <string>

#include "common/sources/pair_source.hpp"
#include "common/sources/video_reader.hpp"

namespace limbcast {

/// Which source, and how it is used.
struct SourceOptions {
  std::string source;         ///< folder, video file or camera
  std::string second_source;  ///< camera or video of the second image; empty: see open_source
  double rate_hz = 0.0;       ///< 0: as recorded, of a folder without times kDefaultRate_hz
  std::int64_t start_utime =
      0;  ///< of the first frame of a folder without times or of a video [us]
  bool loop = false;
  int jpeg_quality = 95;  ///< of pictures that are no JPEG yet; OpenCV's own default
  CameraSettings camera;
  double pair_tolerance_ms =
      10.0;  ///< below half a frame at 30 frames/s, above any synchronised pair's
  double open_timeout_s = 10.0;  ///< a network camera takes some seconds
  double stall_timeout_s = 2.0;
  bool reopen = true;
};

inline constexpr double kDefaultRate_hz = 10.0;

/// Opens the source that `options.source` names: a folder, a video (one that holds both images side
/// by side, or two), or cameras (one side by side, or two); where none is named and the first image
/// is optional, the second camera alone. Throws InputError where that is not possible.
std::unique_ptr<PairSource> open_source(const SourceOptions& options, const PairFormat& format);

}  // namespace limbcast
