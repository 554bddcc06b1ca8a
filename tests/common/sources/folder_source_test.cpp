#include "common/sources/folder_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/input_error.hpp"
#include "tests/common/sources/test_pictures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::depth_format;
using test::error_of;
using test::grey_picture;
using test::stereo_format;
using test::write_bytes;
using ::testing::HasSubstr;

class FolderSourceTest : public ::testing::Test {
 protected:
  void add_pair(const std::string& name, int right_width = 64) {
    write_bytes(folder_ / (name + "_left.jpg"), encode_jpeg(grey_picture(64, 48, 100), 90));
    write_bytes(folder_ / (name + "_right.jpg"),
                encode_jpeg(grey_picture(right_width, 48, 100), 90));
  }
  std::string error_of_next(const PairFormat& format = stereo_format()) {
    FolderSource source(folder_.path(), format, {});
    return error_of<InputError>([&] { source.next(); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(FolderSourceTest, HandsJpegFilesOnByteByByte) {
  add_pair("a");
  FolderSource source(folder_.path(), stereo_format(), {});

  const std::optional<FramePair> frame = source.next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->first.bytes, read_encoded_image(folder_ / "a_left.jpg").bytes);
  EXPECT_EQ(frame->second.bytes, read_encoded_image(folder_ / "a_right.jpg").bytes);
  EXPECT_EQ(frame->stamp.sensor, "front");
  EXPECT_EQ(frame->stamp.frame, "front/left_rectified");
  EXPECT_FALSE(frame->truth);
  EXPECT_TRUE(source.ended());
  EXPECT_FALSE(source.next());
}

TEST_F(FolderSourceTest, TurnsPngIntoJpegUnlessNothingMayBeLost) {
  const EncodedImage png = encode_png(grey_picture(64, 48, 77));
  for (const char* name : {"a_left.png", "a_right.png"}) write_bytes(folder_ / name, png);

  const auto lossy = FolderSource(folder_.path(), stereo_format(), {}).next();
  EXPECT_EQ(lossy->first.format, ImageFormat::kJpeg);

  PairFormat lossless = stereo_format();
  lossless.jpeg_quality = 0;
  const auto kept = FolderSource(folder_.path(), lossless, {}).next();
  EXPECT_EQ(kept->first.bytes, png.bytes);
}

TEST_F(FolderSourceTest, KeepsEveryDepthValue) {
  cv::Mat depth(48, 64, CV_16UC1);
  for (int i = 0; i < 48 * 64; ++i) {
    depth.at<std::uint16_t>(i / 64, i % 64) = static_cast<std::uint16_t>(i * 21);
  }
  write_bytes(folder_ / "a_color.jpg", encode_jpeg(grey_picture(64, 48, 50), 90));
  write_bytes(folder_ / "a_depth.png", encode_png(depth));

  const auto frame = FolderSource(folder_.path(), depth_format(), {}).next();

  EXPECT_EQ(cv::norm(decode_image(frame->second, "test"), depth, cv::NORM_INF), 0.0);
}

TEST_F(FolderSourceTest, GivesDepthAloneWhereNoFrameHasColour) {
  const EncodedImage depth = encode_png(cv::Mat(48, 64, CV_16UC1, cv::Scalar(7000)));
  for (const char* name : {"a_depth.png", "b_depth.png"}) write_bytes(folder_ / name, depth);
  PairFormat format = depth_format();
  EXPECT_THAT(error_of<InputError>([&] { FolderSource(folder_.path(), format, {}); }),
              HasSubstr("has no partner a_color"));

  format.first_is_optional = true;
  FolderSource source(folder_.path(), format, {});
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->first.empty());
  EXPECT_EQ(frame->second.bytes, depth.bytes);
  EXPECT_TRUE(source.next());

  // A folder that lost a file is no recording without colour.
  write_bytes(folder_ / "a_color.jpg", encode_jpeg(grey_picture(64, 48, 50), 90));
  EXPECT_THAT(error_of<InputError>([&] { FolderSource(folder_.path(), format, {}); }),
              HasSubstr("has no partner b_color"));
}

TEST_F(FolderSourceTest, RefusesDepthOf8Bit) {
  write_bytes(folder_ / "a_color.jpg", encode_jpeg(grey_picture(64, 48, 50), 90));
  write_bytes(folder_ / "a_depth.png", encode_png(cv::Mat(48, 64, CV_8UC1, cv::Scalar(7))));
  EXPECT_THAT(error_of_next(depth_format()), HasSubstr("one of 16 bit is needed"));
}

TEST_F(FolderSourceTest, RefusesPicturesOf16Bit) {
  for (const int type : {CV_16UC1, CV_16UC3}) {
    const EncodedImage deep = encode_png(cv::Mat(48, 64, type, cv::Scalar::all(7000)));
    const test::TemporaryFolder folder;
    for (const char* name : {"a_left.png", "a_right.png", "b_color.png", "b_depth.png"})
      write_bytes(folder / name, deep);
    const auto error = [&](const PairFormat& format) {
      FolderSource source(folder.path(), format, {});
      return error_of<InputError>([&] { source.next(); });
    };
    EXPECT_THAT(error(stereo_format()), HasSubstr("a_left.png: is 16 bit; 8 bit expected"));
    EXPECT_THAT(error(depth_format()), HasSubstr("b_color.png: is 16 bit; 8 bit expected"));
  }
}

TEST_F(FolderSourceTest, CountsOnThroughALoop) {
  for (const char* name : {"a", "b", "c"}) add_pair(name);
  folder_.write("timestamps.csv", "name,utime\na,1000\nb,1400\nc,2000\n");
  FolderParams params;
  params.loop = true;
  FolderSource source(folder_.path(), stereo_format(), params);

  std::vector<std::int64_t> utimes;
  std::vector<std::int64_t> sequences;
  for (int i = 0; i < 7; ++i) {
    const auto frame = source.next();
    utimes.push_back(frame->stamp.utime);
    sequences.push_back(frame->stamp.sequence);
  }

  // A round lasts 1000 us and a mean pause of 500 us to its next.
  EXPECT_THAT(utimes, ::testing::ElementsAre(1000, 1400, 2000, 2500, 2900, 3500, 4000));
  EXPECT_THAT(sequences, ::testing::ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_FALSE(source.ended());
}

TEST_F(FolderSourceTest, BringsGravityAndTruth) {
  add_pair("a");
  folder_.write("timestamps.csv", "name,utime,down_x,down_y,down_z\na,1000,0,0.6,0.8\n");
  folder_.write("a_gt.json", R"({"utime": 7, "down": [0, 0.8, 0.6], "camera_height": 1.5,
      "persons": [{"joints": {"head": [0, 0, 2]}, "visible": {"head": true}}]})");

  const auto frame = FolderSource(folder_.path(), stereo_format(), {}).next();

  EXPECT_EQ(frame->stamp.gravity.source, GravitySource::kRecording);
  EXPECT_TRUE(frame->stamp.gravity.down.isApprox(Eigen::Vector3f(0.0F, 0.6F, 0.8F)));
  // The truth must not leak its exact height into what the chain works with.
  EXPECT_FALSE(frame->stamp.gravity.sensor_height_m);
  ASSERT_TRUE(frame->truth);
  EXPECT_EQ(frame->truth->stamp.utime, 1000);
  EXPECT_EQ(frame->truth->stamp.sensor, "front");
  EXPECT_TRUE(frame->truth->stamp.gravity.down.isApprox(Eigen::Vector3f(0.0F, 0.8F, 0.6F)));
  EXPECT_EQ(frame->truth->persons.size(), 1U);
}

TEST_F(FolderSourceTest, NamesPicturesOfDifferentSize) {
  add_pair("a", 32);
  EXPECT_THAT(error_of_next(), HasSubstr("the left image is 64x48, the right one 32x48"));
}

TEST_F(FolderSourceTest, NamesACalibrationForAnotherSize) {
  add_pair("a");
  EXPECT_THAT(error_of_next(stereo_format(640, 480)),
              HasSubstr("the left image is 64x48, the calibration is for 640x480"));
}

TEST_F(FolderSourceTest, NamesATornPicture) {
  add_pair("a");
  std::filesystem::resize_file(folder_ / "a_right.jpg", 200);
  EXPECT_THAT(error_of_next(), HasSubstr("a_right.jpg: is a torn JPEG"));
}

TEST_F(FolderSourceTest, NamesWrongTruth) {
  add_pair("a");
  folder_.write("a_gt.json", "{}");
  EXPECT_THAT(error_of_next(), HasSubstr("a_gt.json: 'utime' is missing"));
}

int frames_with_truth(PairSource& source) {
  int count = 0;
  while (const auto frame = source.next()) count += frame->truth ? 1 : 0;
  return count;
}

TEST(FolderSourceOnRecordings, ReadsEveryFrame) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  FolderSource sequence(data + "/stereo_dev/sequence", stereo_format(640, 480), {});
  EXPECT_EQ(frames_with_truth(sequence), 50);
  FolderSource hd(data + "/stereo_dev/hd", stereo_format(1280, 720), {});
  EXPECT_EQ(frames_with_truth(hd), 12);
  FolderSource rgbd(data + "/rgbd_pointing", depth_format(640, 480), {});
  EXPECT_EQ(frames_with_truth(rgbd), 20);
}

}  // namespace
}  // namespace limbcast
