#include "common/camera/picture_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

TEST(PictureFile, HasAnEndingThatNamesAFormat) {
  EXPECT_NO_THROW(check_picture_ending("report.png"));
  EXPECT_NO_THROW(check_picture_ending("report.jpg"));
  EXPECT_NO_THROW(check_picture_ending("REPORT.PNG"));
  EXPECT_NO_THROW(check_picture_ending(""));
  for (const std::string path : {"report.odt", "report", "report.exr", "report.pgm"})
    EXPECT_EQ(test::error_of<InputError>([&] { check_picture_ending(path); }),
              path + ": pictures are written as .png or .jpg; choose such an ending");
}

TEST(PictureFile, IsNamedWhereItCannotBeWritten) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "none/report.png";
  const cv::Mat image(2, 2, CV_8UC1, cv::Scalar(0));
  EXPECT_EQ(test::error_of<std::runtime_error>([&] { write_picture(path, image); }),
            path + ": cannot be written (No such file or directory)");
}

TEST(PictureFile, IsAllThatIsSaidOfAFullDisk) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "report.png");
  const cv::Mat image(200, 200, CV_8UC1, cv::Scalar(0));
  testing::internal::CaptureStderr();
  EXPECT_EQ(
      test::error_of<std::runtime_error>([&] { write_picture(folder / "report.png", image); }),
      folder / "report.png: cannot be written (No space left on device)");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace limbcast
