#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/calibration_writer.hpp"
#include "tests/calibrate/boards.hpp"
#include "tests/common/run_program.hpp"

namespace limbcast::calibrate {
namespace {

using limbcast::test::Outcome;
using limbcast::test::run_program;
using limbcast::test::TemporaryFolder;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

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

TEST(CalibrateProgram, PassesOverOptionsOfCamerasInTheRobotsFileForARecording) {
  const TemporaryFolder out;
  const std::string frames = out / "frames";
  ASSERT_EQ(run_program("limbcast-simulate", simulated_depth_camera("--output", frames)).exit_code,
            0);
  for (const char* second : {"source-depth", "source-right"}) {
    const std::string config = out.write(
        "robot.conf", "[calibrate]\n" + std::string(second) + " = /dev/video987\ngain = 3\n");
    const Outcome outcome = run_program(
        "limbcast-calibrate", {"mounting", "--config", config, "--source", frames, "--calibration",
                               frames + "/calibration.yml", "--output", out / "mounted.yml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
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

}  // namespace
}  // namespace limbcast::calibrate
