#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "common/input_error.hpp"
#include "common/sources/open_source.hpp"
#include "common/sources/video_source.hpp"
#include "tests/common/sources/test_pictures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::depth_format;
using test::error_of;
using test::grey_picture;
using test::level_of;
using test::stereo_format;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// JPEG, twice, is not exact on flat pictures either.
constexpr int kLevelTolerance = 3;

/// Motion JPEG at 20 frames/s; picture i has level first_level + 20 * i.
std::string write_video(const std::string& path, const cv::Size& size, int frames,
                        int first_level) {
  cv::VideoWriter writer(path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         20.0, size);
  for (int i = 0; i < frames; ++i) {
    writer.write(grey_picture(size.width, size.height, first_level + 20 * i));
  }
  return path;
}

TEST(VideoSourceTest, GivesThePairsOfTwoFiles) {
  const TemporaryFolder folder;
  const std::string left = write_video(folder / "l.avi", {64, 48}, 3, 40);
  const std::string right = write_video(folder / "r.avi", {64, 48}, 3, 120);
  VideoSource source(left, right, stereo_format(), {0.0, 1'000'000, false});

  for (int i = 0; i < 3; ++i) {
    const auto frame = source.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->stamp.utime, 1'000'000 + i * 50'000);
    EXPECT_EQ(frame->stamp.sequence, i);
    EXPECT_NEAR(level_of(frame->first), 40 + 20 * i, kLevelTolerance);
    EXPECT_NEAR(level_of(frame->second), 120 + 20 * i, kLevelTolerance);
  }
  EXPECT_FALSE(source.next());
  EXPECT_TRUE(source.ended());
}

TEST(VideoSourceTest, SplitsPicturesThatHoldBothCameras) {
  const TemporaryFolder folder;
  VideoSource source(write_video(folder / "both.avi", {128, 48}, 1, 90), "", stereo_format(), {});
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->first.width, 64);
  EXPECT_EQ(frame->second.width, 64);
}

TEST(VideoSourceTest, CountsOnThroughALoop) {
  const TemporaryFolder folder;
  VideoSource source(write_video(folder / "both.avi", {128, 48}, 2, 90), "", stereo_format(),
                     {10.0, 0, true});
  std::vector<std::int64_t> utimes;
  utimes.reserve(5);
  for (int i = 0; i < 5; ++i) utimes.push_back(source.next()->stamp.utime);
  EXPECT_THAT(utimes, ::testing::ElementsAre(0, 100'000, 200'000, 300'000, 400'000));
}

TEST(VideoSourceTest, RefusesOtherFiles) {
  const TemporaryFolder folder;
  const std::string text = folder.write("notes.txt", "this is no video");
  EXPECT_THAT(error_of<InputError>([&] { VideoSource(text, "", stereo_format(), {}); }),
              HasSubstr("notes.txt: cannot be opened as a video"));
}

TEST(VideoSourceTest, TellsFfmpegsReasonForATornFile) {
  const TemporaryFolder folder;
  // The head of a film that was cut off before its index.
  const std::string torn =
      folder.write("torn.mp4", std::string("\0\0\0\x14"
                                           "ftypisom\0\0\0\0isom\0\0\0\x10mdat",
                                           28));
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(error_of<InputError>([&] { VideoSource(torn, "", stereo_format(), {}); }),
            torn +
                ": cannot be opened as a video (moov atom not found); give a video file, an "
                "LCM log, a folder of pictures or a camera");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Stream, OfAServerThatIsNotThereIsToldWithTheReasonAlone) {
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(error_of<InputError>([] { open_camera("rtsp://127.0.0.1:1/stream", {}); }),
              AllOf(StartsWith("rtsp://127.0.0.1:1/stream: cannot be opened as a video ("),
                    EndsWith("Connection refused); check its address, and whether it is sending")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

SourceOptions options_for(const std::string& source) {
  SourceOptions options;
  options.source = source;
  options.reopen = false;
  return options;
}

std::string error_of_opening(const std::string& source, const PairFormat& format) {
  return error_of<InputError>([&] { open_source(options_for(source), format); });
}

TEST(OpenSource, NamesWhatDoesNotExist) {
  EXPECT_THAT(error_of_opening("/none", stereo_format()), HasSubstr("/none: does not exist"));
  EXPECT_THAT(error_of_opening("/dev/video987", stereo_format()),
              HasSubstr("/dev/video987: No such file or directory; is the camera plugged in?"));
}

TEST(OpenSource, TakesNoPictureForAVideo) {
  const TemporaryFolder folder;
  const std::string picture = folder / "one.jpg";
  cv::imwrite(picture, grey_picture(640, 480, 90));
  for (const PairFormat& format : {stereo_format(), depth_format()})
    EXPECT_EQ(error_of_opening(picture, format),
              picture + ": is one picture; give its folder, an LCM log, a video file or a camera");
}

TEST(OpenSource, AsksForAFolderOrALogOfDepth) {
  const TemporaryFolder folder;
  const std::string file = folder.write("empty.yml", "");
  EXPECT_EQ(error_of_opening(file, depth_format()),
            file +
                ": is neither a folder nor an LCM log, and videos cannot hold 16-bit depth; "
                "give a folder of pictures, a log or cameras");
}

TEST(OpenSource, NamesADeviceThatIsNoCamera) {
  EXPECT_THAT(error_of_opening("/dev/null", stereo_format()),
              HasSubstr("/dev/null: gives no pictures"));
}

TEST(OpenSource, TakesRecordingsInMemoryForNoDevices) {
  std::string folder = "/dev/shm/limbcast_test_XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string video = write_video(folder + "/both.avi", {128, 48}, 1, 90);
  EXPECT_EQ(open_source(options_for(video), stereo_format())->next()->first.width, 64);
  EXPECT_THAT(error_of_opening(folder, stereo_format()),
              HasSubstr(folder + ": has no NAME_left and NAME_right pictures"));
  std::filesystem::remove_all(folder);
}

TEST(OpenSource, WantsADepthCameraBesideTheColourCamera) {
  EXPECT_THAT(error_of_opening("/dev/video0", depth_format()), HasSubstr("--source-depth"));
}

class Pipeline : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      open_camera("gst:videotestsrc num-buffers=1 ! video/x-raw,format=BGR", {});
    } catch (const InputError&) {
      GTEST_SKIP() << "GStreamer's base plugins are absent (gstreamer1.0-plugins-base)";
    }
  }
  static std::string pattern(const std::string& format, int width, int frames) {
    return "gst:videotestsrc is-live=true num-buffers=" + std::to_string(frames) +
           " ! video/x-raw,framerate=50/1,height=48,format=" + format +
           ",width=" + std::to_string(width);
  }
  static std::vector<FramePair> play(const SourceOptions& options, const PairFormat& format) {
    const std::unique_ptr<PairSource> source = open_source(options, format);
    std::vector<FramePair> frames;
    while (!source->ended()) {
      if (auto frame = source->next()) frames.push_back(std::move(*frame));
    }
    return frames;
  }
};

TEST_F(Pipeline, GivesPairsSideBySideAndEnds) {
  const std::vector<FramePair> frames = play(options_for(pattern("BGR", 128, 5)), stereo_format());

  ASSERT_FALSE(frames.empty());
  EXPECT_LE(frames.size(), 5U);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].stamp.utime, frames[i - 1].stamp.utime);
  }
}

TEST_F(Pipeline, GivesDepthOf16Bit) {
  SourceOptions options = options_for(pattern("BGR", 64, 20));
  options.second_source = pattern("GRAY16_LE", 64, 20);
  options.pair_tolerance_ms = 1000.0;

  const std::vector<FramePair> frames = play(options, depth_format());

  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames[0].second.bits, 16);
  EXPECT_EQ(decode_image(frames[0].second, "test").type(), CV_16UC1);
}

TEST_F(Pipeline, OfTheWrongSizeIsRefused) {
  EXPECT_THAT(
      error_of<InputError>([&] { play(options_for(pattern("BGR", 320, 5)), stereo_format()); }),
      HasSubstr("is 160x48, the calibration is for 64x48"));
}

TEST_F(Pipeline, ThatCannotBeStartedIsNamed) {
  EXPECT_THAT(error_of_opening("gst:videotestsrc ! nosuchelement", stereo_format()),
              HasSubstr("gst:videotestsrc ! nosuchelement: no element \"nosuchelement\""));
  EXPECT_THAT(error_of_opening("gst:videotestsrc ! fakesink name=appsink", stereo_format()),
              HasSubstr("name=appsink: has no appsink"));
  EXPECT_THAT(
      error_of_opening("gst:videotestsrc num-buffers=-5", stereo_format()),
      HasSubstr("num-buffers=-5: value \"-5\" of type 'gint' is invalid or out of range for "
                "property 'num-buffers'"));
}

TEST_F(Pipeline, ThatIsLiveMayWaitForItsSender) {
  const std::string silent = pattern("BGR", 128, -1) + " ! valve drop=true";
  EXPECT_FALSE(open_source(options_for(silent), stereo_format())->ended());
}

TEST_F(Pipeline, GivesEachRowFromItsBegin) {
  // GStreamer's rows begin at multiples of 4 bytes: one byte is between them.
  const TemporaryFolder folder;
  std::string bytes(64 * 48, '\xff');
  cv::Mat expected(48, 63, CV_8UC1);
  for (int y = 0; y < expected.rows; ++y) {
    for (int x = 0; x < expected.cols; ++x) {
      expected.at<uchar>(y, x) = static_cast<uchar>(x + y);
      bytes[64 * y + x] = static_cast<char>(x + y);
    }
  }
  const std::string source =
      "gst:filesrc blocksize=3072 location=" + folder.write("grey", bytes) +
      " ! video/x-raw,format=GRAY8,width=63,height=48,framerate=30/1 ! appsink";

  const auto frame = open_camera(source, {})->read();

  ASSERT_TRUE(frame);
  EXPECT_EQ(cv::norm(frame->picture.pixels, expected, cv::NORM_INF), 0.0);
}

TEST_F(Pipeline, ThatGivesLessThanAPictureFails) {
  const TemporaryFolder folder;
  const std::string source =
      "gst:filesrc location=" + folder.write("grey", std::string(64 * 47, ' ')) +
      " ! video/x-raw,format=GRAY8,width=64,height=48,framerate=30/1 ! appsink";
  const auto reader = open_camera(source, {});
  EXPECT_THAT(error_of<InputError>([&] { reader->read(); }), HasSubstr("gives a torn picture"));
}

TEST_F(Pipeline, ThatHangsIsNamed) {
  // GStreamer waits for ever for what nobody gives this source.
  SourceOptions options = options_for("gst:appsrc");
  options.open_timeout_s = 0.2;
  EXPECT_THAT(error_of<InputError>([&] { open_source(options, stereo_format()); }),
              HasSubstr("gst:appsrc: did not open in time"));
}

}  // namespace
}  // namespace limbcast
