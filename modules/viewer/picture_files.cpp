#include "modules/viewer/picture_files.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <stdexcept>

#include "common/camera/picture_file.hpp"
#include "common/file_extension.hpp"
#include "common/input_error.hpp"
#include "common/whole_file.hpp"

namespace limbcast::viewer {
namespace {

int codec_of(const std::string& path, const std::string& ending) {
  if (ending == ".avi") return cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
  if (ending == ".mp4") return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
  throw InputError(path + ": no video format has this ending; use .avi or .mp4");
}

}  // namespace

DrawnFrame draw_frame(const ViewFrame& frame, const Orbit& orbit) {
  DrawnFrame drawn{frame.number, draw_pictures(frame, orbit), {}};
  drawn.sheet = draw_sheet(frame, drawn.pictures);
  return drawn;
}

void write_pictures(const std::string& folder, const DrawnFrame& frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "frame_%05d_", frame.number);
  const std::string begin = (std::filesystem::path(folder) / name).string();
  // OpenCV's own settings for PNG are the fastest; any level of compression switches them off.
  for (const Picture& picture : frame.pictures)
    write_picture(begin + picture.name + ".png", picture.image);
  write_picture(begin + "sheet.png", frame.sheet);
}

SheetVideo::SheetVideo(std::string path, double frames_per_s)
    : path_(std::move(path)),
      ending_(extension_of(path_)),
      unfinished_(unfinished_file(path_, ending_)),
      frames_per_s_(frames_per_s),
      codec_(codec_of(path_, ending_)) {
  // Of a torn file FFmpeg, which OpenCV brings, would say words of its own on stderr.
  constexpr const char* kQuiet = "-8";
  constexpr int kUnlessToldOtherwise = 0;
  setenv("OPENCV_FFMPEG_LOGLEVEL", kQuiet, kUnlessToldOtherwise);
  // Where FFmpeg cannot begin a file OpenCV tries GStreamer, which says that it cannot either.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

void SheetVideo::write(const DrawnFrame& frame) {
  if (!writer_.isOpened() && !writer_.open(unfinished_, codec_, frames_per_s_, frame.sheet.size()))
    throw std::runtime_error(path_ + ": cannot be written; is the disk full?");
  writer_.write(frame.sheet);
  ++num_frames_;
}

void SheetVideo::finish() {
  // What stands beside it then is an earlier run's.
  if (num_frames_ == 0) throw std::runtime_error(path_ + ": was not written, as no frame came");
  close();
  finish_file(path_, ending_);
}

std::string SheetVideo::leave_unfinished() {
  if (num_frames_ == 0) return path_ + " was not written";
  close();
  return unfinished_ + " holds what was drawn so far";
}

void SheetVideo::close() {
  // The writer tells nobody that a disk is full. The count of frames comes last into a file, so it
  // is right only where all before it was written. Other backends than the writer's may wait
  // without end for the rest of a torn file.
  const int backend = static_cast<int>(writer_.get(cv::CAP_PROP_BACKEND));
  writer_.release();
  const cv::VideoCapture written(unfinished_, backend);
  if (written.get(cv::CAP_PROP_FRAME_COUNT) < num_frames_)
    throw std::runtime_error(path_ + ": cannot be written to its end; is the disk full?");
}

}  // namespace limbcast::viewer
