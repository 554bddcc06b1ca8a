#include "common/sources/ffmpeg_video.hpp"

#include <dlfcn.h>

#include <cstdarg>
#include <cstdio>

#include "common/input_error.hpp"

namespace limbcast {
namespace {

/// AV_LOG_WARNING of libavutil/log.h: as such a server's refusal is told.
constexpr int kWarningLevel = 24;
constexpr std::size_t kLongestReason = 500;

/// What FFmpeg told this thread last, as "Failed to resolve hostname".
thread_local std::string told;

void keep(void* /*context*/, int level, const char* format, std::va_list values) {
  if (level > kWarningLevel) return;
  told.resize(kLongestReason);
  std::vsnprintf(told.data(), told.size(), format, values);
  told.resize(told.find_first_of(std::string("\n\0", 2)));
}

/// OpenCV hands no reason on, but brings the library that would write it to stderr.
void keep_what_ffmpeg_tells() {
  using Callback = void (*)(void*, int, const char*, std::va_list);
  using SetCallback = void (*)(Callback);
  const auto set_callback =
      reinterpret_cast<SetCallback>(dlsym(RTLD_DEFAULT, "av_log_set_callback"));
  if (set_callback != nullptr) set_callback(&keep);
}

}  // namespace

void open_by_ffmpeg(cv::VideoCapture& video, const std::string& source, const std::string& remedy) {
  keep_what_ffmpeg_tells();
  told.clear();
  if (video.open(source, cv::CAP_FFMPEG)) return;
  const std::string reason = told.empty() ? "" : " (" + told + ")";
  throw InputError(source + ": cannot be opened as a video" + reason + "; " + remedy);
}

}  // namespace limbcast
