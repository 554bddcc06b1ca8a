#include "modules/calibrate/depth_input.hpp"

#include <algorithm>
#include <filesystem>
#include <limbcast/depth_images_t.hpp>
#include <optional>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/encoded_image.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_process.hpp"
#include "modules/calibrate/log_messages.hpp"
#include "modules/calibrate/pair_input.hpp"
#include "modules/depth_camera/frame_format.hpp"
#include "modules/depth_camera/registration.hpp"

namespace limbcast::calibrate {
namespace {

namespace fs = std::filesystem;

using TakeFrame = std::function<bool(const DepthImages&)>;

constexpr const char* kDepthChannel = "DEPTH_IMAGES";
constexpr const char* kStereoChannel = "STEREO_IMAGES";

bool holds_pictures(const std::string& folder, const std::string& name_end) {
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [&](const fs::directory_entry& entry) {
                       const std::string name = entry.path().stem();
                       return name.size() > name_end.size() &&
                              name.compare(name.size() - name_end.size(), name_end.size(),
                                           name_end) == 0;
                     });
}

void visit_depth_log(const std::string& log, const TakeFrame& take) {
  LogMessages<depth_images_t> frames(log, kDepthChannel);
  while (const auto frame = frames.next()) {
    if (!take(frame->images)) return;
  }
}

void visit_frames(const SourceOptions& options, const DepthCalibration& calibration,
                  const TakeFrame& take) {
  std::optional<depth_camera::DepthRegistration> registration;
  if (calibration.depth_camera) registration.emplace(calibration);
  visit_source(options, depth_camera::frame_format(calibration), [&](const FramePair& frame) {
    DepthImages images;
    images.depth = decode_image(frame.second, frame.second_name);
    if (registration) images.depth = registration->registered(images.depth);
    return take(images);
  });
}

}  // namespace

bool is_of_depth_camera(const std::string& source) {
  if (fs::is_directory(source))
    return holds_pictures(source, "_depth") && !holds_pictures(source, "_left");
  if (!is_lcm_log(source)) return false;
  lcm_io::LogReader reader(source);
  while (const auto event = reader.next()) {
    if (event->channel == kDepthChannel) return true;
    if (event->channel == kStereoChannel) return false;
  }
  return false;
}

void visit_depth_frames(const SourceOptions& options, const DepthCalibration& calibration,
                        const TakeFrame& take) {
  if (is_lcm_log(options.source))
    visit_depth_log(options.source, take);
  else
    visit_frames(options, calibration, take);
}

DepthCalibration find_depth_calibration(const std::string& path, const std::string& source) {
  if (!path.empty()) return read_depth_calibration(path);
  if (!is_lcm_log(source)) throw config::UsageError("--calibration is missing; see --help");
  if (const auto frame = LogMessages<depth_images_t>(source, kDepthChannel).next())
    return frame->calibration;
  throw InputError(source + ": holds no frame on " + kDepthChannel +
                   " that can be read; give the calibration with --calibration");
}

}  // namespace limbcast::calibrate
