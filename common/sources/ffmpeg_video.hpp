#pragma once

#include <opencv2/videoio.hpp>
#include <string>

namespace limbcast {

/// Opens a video file or stream by FFmpeg, whose own lines are kept off stderr from then on. Throws
/// InputError with `remedy` ("give a video file") at its end, and FFmpeg's reason where it tells
/// one.
void open_by_ffmpeg(cv::VideoCapture& video, const std::string& source, const std::string& remedy);

}  // namespace limbcast
