#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/calibration_writer.hpp"
#include "common/camera/yaml_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::TemporaryFolder;

TEST(WrittenStereoCalibration, IsReadAsItWas) {
  StereoCalibration written;
  written.left = {{640, 480, 500.0, 501.0, 320.0, 240.0}, {-0.3, 0.1, 0.001, -0.002, 0.05}};
  written.right = {{640, 480, 510.0, 511.0, 321.0, 241.0}, {}};
  written.T = {-0.12, 0.001, -0.002};
  Rectification rectification;
  rectification.R1 = rectification.R2 = Eigen::Matrix3d::Identity();
  rectification.P1 << 500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0;
  rectification.P2 << 500, 0, 320, -60, 0, 500, 240, 0, 0, 0, 1, 0;
  written.rectification = rectification;
  written.mounting = {Eigen::Vector3d(0.0, 0.8, 0.6), 1.25};
  const TemporaryFolder folder;
  write_stereo_calibration(folder / "c.yml", written);

  const StereoCalibration read = read_stereo_calibration(folder / "c.yml");
  EXPECT_EQ(read.left.camera.fy, 501.0);
  EXPECT_EQ(read.left.distortion, written.left.distortion);
  EXPECT_EQ(read.right.camera.cx, 321.0);
  EXPECT_EQ(read.right.distortion, std::vector<double>(5, 0.0));
  EXPECT_EQ(read.T, written.T);
  ASSERT_TRUE(read.rectification);
  EXPECT_EQ(read.rectification->P2, rectification.P2);
  ASSERT_TRUE(read.mounting.down);
  EXPECT_TRUE(read.mounting.down->isApprox(*written.mounting.down));
  EXPECT_EQ(read.mounting.sensor_height_m, 1.25);
  // Disparity 12 px is 500 * 0.12 / 12 = 5 m: Q (u, v, d, 1) = (x, y, f, d / B).
  const Eigen::Vector4d point =
      YamlReader(folder / "c.yml").matrix("Q", 4, 4) * Eigen::Vector4d(320.0, 240.0, 12.0, 1.0);
  EXPECT_DOUBLE_EQ(point.z() / point.w(), 5.0);
}

TEST(WrittenStereoCalibration, KeepsFisheyeLenses) {
  StereoCalibration written;
  written.left = {
      {640, 480, 224.0, 225.0, 320.0, 240.0}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};
  written.right = {
      {640, 480, 223.0, 224.0, 321.0, 241.0}, {-0.02, 0.02, -0.01, 0.0}, LensModel::kFisheye};
  written.T = {-0.12, 0.001, -0.002};
  const TemporaryFolder folder;
  write_stereo_calibration(folder / "c.yml", written);

  const StereoCalibration read = read_stereo_calibration(folder / "c.yml");
  EXPECT_EQ(read.left.model, LensModel::kFisheye);
  EXPECT_EQ(read.right.model, LensModel::kFisheye);
  EXPECT_EQ(read.left.distortion, written.left.distortion);
  EXPECT_EQ(read.right.distortion, written.right.distortion);
}

const DepthCalibration kWritten{{{640, 480, 500.0, 500.0, 320.0, 240.0}, {}}, {}, 0.001, {}};

TEST(WrittenDepthCalibration, KeepsADepthCameraOfItsOwn) {
  DepthCalibration written = kWritten;
  DepthCamera& camera = written.depth_camera.emplace();
  camera.lens = {{320, 240, 250.0, 251.0, 160.0, 120.0}, {0.1, -0.2, 0.001, 0.002, 0.05}};
  camera.R = Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY()).toRotationMatrix();
  camera.T = {0.015, 0.001, -0.002};
  const TemporaryFolder folder;
  write_depth_calibration(folder / "c.yml", written);

  const DepthCalibration read = read_depth_calibration(folder / "c.yml");
  ASSERT_TRUE(read.depth_camera);
  EXPECT_EQ(read.depth_camera->lens.camera.width, 320);
  EXPECT_EQ(read.depth_camera->lens.camera.fy, 251.0);
  EXPECT_EQ(read.depth_camera->lens.distortion, camera.lens.distortion);
  EXPECT_TRUE(read.depth_camera->R.isApprox(camera.R));
  EXPECT_EQ(read.depth_camera->T, camera.T);
}

TEST(WrittenDepthCalibration, KeepsWhichOfItsLensesIsAFisheye) {
  DepthCalibration written = kWritten;
  DepthCamera& camera = written.depth_camera.emplace();
  camera.lens = {
      {320, 240, 112.0, 112.0, 160.0, 120.0}, {-0.01, 0.03, -0.02, 0.004}, LensModel::kFisheye};
  camera.T = {0.015, 0.001, -0.002};
  const TemporaryFolder folder;
  write_depth_calibration(folder / "depth.yml", written);
  const DepthCalibration depth = read_depth_calibration(folder / "depth.yml");
  EXPECT_EQ(depth.color.model, LensModel::kPinhole);
  EXPECT_EQ(depth.depth_camera->lens.model, LensModel::kFisheye);
  EXPECT_EQ(depth.depth_camera->lens.distortion, camera.lens.distortion);

  std::swap(written.color, camera.lens);
  write_depth_calibration(folder / "color.yml", written);
  const DepthCalibration color = read_depth_calibration(folder / "color.yml");
  EXPECT_EQ(color.color.model, LensModel::kFisheye);
  EXPECT_EQ(color.depth_camera->lens.model, LensModel::kPinhole);
}

TEST(WrittenDepthCalibration, ReachesTheFileThatALinkLeadsTo) {
  const TemporaryFolder folder;
  folder.write("robot.yml", "old");
  std::filesystem::create_symlink(folder / "robot.yml", folder / "link.yml");
  write_depth_calibration(folder / "link.yml", kWritten);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.yml"));
  EXPECT_EQ(read_depth_calibration(folder / "robot.yml").color.camera.fx, 500.0);
}

TEST(WrittenDepthCalibration, LeavesAPipeAPipe) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // NOLINT(*-vararg)
  write_depth_calibration(pipe, kWritten);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::array<char, 5> first{};
  EXPECT_EQ(read(reader, first.data(), first.size()), static_cast<ssize_t>(first.size()));
  EXPECT_EQ(std::string(first.data(), first.size()), "%YAML");
  close(reader);
}

}  // namespace
}  // namespace limbcast
