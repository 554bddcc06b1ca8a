#include "common/camera/calibration_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "common/input_error.hpp"
#include "tests/common/camera/calibration_yaml.hpp"

namespace limbcast {
namespace {

using namespace test;
using ::testing::HasSubstr;

TEST_F(StereoCalibrationFile, TellsFisheyeLensesByTheModelThatItNames) {
  const StereoCalibration ordinary =
      read_stereo_calibration(folder_.write("stereo.yml", yaml(opencv_entries())));
  EXPECT_EQ(ordinary.left.model, LensModel::kPinhole);

  const StereoCalibration fisheye =
      read_stereo_calibration(folder_.write("fisheye.yml", yaml(fisheye_entries())));
  EXPECT_EQ(fisheye.left.model, LensModel::kFisheye);
  EXPECT_EQ(fisheye.right.model, LensModel::kFisheye);
  EXPECT_THAT(fisheye.right.distortion, ::testing::ElementsAre(-0.01, 0.03, -0.02, 0.004));
}

TEST_F(StereoCalibrationFile, TellsFisheyeLensesOfRosByEitherNameThatItsCalibratorsWrite) {
  for (const char* model : {"equidistant", "fisheye"}) {
    for (const auto& [name, tx] : {std::pair("left.yaml", "0"), {"right.yaml", "-48"}}) {
      Entries entries = ros_entries(tx);
      entries["distortion_model"] = model;
      entries["distortion_coefficients"] = ros_matrix(1, 4, "-0.01, 0.03, -0.02, 0.004");
      folder_.write(name, yaml(entries, ""));
    }
    const StereoCalibration calibration = read_stereo_calibration(folder_.path());
    EXPECT_EQ(calibration.left.model, LensModel::kFisheye);
    EXPECT_EQ(calibration.right.model, LensModel::kFisheye);
    EXPECT_EQ(calibration.left.distortion.size(), 4U);
  }
}

TEST_F(StereoCalibrationFile, GivesEveryValueOfAnOpenCvFile) {
  const StereoCalibration calibration =
      read_stereo_calibration(folder_.write("stereo.yml", yaml(opencv_entries())));

  EXPECT_EQ(calibration.left.camera.width, 640);
  EXPECT_EQ(calibration.right.camera.height, 480);
  EXPECT_EQ(calibration.left.camera.fx, 500.0);
  EXPECT_EQ(calibration.left.camera.fy, 501.0);
  EXPECT_EQ(calibration.right.camera.cx, 321.0);
  EXPECT_EQ(calibration.right.camera.cy, 241.0);
  EXPECT_THAT(calibration.left.distortion, ::testing::ElementsAre(-0.3, 0.1, 0.001, -0.002, 0.05));
  EXPECT_EQ(calibration.T, Eigen::Vector3d(-0.12, 0.001, -0.002));
  EXPECT_EQ(baseline_m(calibration), 0.12);
  EXPECT_FALSE(calibration.rectification);
  EXPECT_FALSE(calibration.mounting.down);
}

TEST_F(StereoCalibrationFile, GivesMountingWhereTold) {
  Entries entries = opencv_entries();
  entries["down"] = "[ 0., 0.6, 0.8 ]";
  entries["sensor_height_m"] = "1.25";

  const StereoCalibration calibration =
      read_stereo_calibration(folder_.write("stereo.yml", yaml(entries)));

  ASSERT_TRUE(calibration.mounting.down);
  EXPECT_TRUE(calibration.mounting.down->isApprox(Eigen::Vector3d(0.0, 0.6, 0.8)));
  EXPECT_EQ(calibration.mounting.sensor_height_m, 1.25);
}

TEST_F(StereoCalibrationFile, TakesBaselineAndPoseFromARosPair) {
  // The right camera is turned about its axis, so that R and T show which way R2 is used.
  Entries right = ros_entries("-48");
  right["rectification_matrix"] = ros_matrix(3, 3, "0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1");
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("right.yaml", yaml(right, ""));

  const StereoCalibration calibration = read_stereo_calibration(folder_.path());

  EXPECT_EQ(calibration.left.camera.fx, 430.0);
  EXPECT_EQ(calibration.left.distortion.size(), 5U);
  ASSERT_TRUE(calibration.rectification);
  EXPECT_EQ(calibration.rectification->P2(0, 3), -48.0);
  // t = (-48 / 400, 0, 0) in the rectified right camera; T = R2^T t = (row 0 of R2) * -0.12.
  EXPECT_TRUE(calibration.T.isApprox(Eigen::Vector3d(-0.096, 0.072, 0.0))) << calibration.T;
  EXPECT_TRUE(calibration.R.isApprox(calibration.rectification->R2.transpose()));
}

TEST_F(StereoCalibrationFile, FindsTheRightRosFileBesideTheLeft) {
  const std::string left = folder_.write("front_left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("front_right.yaml", yaml(ros_entries("-48"), ""));

  EXPECT_DOUBLE_EQ(baseline_m(read_stereo_calibration(left)), 0.12);
}

TEST_F(StereoCalibrationFile, IsOneOfTwoFilesWhereItIsARosPairs) {
  EXPECT_THAT(calibration_files("a/front_left.yaml"),
              ::testing::ElementsAre("a/front_left.yaml", "a/front_right.yaml"));
  EXPECT_THAT(calibration_files("left/stereo.yml"), ::testing::ElementsAre("left/stereo.yml"));
}

TEST_F(StereoCalibrationFile, NamesAMissingRosPartner) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("has no right.yaml"));
}

TEST_F(StereoCalibrationFile, IsReadWithAByteOrderMark) {
  const std::string path = folder_.write("stereo.yml", "\xEF\xBB\xBF" + yaml(opencv_entries()));
  EXPECT_EQ(baseline_m(read_stereo_calibration(path)), 0.12);
}

TEST_F(StereoCalibrationFile, OfTheRecordedPairsIsRead) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";

  const auto ideal = read_stereo_calibration(data + "/stereo_dev/pointing/calibration.yml");
  EXPECT_DOUBLE_EQ(baseline_m(ideal), 0.12);
  ASSERT_TRUE(ideal.rectification);
  const auto distorted = read_stereo_calibration(data + "/stereo_dev/distorted/calibration.yml");
  EXPECT_NEAR(baseline_m(distorted), 0.12, 1e-4);
  // The board squares of this one have no known size.
  EXPECT_THROW(read_stereo_calibration(data + "/stereo_opencv/calibration.yml"), InputError);
}

class DepthCalibrationFile : public ::testing::Test {
 protected:
  Entries entries_ = {
      {"image_width", "640"},
      {"image_height", "480"},
      {"camera_matrix", matrix(3, 3, "525., 0., 319.5, 0., 525., 239.5, 0., 0., 1.")},
      {"distortion_coefficients", matrix(1, 5, "0., 0., 0., 0., 0.")},
      {"depth_scale", "0.0001"}};
  DepthCalibration read() {
    return read_depth_calibration(folder_.write("depth.yml", yaml(entries_)));
  }
  TemporaryFolder folder_;
};

TEST_F(DepthCalibrationFile, GivesCameraAndScale) {
  const DepthCalibration calibration = read();
  EXPECT_EQ(calibration.color.camera.fx, 525.0);
  EXPECT_EQ(calibration.depth_scale_m, 0.0001);
}

TEST_F(DepthCalibrationFile, MeansMillimetresWhereNoScaleIsTold) {
  entries_.erase("depth_scale");
  EXPECT_EQ(read().depth_scale_m, 0.001);
}

TEST_F(DepthCalibrationFile, TellsAFisheyeAsOpenCvsCalibrationProgramDoes) {
  entries_["distortion_coefficients"] = matrix(4, 1, "0., 0., 0., 0.");
  entries_["fisheye_model"] = "0";
  EXPECT_EQ(read().color.model, LensModel::kPinhole);
  entries_["fisheye_model"] = "1";
  EXPECT_EQ(read().color.model, LensModel::kFisheye);
}

TEST_F(DepthCalibrationFile, RefusesAScaleThatCannotBe) {
  entries_["depth_scale"] = "1000.";
  EXPECT_THAT(error_of<InputError>([&] { read(); }), HasSubstr("'depth_scale' is 1000"));
  entries_["depth_scale"] = "0.";
  EXPECT_THAT(error_of<InputError>([&] { read(); }), HasSubstr("'depth_scale' is 0"));
}

TEST(CalibrationOfTheOtherKind, IsCalledSo) {
  const TemporaryFolder folder;
  const std::string stereo = folder.write("stereo.yml", yaml(opencv_entries()));
  Entries entries = ros_entries("0");
  entries["depth_scale"] = "0.001";
  const std::string depth = folder.write("depth.yml", yaml(entries));

  EXPECT_EQ(error_of<InputError>([&] { read_stereo_calibration(depth); }),
            depth +
                ": is a depth camera's calibration (has 'depth_scale'), for "
                "limbcast-depth-camera; give a stereo camera's");
  EXPECT_EQ(error_of<InputError>([&] { read_depth_calibration(stereo); }),
            stereo +
                ": is a stereo camera's calibration (has 'K1'), for "
                "limbcast-stereo-camera; give a depth camera's");
  EXPECT_THAT(error_of<InputError>([&] { read_depth_calibration(folder.path()); }),
              HasSubstr(": is a folder, as a stereo pair's calibration may be"));
}

TEST_F(DepthCalibrationFile, OfTheRealRecordingsIsRead) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  const auto calibration = read_depth_calibration(data + "/rgbd_pointing/calibration.yml");
  EXPECT_EQ(calibration.color.camera.fx, 617.25);
  EXPECT_EQ(calibration.depth_scale_m, 0.001);
}

}  // namespace
}  // namespace limbcast
