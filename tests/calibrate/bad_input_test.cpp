#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "common/camera/calibration_writer.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

TEST(CalibrateProgram, RefusesPicturesWithoutBoard) {
  const TemporaryFolder folder;
  write_pair(folder, picture_of_wall("a", {64, 48}));
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", folder / "calibration.yml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("only 0 good views of the board, at least 5 are needed, 15 to "
                                     "30 are better; the others: board not found in the left image "
                                     "(1); do --board, --columns and --rows describe the board?"));
  EXPECT_FALSE(fs::exists(folder / "calibration.yml"));
}

TEST(CalibrateProgram, TellsAPairWithoutBoardBeforeItLooksAtTheNext) {
  const TemporaryFolder folder;
  write_pair(folder, picture_of_wall("a", {64, 48}));
  write_pair(folder, picture_of_wall("b", {64, 48}));
  for (const fs::directory_entry& file : fs::directory_iterator(folder.path()))
    if (file.path().stem() == "b_left") fs::resize_file(file.path(), 10);
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", folder / "calibration.yml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(folder.path() + ": looks for the board in 2 pairs"));
  EXPECT_THAT(outcome.err, HasSubstr("b_left"));
  EXPECT_EQ(outcome.out, "a                     rejected: board not found in the left image\n");
}

TEST(CalibrateProgram, LeavesMalformedMessagesOfALogOut) {
  const TemporaryFolder folder;
  lcm_io::LogReader in(std::string(LIMBCAST_SOURCE_DIR) + "/logs/nobody.log");
  lcm_io::LogWriter out(folder / "in.log");
  int num_pairs = 0, num_calibrations = 0;
  while (auto event = in.next()) {
    // Of eight pairs every other one, and the first calibration.
    const bool malformed = event->channel == "STEREO_IMAGES"        ? num_pairs++ % 2 == 0
                           : event->channel == "STEREO_CALIBRATION" ? num_calibrations++ == 0
                                                                    : false;
    if (malformed) event->data.resize(event->data.size() / 2);
    out.write(*event);
  }
  out.close();
  const Outcome outcome =
      run_program("limbcast-calibrate", {"check", "--source", folder / "in.log"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("4 pairs"));
  for (const char* channel : {"STEREO_CALIBRATION", "STEREO_IMAGES"})
    EXPECT_THAT(outcome.err, HasSubstr("in.log: malformed messages on " + std::string(channel) +
                                       " are left out; the first: not a message of this type"));
}

TEST(CalibrateProgram, SaysThatALogHoldsNoPictures) {
  const TemporaryFolder folder;
  folder.write("empty.log", "");
  lcm_io::LogWriter other(folder / "other.log");
  other.write({1, "OTHER", {1, 2, 3}, 0});
  other.close();
  for (const auto& [log, reason] :
       {std::pair("empty.log", "is empty; was the logger running?"),
        {"other.log", "holds no pairs on STEREO_IMAGES; was limbcast-stereo-camera running?"}}) {
    const Outcome outcome = run_program("limbcast-calibrate", {"check", "--source", folder / log});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "limbcast-calibrate: " + folder / log + ": " + reason + "\n");
  }
}

TEST(CalibrateProgram, NamesAPairThatIsNotOfTheCalibrationsSize) {
  const TemporaryFolder folder;
  write_pair(folder, picture_of_wall("a", {64, 48}));
  const std::string file = folder / "any.yml";
  write_stereo_calibration(file, true_cameras());
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"check"}, {"mounting", "--output", folder / "out.yml"}}) {
    arguments.insert(arguments.end(), {"--source", folder.path(), "--calibration", file});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "limbcast-calibrate: a: the left image is 64x48, the calibration is for 640x480; "
              "give the calibration of this camera and image size\n");
  }
}

TEST(CalibrateProgram, RefusesACalibrationByWhichRectifiedImagesShowNothing) {
  const TemporaryFolder folder;
  write_pair(folder, picture_of_wall("a", {640, 480}));
  StereoCalibration cameras = true_cameras();
  cameras.left.camera.cx = cameras.right.camera.cx = 0.01;
  cameras.left.distortion = cameras.right.distortion = {};
  const std::string file = folder / "any.yml";
  write_stereo_calibration(file, cameras);
  for (std::vector<std::string> arguments :
       {std::vector<std::string>{"check"}, {"mounting", "--output", folder / "out.yml"}}) {
    arguments.insert(arguments.end(), {"--source", folder.path(), "--calibration", file});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("any.yml: calibration: rectified images would show nothing "
                                       "that both cameras see"));
  }
}

TEST(CalibrateProgram, RefusesPicturesThatAreTooLargeBeforeItDecodesThem) {
  const TemporaryFolder folder;
  cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(90));
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  bytes[17] = 1;  // 65600 px wide, says the header
  for (const char* name : {"a_left.png", "a_right.png"})
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", folder / "calibration.yml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a_left.png: is 65600x48, at most 8192 px a side"));
}

TEST(CalibrateProgram, FindsNoBoardInPicturesOfAFewPixels) {
  for (const cv::Size& size : {cv::Size(1, 1), {8, 8}, {1000, 2}, {2, 1000}}) {
    const TemporaryFolder folder;
    write_pair(folder, picture_of_wall("a", size));
    for (const char* kind : {"chessboard", "circles", "charuco"}) {
      const Outcome outcome =
          run_program("limbcast-calibrate",
                      {"--source", folder.path(), "--board", kind, "--output", folder / "c.yml"});
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_THAT(outcome.out, ::testing::ContainsRegex("a +rejected: board not found"));
    }
  }
}

TEST(CalibrateProgram, ExplainsWrongUsage) {
  const Outcome no_output = run_program("limbcast-calibrate", {"--source", "/nowhere"});
  EXPECT_EQ(no_output.exit_code, 2);
  EXPECT_THAT(no_output.err, HasSubstr("--output is missing"));
  const Outcome no_folder =
      run_program("limbcast-calibrate", {"--source", "/nowhere", "--output", "c.yml"});
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr("/nowhere"));
  const Outcome no_log = run_program("limbcast-calibrate", {"check", "--source", "/nowhere.log"});
  EXPECT_EQ(no_log.exit_code, 2);
  EXPECT_THAT(no_log.err, HasSubstr("/nowhere.log: does not exist"));
  const TemporaryFolder pictures;
  const Outcome live_options = run_program(
      "limbcast-calibrate", {"--source", pictures.path(), "--gain", "3", "--output", "c.yml"});
  EXPECT_EQ(live_options.exit_code, 2);
  EXPECT_THAT(live_options.err, HasSubstr(": is a recording; leave out gain"));
}

TEST(CalibrateProgram, NamesItsCommandsWhereOneIsUnknown) {
  const Outcome outcome = run_program("limbcast-calibrate", {"chek", "--source", "/nowhere"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "limbcast-calibrate: command line: 'chek' is no command; use board, check or mounting, "
            "or options alone to calibrate, see limbcast-calibrate --help\n");
}

TEST(CalibrateProgram, RefusesToWriteOverAPictureOfItsSource) {
  const TemporaryFolder folder;
  const std::string picture = folder.write("01_left.jpg", "a picture");
  folder.write("calibration.yml", "old");
  const auto refusal_of = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--source", folder.path()});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  const std::string is_read = picture + ": is what is read; choose another ";
  EXPECT_THAT(refusal_of({"--output", picture}), HasSubstr(is_read + "--output"));
  EXPECT_THAT(refusal_of({"mounting", "--output", picture}), HasSubstr(is_read + "--output"));
  EXPECT_THAT(refusal_of({"--output", folder / "calibration.yml", "--picture", picture}),
              HasSubstr(is_read + "--picture"));
  // Its calibration may be written anew, so that what is said next is that a picture is missing.
  EXPECT_THAT(refusal_of({"--output", folder / "calibration.yml"}),
              ::testing::Not(HasSubstr("is what is read")));
}

TEST(CalibrateProgram, RefusesFilesThatItCannotWriteBeforeItLooksAtPictures) {
  const auto expect_refusal = [&](std::vector<std::string> arguments, const std::string& text) {
    arguments.insert(arguments.end(), {"--source", "/nowhere"});
    const Outcome outcome = run_program("limbcast-calibrate", arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "limbcast-calibrate: " + text + "\n");
  };
  expect_refusal({"--output", "/none/c.yml"},
                 "/none/c.yml: there is no folder /none; make it or choose another --output");
  expect_refusal({"--output", "c.yml", "--picture", "/none/c.png"},
                 "/none/c.png: there is no folder /none; make it or choose another --picture");
  expect_refusal({"--output", "c.png", "--picture", "c.png"},
                 "c.png: is what --output writes; choose another --picture");
  expect_refusal({"--output", "c.yml", "--picture", "c.odt"},
                 "c.odt: pictures are written as .png or .jpg; choose such an ending");
  expect_refusal({"mounting", "--output", "/none/c.yml"},
                 "/none/c.yml: there is no folder /none; make it or choose another --output");
}

}  // namespace
}  // namespace limbcast::calibrate
