#include "common/config/log.hpp"

#include <gtest/gtest.h>

namespace limbcast::config {
namespace {

template <class Write>
std::string written_by(const Write& write) {
  testing::internal::CaptureStderr();
  write();
  return testing::internal::GetCapturedStderr();
}

TEST(Log, IsALineAnEventWhateverItQuotes) {
  configure_log("camera", "info");
  EXPECT_EQ(written_by([] {
              log(LogLevel::kInfo, "gst:\n    left  ! both \r\n\n right ! both\n: 10 frames\n");
            }),
            "camera INFO gst: left  ! both right ! both : 10 frames\n");
  EXPECT_EQ(written_by([] { log_failure("limbcast-camera", "gst:\n left: no such element"); }),
            "limbcast-camera: gst: left: no such element\n");
}

}  // namespace
}  // namespace limbcast::config
