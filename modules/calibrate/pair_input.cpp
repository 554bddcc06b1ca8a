#include "modules/calibrate/pair_input.hpp"

#include <algorithm>
#include <filesystem>
#include <limbcast/stereo_calibration_t.hpp>
#include <limbcast/stereo_images_t.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <tuple>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/encoded_image.hpp"
#include "common/config/log.hpp"
#include "common/formatted.hpp"
#include "common/lcm_io/module.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_process.hpp"
#include "modules/calibrate/log_messages.hpp"
#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::calibrate {
namespace {

using Take = std::function<bool(const GreyPair&)>;

const FilePair kNames{"left", "right"};
constexpr const char* kImagesChannel = "STEREO_IMAGES";
constexpr const char* kCalibrationChannel = "STEREO_CALIBRATION";

cv::Mat grey(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat result;
  cv::cvtColor(image, result, cv::COLOR_BGR2GRAY);
  return result;
}

/// Before it is decoded: one that no module takes may be larger than the memory.
void check_no_larger_than_modules_take(const EncodedImage& image, const std::string& path) {
  if (std::max(image.width, image.height) <= kMaxImageSide) return;
  throw InputError(path + ": is " + size_text(image.width, image.height) + ", at most " +
                   std::to_string(kMaxImageSide) + " px a side; take smaller pictures");
}

void visit_folder(const std::string& folder, const Take& take) {
  for (const RecordedFrame& frame : find_recording(folder, kNames, {}).frames) {
    const EncodedImage left = read_encoded_image(frame.first_path);
    const EncodedImage right = read_encoded_image(frame.second_path);
    for (const auto& [image, path] :
         {std::pair(&left, &frame.first_path), {&right, &frame.second_path}}) {
      check_8_bit(*image, *path);
      check_no_larger_than_modules_take(*image, *path);
    }
    check_not_told_to_end();
    if (!take({frame.time.name, decode_grey(left, frame.first_path),
               decode_grey(right, frame.second_path)}))
      return;
  }
}

[[noreturn]] void fail_without_pairs(const std::string& log) {
  throw InputError(log + ": holds no pairs on " + kImagesChannel +
                   "; was limbcast-stereo-camera running?");
}

void visit_log(const std::string& log, const Take& take) {
  LogMessages<stereo_images_t> pairs(log, kImagesChannel);
  bool found = false;
  while (const auto images = pairs.next()) {
    found = true;
    const std::int64_t utime = images->stamp.utime;
    if (!take({std::to_string(utime), grey(images->left), grey(images->right), utime})) return;
  }
  if (!found) fail_without_pairs(log);
}

/// Tells what is wrong with a camera, once until it is well again.
class ProblemLog {
 public:
  void tell(const std::string& problem) {
    if (problem != told_ && !problem.empty()) config::log(config::LogLevel::kWarning, problem);
    told_ = problem;
  }

 private:
  std::string told_;
};

void visit_stream(const SourceOptions& options, const Take& take) {
  PairFormat format;
  format.names = kNames;
  format.jpeg_quality = 0;  // without loss: corners are wanted to a tenth of a pixel
  visit_source(options, format, [&](const FramePair& frame) {
    const std::string name = "frame " + std::to_string(frame.stamp.sequence);
    return take(
        {name, decode_grey(frame.first, name), decode_grey(frame.second, name), frame.stamp.utime});
  });
}

StereoCalibration calibration_in(const std::string& log) {
  if (const auto calibration = LogMessages<stereo_calibration_t>(log, kCalibrationChannel).next())
    return *calibration;
  if (!LogMessages<stereo_images_t>(log, kImagesChannel).next()) fail_without_pairs(log);
  throw InputError(log + ": holds no calibration on " + kCalibrationChannel +
                   "; give one with --calibration");
}

void check_exists(const std::string& source) {
  if (!source.empty() && !is_camera(source) && !std::filesystem::exists(source))
    throw InputError(source + ": does not exist; give a folder, log, video or camera to --source");
}

/// Before anything is measured by it; without the maps, which whoever measures makes.
StereoCalibration checked(const StereoCalibration& calibration, const std::string& file) {
  try {
    reconstructor::usable_rectification(calibration);
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": " + error.what());
  }
  return calibration;
}

}  // namespace

void declare_source(config::Section& section, SourceOptions& options) {
  section.add("source", options.source,
              "folder with NAME_left and NAME_right, LCM log, video file, /dev/videoN, "
              "gst:PIPELINE or a stream's URL");
  section.add(kSecondKey, options.second_source,
              "camera or video of the right image, where it has one of its own");
  declare_cameras(section, options);
}

void check_not_told_to_end() {
  if (lcm_io::stop_requested()) throw std::runtime_error("told to end; nothing is written");
}

void visit_source(const SourceOptions& options, const PairFormat& format,
                  const std::function<bool(const FramePair&)>& take) {
  const std::unique_ptr<PairSource> source = open_source(options, format);
  config::log(config::LogLevel::kInfo, source->description());
  ProblemLog problems;
  while (!source->ended()) {
    check_not_told_to_end();
    const std::optional<FramePair> frame = source->next();
    problems.tell(source->problem());
    if (frame && !take(*frame)) return;
  }
}

bool in_sequence(const std::string& source) { return !std::filesystem::is_directory(source); }

std::size_t count_pairs(const std::string& folder) {
  return find_recording(folder, kNames, {}).frames.size();
}

void visit_pairs(const SourceOptions& options, const Take& take) {
  if (options.source.empty()) throw config::UsageError("--source is missing; see --help");
  if (std::filesystem::is_directory(options.source)) {
    visit_folder(options.source, take);
  } else if (is_lcm_log(options.source)) {
    visit_log(options.source, take);
  } else {
    visit_stream(options, take);
  }
}

std::vector<std::string> pictures_read(const SourceOptions& source) {
  static const std::regex picture(".+_(left|right|color|depth)");
  std::vector<std::string> paths = {source.source, source.second_source};
  std::error_code no_folder;
  for (const auto& file : std::filesystem::directory_iterator(source.source, no_folder)) {
    if (std::regex_match(file.path().stem().string(), picture))
      paths.push_back(file.path().string());
  }
  return paths;
}

void check_sizes(const GreyPair& pair, const StereoCalibration& calibration) {
  for (const auto& [name, image, lens] : {std::tuple("left", &pair.left, &calibration.left.camera),
                                          {"right", &pair.right, &calibration.right.camera}}) {
    if (image->cols == lens->width && image->rows == lens->height) continue;
    throw InputError(pair.name + ": the " + name + " image is " +
                     size_text(image->cols, image->rows) + ", the calibration is for " +
                     size_text(lens->width, lens->height) +
                     "; give the calibration of this camera and image size");
  }
}

StereoCalibration find_calibration(const std::string& path, const std::string& source) {
  if (!path.empty()) return checked(read_stereo_calibration(path), path);
  if (is_lcm_log(source)) return checked(calibration_in(source), source);
  check_exists(source);
  throw config::UsageError("--calibration is missing; see --help");
}

}  // namespace limbcast::calibrate
