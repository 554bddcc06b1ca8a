#include "common/sources/open_source.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/input_error.hpp"
#include "common/sources/folder_source.hpp"
#include "common/sources/live_source.hpp"
#include "common/sources/video_source.hpp"

namespace limbcast {
namespace {

namespace fs = std::filesystem;

std::chrono::milliseconds milliseconds_of(double seconds) {
  return std::chrono::milliseconds(std::llround(1000.0 * seconds));
}

LiveCaptureParams capture_params(const SourceOptions& options, const std::string& name) {
  LiveCaptureParams params;
  params.name = name;
  params.reopen = options.reopen;
  params.stall_timeout = milliseconds_of(options.stall_timeout_s);
  params.open_timeout = milliseconds_of(options.open_timeout_s);
  return params;
}

OpenReader opener(const std::string& source, const CameraSettings& settings) {
  return [source, settings] { return open_camera(source, settings); };
}

/// Asks a camera for the size that the calibration is for.
CameraSettings calibrated(CameraSettings settings, int width, int height) {
  settings.calibrated_width = width;
  settings.calibrated_height = height;
  return settings;
}

OpenReader opener_of_second(const SourceOptions& options, const PairFormat& format) {
  const bool own_size = format.second_width > 0;
  CameraSettings settings =
      calibrated(options.camera, own_size ? format.second_width : format.width,
                 own_size ? format.second_height : format.height);
  settings.raw_depth = format.second_is_depth;
  // Depth has formats of its own.
  if (format.second_is_depth) settings.format.clear();
  return opener(options.second_source, settings);
}

std::unique_ptr<PairSource> open_cameras(const SourceOptions& options, const PairFormat& format) {
  if (!options.second_source.empty()) {
    return std::make_unique<TwoCameraSource>(
        opener(options.source, calibrated(options.camera, format.width, format.height)),
        capture_params(options, options.source), opener_of_second(options, format),
        capture_params(options, options.second_source), format,
        std::llround(1000.0 * options.pair_tolerance_ms));
  }
  if (format.second_is_depth) {
    throw InputError(options.source +
                     ": is one camera; give the depth camera with --source-depth, and leave "
                     "--source out where there is no colour camera");
  }
  return std::make_unique<SideBySideSource>(
      opener(options.source, calibrated(options.camera, 2 * format.width, format.height)),
      capture_params(options, options.source), format);
}

std::unique_ptr<PairSource> open_depth_alone(const SourceOptions& options,
                                             const PairFormat& format) {
  if (!is_camera(options.second_source)) {
    throw InputError(options.second_source +
                     ": is no camera; give a folder of depth pictures with --source");
  }
  return std::make_unique<DepthAloneSource>(opener_of_second(options, format),
                                            capture_params(options, options.second_source), format);
}

}  // namespace

std::unique_ptr<PairSource> open_source(const SourceOptions& options, const PairFormat& format) {
  if (options.source.empty() && format.first_is_optional) return open_depth_alone(options, format);
  if (is_camera(options.source)) return open_cameras(options, format);
  const double rate_hz = options.rate_hz > 0.0 ? options.rate_hz : kDefaultRate_hz;
  if (fs::is_directory(options.source)) {
    return std::make_unique<FolderSource>(
        options.source, format, FolderParams{{rate_hz, options.start_utime}, options.loop});
  }
  if (!fs::exists(options.source)) {
    throw InputError(
        options.source +
        ": does not exist; give a folder of pictures, an LCM log, a video file, /dev/videoN, "
        "gst:PIPELINE or a stream's URL");
  }
  // By its ending: a stream of MJPEG begins as a picture does.
  if (cv::haveImageWriter(options.source)) {
    throw InputError(options.source +
                     ": is one picture; give its folder, an LCM log, a video file or a camera");
  }
  if (format.second_is_depth) {
    throw InputError(options.source + ": is neither a folder nor an LCM log, and videos cannot " +
                     "hold 16-bit depth; give a folder of pictures, a log or cameras");
  }
  return std::make_unique<VideoSource>(
      options.source, options.second_source, format,
      VideoParams{options.rate_hz, options.start_utime, options.loop});
}

}  // namespace limbcast
