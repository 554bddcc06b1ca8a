#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/calibration_writer.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::shell_quoted;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

/// As cameras give them: coloured JPEG.
void write_pair(const TemporaryFolder& folder, const GreyPair& pair) {
  for (const auto& [grey, side] :
       {std::pair(&pair.left, "_left.jpg"), {&pair.right, "_right.jpg"}}) {
    cv::Mat image;
    cv::cvtColor(*grey, image, cv::COLOR_GRAY2BGR);
    cv::imwrite(folder / (pair.name + side), image);
  }
}

/// Pairs of OpenCV's example under the names that a folder source wants.
void link_example_pairs(const TemporaryFolder& folder) {
  const fs::path data = fs::path(LIMBCAST_DATA_DIR) / "stereo_opencv";
  for (const fs::directory_entry& file : fs::directory_iterator(data)) {
    if (file.path().extension() != ".jpg") continue;
    const std::string stem = file.path().stem().string();
    const std::string number = stem.substr(stem.size() - 2);
    const std::string side = stem.substr(0, stem.size() - 2);
    fs::create_symlink(
        file.path(),
        folder / std::string("pair").append(number).append("_").append(side).append(".jpg"));
  }
}

TEST(CalibrateProgram, CalibratesARealPairOfCameras) {
  if (!fs::exists(fs::path(LIMBCAST_DATA_DIR) / "stereo_opencv"))
    GTEST_SKIP() << LIMBCAST_DATA_DIR << " is absent";
  const TemporaryFolder folder;
  link_example_pairs(folder);
  const TemporaryFolder out;
  const Outcome outcome =
      run_program("limbcast-calibrate", {"--source", folder.path(), "--square-mm", "25", "--output",
                                         out / "calibration.yml", "--picture", out / "report.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("13 views"));
  EXPECT_THAT(outcome.out, HasSubstr("to add: show the board in these parts of the left image"));
  const StereoCalibration found = read_stereo_calibration(out / "calibration.yml");
  // An independent calibration of the same corners lies beside the pictures.
  EXPECT_NEAR(found.left.camera.fx, 532.8, 0.003 * 532.8);
  EXPECT_NEAR(found.right.camera.fx, 537.4, 0.006 * 537.4);
  EXPECT_NEAR(baseline_m(found), 3.328 * 0.025, 0.005 * 3.328 * 0.025);
  ASSERT_TRUE(found.rectification);
  EXPECT_FALSE(cv::imread(out / "report.png").empty());
}

TEST(CalibrateProgram, CalibratesRenderedCamerasAndNamesBadPairs) {
  const TemporaryFolder folder;
  const Board board;
  for (const BoardPose& pose : varied_poses(board, 10)) {
    static int number = 10;
    write_pair(folder, render_board(board, pose, true_cameras(), "p" + std::to_string(number++)));
  }
  write_pair(folder, {"empty", cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)),
                      cv::Mat(480, 640, CV_8UC1, cv::Scalar(90))});
  const TemporaryFolder out;
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", out / "calibration.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              ::testing::ContainsRegex("empty +rejected: board not found in the left"));
  const StereoCalibration found = read_stereo_calibration(out / "calibration.yml");
  EXPECT_NEAR(found.left.camera.fx, 531.2, 0.003 * 531.2);
  EXPECT_NEAR(found.T.norm(), true_cameras().T.norm(), 0.005 * 0.12);
}

/// Pairs as a video shows them: a board that is held still at one place after the other; the last
/// picture is blurred by motion.
std::vector<GreyPair> board_video(int places, int frames_still) {
  std::vector<GreyPair> frames;
  for (const BoardPose& pose : varied_poses({}, places)) {
    GreyPair pair = render_board({}, pose, true_cameras(), "");
    for (int i = 0; i < frames_still; ++i) frames.push_back(pair);
  }
  for (cv::Mat* image : {&frames.back().left, &frames.back().right}) {
    cv::Mat blurred;  // the pixels are those of the frame before
    cv::blur(*image, blurred, {25, 1});
    *image = blurred;
  }
  return frames;
}

void expect_true_cameras(const StereoCalibration& found) {
  EXPECT_NEAR(found.left.camera.fx, 531.2, 0.003 * 531.2);
  EXPECT_NEAR(found.right.camera.fx, 529.4, 0.003 * 529.4);
  EXPECT_NEAR(found.T.norm(), true_cameras().T.norm(), 0.005 * 0.12);
}

std::string numbered(const std::string& stem, std::size_t number) {
  const std::string digits = std::to_string(number);
  return stem + std::string(4 - digits.size(), '0') + digits;
}

TEST(CalibrateProgram, CalibratesFromALogOfAMovingBoard) {
  const TemporaryFolder folder;
  std::size_t number = 0;
  for (GreyPair pair : board_video(12, 2)) {
    pair.name = numbered("frame_", number++);
    write_pair(folder, pair);
  }
  const TemporaryFolder out;
  write_stereo_calibration(out / "any.yml", true_cameras());
  ASSERT_EQ(run_program("limbcast-stereo-camera",
                        {"--source", folder.path(), "--calibration", out / "any.yml", "--log",
                         out / "in.log", "--jpeg-quality", "0"})
                .exit_code,
            0);

  const Outcome outcome = run_program("limbcast-calibrate",
                                      {"--source", out / "in.log", "--output", out / "found.yml"});

  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  // Of each place the second frame, when the board is known to stand still: 0.1 s, 0.3 s, ...
  const std::regex taken("([0-9]+): view [0-9]+ taken");
  int views = 0;
  for (std::sregex_iterator view(outcome.err.begin(), outcome.err.end(), taken), end; view != end;
       ++view, ++views)
    EXPECT_EQ(std::stol((*view)[1]) % 200'000, 100'000) << view->str();
  EXPECT_GE(views, 8);
  expect_true_cameras(read_stereo_calibration(out / "found.yml"));
}

TEST(CalibrateProgram, RefusesPicturesWithoutBoard) {
  const TemporaryFolder folder;
  write_pair(folder, {"a", cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)),
                      cv::Mat(48, 64, CV_8UC1, cv::Scalar(90))});
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"--source", folder.path(), "--output", folder / "calibration.yml"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("only 0 good views of the board"));
  EXPECT_FALSE(fs::exists(folder / "calibration.yml"));
}

TEST(CalibrateProgram, DrawsABoardOfTrueSizeThatIsFound) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"board", "--square-mm", "20", "--output", folder / "board.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("220 x 160 mm"));  // 10 x 7 squares and half a one around
  const cv::Mat image = cv::imread(folder / "board.png", cv::IMREAD_GRAYSCALE);
  const std::optional<BoardPoints> points = find_board(image, {});
  ASSERT_TRUE(points);
  const double square_px = cv::norm(points->pixels[1] - points->pixels[0]);
  EXPECT_NEAR(square_px, 0.02 / 0.0254 * 300.0, 0.6);
  std::ifstream file(folder / "board.png", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const std::size_t chunk = bytes.find("pHYs");
  ASSERT_NE(chunk, std::string::npos);
  std::uint32_t pixels_per_m = 0;
  for (int i = 0; i < 4; ++i)
    pixels_per_m = pixels_per_m << 8 | static_cast<unsigned char>(bytes[chunk + 4 + i]);
  EXPECT_NEAR(pixels_per_m * 0.02, square_px, 0.05);
}

/// A PDF as poppler shows it.
class BoardOnPaper : public ::testing::Test {
 protected:
  Outcome draw(const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"board", "--output", folder_ / "board.pdf"};
    all.insert(all.end(), options.begin(), options.end());
    return run_program("limbcast-calibrate", all);
  }
  /// What a command of poppler prints of the file.
  std::string poppler(const std::string& command, const std::string& arguments) const {
    const std::string output = folder_ / "poppler.txt";
    const std::string line =
        command + " " + shell_quoted(folder_ / "board.pdf") + " " + arguments + " >" + output;
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    std::ifstream file(output, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  cv::Mat printed(int dots_per_inch) const {
    const std::string page =
        poppler("pdftoppm", "-singlefile -gray -r " + std::to_string(dots_per_inch));
    return cv::imdecode(std::vector<char>(page.begin(), page.end()), cv::IMREAD_GRAYSCALE);
  }
  TemporaryFolder folder_;
};

TEST_F(BoardOnPaper, HasTheSheetsSizeAndTrueSquaresAndIsFound) {
  const Outcome outcome = draw({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(poppler("pdfinfo", ""), ::testing::ContainsRegex("Page size: +841.89 x 595.2[78]"));
  const int dots_per_inch = 150;
  const std::optional<BoardPoints> points = find_board(printed(dots_per_inch), {});
  ASSERT_TRUE(points);
  // The diagonal of 8 x 5 squares. Poppler puts the edges of a picture on whole pixels of 0.17 mm.
  const double diagonal_mm =
      cv::norm(points->pixels.back() - points->pixels.front()) * 25.4 / dots_per_inch;
  EXPECT_NEAR(diagonal_mm, 25.0 * std::hypot(8.0, 5.0), 0.2);
  EXPECT_THAT(poppler("pdftotext", "-"), HasSubstr("--columns 9 --rows 6, squares of 25 mm"));
}

TEST_F(BoardOnPaper, MayBeOfOtherKindsAndSizes) {
  const Outcome outcome = draw({"--board", "charuco", "--columns", "6", "--rows", "8",
                                "--square-mm", "35", "--paper", "a3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(poppler("pdfinfo", ""), ::testing::ContainsRegex("Page size: +841.89 x 1190.5[45]"));
  Board board;
  board.kind = BoardKind::kCharuco;
  board.columns = 6;
  board.rows = 8;
  board.square_m = 0.035;
  board.marker_m = 0.7 * board.square_m;
  const std::optional<BoardPoints> points = find_board(printed(75), board);
  ASSERT_TRUE(points);
  EXPECT_EQ(static_cast<int>(points->ids.size()), board.num_points());
}

TEST_F(BoardOnPaper, MustFitOnTheSheet) {
  const Outcome outcome = draw({"--square-mm", "30", "--paper", "letter"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("330 x 240 mm, larger than the sheet of 216 x 279 mm"));
}

TEST(CalibrateProgram, ChecksACalibrationOnABoard) {
  const TemporaryFolder folder;
  const Board board;
  const std::vector<BoardPose> poses = varied_poses(board, 2);
  write_pair(folder, render_board(board, poses[0], true_cameras(), "a"));
  write_pair(folder, render_board(board, poses[1], true_cameras(), "b"));
  const TemporaryFolder out;
  StereoCalibration cameras = true_cameras();
  write_stereo_calibration(out / "good.yml", cameras);
  const Outcome good = run_program("limbcast-calibrate", {"check", "--source", folder.path(),
                                                          "--calibration", out / "good.yml"});
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("2 with a board"));

  // One camera nods by a quarter of a degree: 531 px * 0.0044 = 2.3 px.
  cameras.R = Eigen::AngleAxisd(0.0044, Eigen::Vector3d::UnitX()) * cameras.R;
  write_stereo_calibration(out / "bad.yml", cameras);
  const Outcome bad = run_program(
      "limbcast-calibrate", {"check", "--source", folder.path(), "--calibration", out / "bad.yml"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("bad: the median epipolar error is 2."));

  cameras = true_cameras();
  cameras.T *= 1.1;
  write_stereo_calibration(out / "long.yml", cameras);
  const Outcome too_long = run_program("limbcast-calibrate", {"check", "--source", folder.path(),
                                                              "--calibration", out / "long.yml"});
  EXPECT_EQ(too_long.exit_code, 1);
  EXPECT_THAT(too_long.out, ::testing::ContainsRegex("lengths on the board are off by .(9|10)"));
}

TEST(CalibrateProgram, FindsTheMountingOfARecording) {
  const std::string source = std::string(LIMBCAST_DATA_DIR) + "/stereo_dev/sequence";
  if (!fs::exists(source)) GTEST_SKIP() << source << " is absent";
  const TemporaryFolder out;
  const Outcome outcome =
      run_program("limbcast-calibrate",
                  {"mounting", "--source", source, "--calibration", source + "/calibration.yml",
                   "--pairs", "4", "--output", out / "mounted.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Mounting mounting = read_stereo_calibration(out / "mounted.yml").mounting;
  // The truth of the recording, to half a degree and 3 cm.
  ASSERT_TRUE(mounting.down && mounting.sensor_height_m);
  EXPECT_GT(mounting.down->dot(Eigen::Vector3d(0.006434, 0.997543, 0.069756)), std::cos(0.0087));
  EXPECT_NEAR(*mounting.sensor_height_m, 1.25, 0.03);
}

/// A depth camera 1.3 m above the floor, tipped down by 10 degrees, that stands still.
std::vector<std::string> simulated_depth_camera(const std::string& option,
                                                const std::string& path) {
  return {"--sensor",
          "depth",
          "--set",
          "general",
          "--frames",
          "4",
          "--seed",
          "4711",
          "--min-camera-height-m",
          "1.3",
          "--max-camera-height-m",
          "1.3",
          "--pitch-down-deg",
          "10",
          "--pitch-sigma-deg",
          "0",
          option,
          path};
}

void expect_mounting_of_depth_camera(const std::string& calibration) {
  const Mounting mounting = read_depth_calibration(calibration).mounting;
  ASSERT_TRUE(mounting.down && mounting.sensor_height_m);
  EXPECT_NEAR(mounting.down->z(), std::sin(0.1745), 0.009);
  EXPECT_NEAR(*mounting.sensor_height_m, 1.3, 0.03);
}

TEST(CalibrateProgram, FindsTheMountingOfADepthCamerasFolder) {
  const TemporaryFolder out;
  const std::string frames = out / "frames";
  ASSERT_EQ(run_program("limbcast-simulate", simulated_depth_camera("--output", frames)).exit_code,
            0);
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"mounting", "--source", frames, "--calibration",
                             frames + "/calibration.yml", "--output", out / "mounted.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("4 of 4 frames show the ground"));
  expect_mounting_of_depth_camera(out / "mounted.yml");
}

TEST(CalibrateProgram, FindsTheMountingOfADepthCamerasLogWithItsOwnCalibration) {
  const TemporaryFolder out;
  ASSERT_EQ(
      run_program("limbcast-simulate", simulated_depth_camera("--log", out / "in.log")).exit_code,
      0);
  const Outcome outcome = run_program("limbcast-calibrate", {"mounting", "--source", out / "in.log",
                                                             "--output", out / "mounted.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  expect_mounting_of_depth_camera(out / "mounted.yml");
}

/// Makes the depths of a folder those of a camera of half the size in the colour camera's place.
void halve_depth_camera(const std::string& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string path = entry.path();
    if (path.find("_depth.png") == std::string::npos) continue;
    cv::Mat half;
    cv::resize(cv::imread(path, cv::IMREAD_UNCHANGED), half, {}, 0.5, 0.5, cv::INTER_NEAREST);
    cv::imwrite(path, half);
  }
  DepthCalibration calibration = read_depth_calibration(folder + "/calibration.yml");
  LensCalibration& lens = calibration.depth_camera.emplace().lens;
  lens = calibration.color;
  lens.camera.width /= 2;
  lens.camera.height /= 2;
  for (double* value : {&lens.camera.fx, &lens.camera.fy, &lens.camera.cx, &lens.camera.cy})
    *value *= 0.5;
  write_depth_calibration(folder + "/calibration.yml", calibration);
}

TEST(CalibrateProgram, FindsTheMountingOfADepthCameraWithALensOfItsOwn) {
  const TemporaryFolder out;
  const std::string frames = out / "frames";
  ASSERT_EQ(run_program("limbcast-simulate", simulated_depth_camera("--output", frames)).exit_code,
            0);
  halve_depth_camera(frames);
  const Outcome outcome = run_program(
      "limbcast-calibrate", {"mounting", "--source", frames, "--calibration",
                             frames + "/calibration.yml", "--output", out / "mounted.yml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  expect_mounting_of_depth_camera(out / "mounted.yml");
  EXPECT_TRUE(read_depth_calibration(out / "mounted.yml").depth_camera);
}

TEST(CalibrateProgram, SaysWhichKindOfCalibrationItWantsForAMounting) {
  const TemporaryFolder out;
  const std::string frames = out / "frames";
  ASSERT_EQ(run_program("limbcast-simulate", simulated_depth_camera("--output", frames)).exit_code,
            0);
  write_stereo_calibration(out / "stereo.yml", true_cameras());
  const Outcome outcome =
      run_program("limbcast-calibrate", {"mounting", "--source", frames, "--calibration",
                                         out / "stereo.yml", "--output", out / "mounted.yml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("give a depth camera's"));
}

TEST(CalibrateProgram, WritesNoMountingWhereNoFileIsNamedForIt) {
  const TemporaryFolder folder;
  write_stereo_calibration(folder / "camera.yml", true_cameras());
  const Outcome outcome =
      run_program("limbcast-calibrate",
                  {"mounting", "--source", folder.path(), "--calibration", folder / "camera.yml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "limbcast-calibrate: --output is missing; see --help\n");
}

TEST(CalibrateProgram, FindsAMountingOfOneKindOfCamera) {
  const TemporaryFolder out;
  const Outcome outcome =
      run_program("limbcast-calibrate", {"mounting", "--source", "/dev/video0", "--source-right",
                                         "/dev/video2", "--source-depth", "/dev/video4",
                                         "--calibration", "c.yml", "--output", out / "c.yml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--source-depth of a depth camera; give one of them"));
}

TEST(CalibrateProgram, ExplainsWrongUsage) {
  const Outcome no_output = run_program("limbcast-calibrate", {"--source", "/nowhere"});
  EXPECT_EQ(no_output.exit_code, 2);
  EXPECT_THAT(no_output.err, HasSubstr("--output is missing"));
  const Outcome no_folder =
      run_program("limbcast-calibrate", {"--source", "/nowhere", "--output", "c.yml"});
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr("/nowhere"));
}

TEST(CalibrateProgram, NamesItsCommandsWhereOneIsUnknown) {
  const Outcome outcome = run_program("limbcast-calibrate", {"chek", "--source", "/nowhere"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "limbcast-calibrate: command line: 'chek' is no command; use board, check or mounting, "
            "or options alone to calibrate, see limbcast-calibrate --help\n");
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
  expect_refusal({"--output", "c.yml", "--picture", "c.odt"},
                 "c.odt: no picture format has this ending; use .png");
  expect_refusal({"mounting", "--output", "/none/c.yml"},
                 "/none/c.yml: there is no folder /none; make it or choose another --output");
}

TEST(CalibrateProgram, RefusesToDrawABoardIntoAFolderThatIsMissing) {
  const Outcome outcome = run_program("limbcast-calibrate", {"board", "--output", "/none/b.pdf"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("there is no folder /none"));
}

}  // namespace
}  // namespace limbcast::calibrate
