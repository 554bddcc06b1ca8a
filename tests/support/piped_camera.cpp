#include "tests/support/piped_camera.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

#include "common/input_error.hpp"
#include "common/sources/video_reader.hpp"

namespace limbcast::test {
namespace {

/// How often a wait looks whether the program ended [ms].
constexpr int kLook_ms = 100;

}  // namespace

bool has_gstreamer() {
  try {
    open_camera("gst:videotestsrc num-buffers=1 ! jpegenc ! jpegdec", {});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

PipedCamera::PipedCamera(std::string path, const cv::Size& size)
    : path_(std::move(path)), size_(size) {
  if (mkfifo(path_.c_str(), S_IRUSR | S_IWUSR) != 0)
    throw std::runtime_error(path_ + ": cannot be made");
  plug_in();
}

std::string PipedCamera::source() const {
  return "gst:filesrc location=" + path_ + " blocksize=" + std::to_string(size_.area()) +
         " ! rawvideoparse format=gray8 width=" + std::to_string(size_.width) +
         " height=" + std::to_string(size_.height) + " framerate=30/1 ! identity sync=true";
}

// Opened for reading too, a pipe neither waits for the program nor breaks when that ends.
void PipedCamera::plug_in() { file_ = open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); }

void PipedCamera::unplug() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

bool PipedCamera::give(const cv::Mat& picture, ChildProcess& program) const {
  if (picture.size() != size_ || picture.type() != CV_8UC1 || !picture.isContinuous())
    throw std::runtime_error("the camera gives other pictures");
  const std::size_t bytes = picture.total();
  for (std::size_t given = 0; given < bytes;) {
    const ssize_t written = write(file_, picture.data + given, bytes - given);
    if (written > 0) given += static_cast<std::size_t>(written);
    if (written > 0) continue;
    if (errno != EAGAIN) throw std::runtime_error(path_ + ": cannot be written");
    pollfd room{file_, POLLOUT, 0};
    poll(&room, 1, kLook_ms);
    if (!program.running()) return false;
  }
  return true;
}

}  // namespace limbcast::test
