#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "tests/support/child_process.hpp"

namespace limbcast::test {

/// Whether the pipelines that tests play can run: GStreamer's plugins base and good.
bool has_gstreamer();

/// A camera whose pictures the test gives: a GStreamer pipeline that reads them from a named pipe.
class PipedCamera {
 public:
  /// `path` of the pipe, which is made. The camera is plugged in.
  PipedCamera(std::string path, const cv::Size& size);
  ~PipedCamera() { unplug(); }
  PipedCamera(const PipedCamera&) = delete;
  PipedCamera& operator=(const PipedCamera&) = delete;

  /// What `--source` is to be.
  std::string source() const;
  void plug_in();
  void unplug();
  /// Gives an 8-bit grey picture to `program`. False: it ended before it had taken the whole of it.
  bool give(const cv::Mat& picture, ChildProcess& program) const;

 private:
  std::string path_;
  cv::Size size_;
  int file_ = -1;
};

}  // namespace limbcast::test
