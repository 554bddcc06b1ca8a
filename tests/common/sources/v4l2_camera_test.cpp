#include "common/sources/v4l2_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/input_error.hpp"
#include "common/sources/v4l2_device.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::test {
namespace {

using ::testing::HasSubstr;

/// A camera of the kernel's driver for tests; empty: there is none (modprobe vivid makes one).
std::string vivid_camera() {
  if (!std::filesystem::exists("/sys/class/video4linux")) return "";
  for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux")) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("video", 0) != 0) continue;  // it has radios and touch screens too
    const std::string path = "/dev/" + name;
    const V4l2Device device(path);
    v4l2_capability capability{};
    if (device.is_open() && device.ask(VIDIOC_QUERYCAP, capability) &&
        std::string(reinterpret_cast<const char*>(capability.driver)) == "vivid" &&
        (capability.device_caps & V4L2_CAP_VIDEO_CAPTURE) != 0) {
      return path;
    }
  }
  return "";
}

class VividCamera : public ::testing::Test {
 protected:
  void SetUp() override {
    if (path_.empty()) GTEST_SKIP() << "no camera of the kernel's driver vivid (modprobe vivid)";
    settings_.calibrated_width = 640;
    settings_.calibrated_height = 360;
  }
  cv::Mat picture() const {
    const auto frame = open_v4l2(path_, settings_)->read();
    return frame ? plain_pixels(frame->picture, path_) : cv::Mat();
  }
  std::string log_of_opening() const {
    ::testing::internal::CaptureStderr();
    open_v4l2(path_, settings_);
    return ::testing::internal::GetCapturedStderr();
  }
  std::string path_ = vivid_camera();
  CameraSettings settings_;
};

TEST_F(VividCamera, GivesTheCalibratedSizeUnlessAnotherIsAskedFor) {
  EXPECT_EQ(picture().size(), cv::Size(640, 360));
  settings_.width = 320;
  settings_.height = 180;
  EXPECT_EQ(picture().size(), cv::Size(320, 180));
}

TEST_F(VividCamera, GivesTheFormatThatIsAskedFor) {
  settings_.format = "GREY";
  EXPECT_EQ(picture().type(), CV_8UC1);
  settings_.raw_depth = true;
  settings_.format = "Y16";
  EXPECT_EQ(picture().type(), CV_16UC1);
}

TEST_F(VividCamera, KeepsTheGainInsteadOfRegulatingIt) {
  const V4l2Device device(path_);
  ASSERT_TRUE(V4l2Control(device, {V4L2_CID_AUTOGAIN}).set(1.0));
  settings_.gain = 77.0;
  EXPECT_THAT(log_of_opening(), ::testing::Not(HasSubstr("refuses")));
  v4l2_control gain{V4L2_CID_GAIN, 0};
  ASSERT_TRUE(device.ask(VIDIOC_G_CTRL, gain));
  EXPECT_EQ(gain.value, 77);
}

TEST_F(VividCamera, SaysWhatItRefuses) {
  settings_.exposure = 50.0;  // it has none
  settings_.gain = 5000.0;
  settings_.rate_hz = 777.0;
  settings_.width = 633;
  settings_.format = "MJPG";
  const std::string log = log_of_opening();
  for (const char* setting : {"exposure", "gain", "camera-rate", "camera-format"}) {
    EXPECT_THAT(log, HasSubstr(std::string("refuses '") + setting + "'"));
  }
  EXPECT_THAT(log, HasSubstr("instead of 633x360"));
}

TEST_F(VividCamera, IsBusyWhileAnotherProgramReadsIt) {
  const auto first = open_v4l2(path_, settings_);
  ASSERT_TRUE(first->read());
  EXPECT_THAT(error_of<InputError>([this] { open_v4l2(path_, settings_); }),
              HasSubstr("Device or resource busy; end the program that uses it"));
}

TEST_F(VividCamera, TellsWhatItCanDo) {
  EXPECT_THAT(v4l2_abilities(path_), HasSubstr("320x180 640x360"));
  EXPECT_THAT(v4l2_abilities(path_), HasSubstr("gain 0 to 255"));
}

}  // namespace
}  // namespace limbcast::test
