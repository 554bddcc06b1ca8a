#include "common/camera/calibration_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::error_of;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

using Entries = std::map<std::string, std::string>;

std::string matrix(int rows, int cols, const std::string& data) {
  return "!!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(cols) + "\n   dt: d\n   data: [ " + data + " ]";
}

Entries opencv_entries() {
  return {{"image_width", "640"},
          {"image_height", "480"},
          {"K1", matrix(3, 3, "500., 0., 320., 0., 501., 240., 0., 0., 1.")},
          {"D1", matrix(1, 5, "-0.3, 0.1, 0.001, -0.002, 0.05")},
          {"K2", matrix(3, 3, "510., 0., 321., 0., 511., 241., 0., 0., 1.")},
          {"D2", matrix(1, 5, "0., 0., 0., 0., 0.")},
          {"R", matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.")},
          {"T", matrix(3, 1, "-0.12, 0.001, -0.002")}};
}

std::string yaml(const Entries& entries, const std::string& header = "%YAML:1.0\n---\n") {
  std::string text = header;
  for (const auto& [key, value] : entries) text.append(key).append(": ").append(value).append("\n");
  return text;
}

std::string ros_matrix(int rows, int cols, const std::string& data) {
  return "\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(cols) + "\n  data: [" +
         data + "]";
}

Entries ros_entries(const std::string& tx) {
  return {{"image_width", "640"},
          {"image_height", "480"},
          {"camera_name", "stereo/left"},
          {"camera_matrix", ros_matrix(3, 3, "430.0, 0, 310.5, 0, 431.0, 239.5, 0, 0, 1")},
          {"distortion_model", "plumb_bob"},
          {"distortion_coefficients", ros_matrix(1, 5, "-0.36, 0.16, 0.0001, -0.0002, 0")},
          {"rectification_matrix", ros_matrix(3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1")},
          {"projection_matrix",
           ros_matrix(3, 4, "400, 0, 315, " + tx + ", 0, 400, 240, 0, 0, 0, 1, 0")}};
}

class StereoCalibrationFile : public ::testing::Test {
 protected:
  std::string error_with(const std::string& key, const std::string& value) {
    Entries entries = opencv_entries();
    entries[key] = value;
    return error_of_file(yaml(entries));
  }
  std::string error_of_file(const std::string& text) {
    const std::string path = folder_.write("stereo.yml", text);
    return error_of<InputError>([&] { read_stereo_calibration(path); });
  }
  TemporaryFolder folder_;
};

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

TEST_F(StereoCalibrationFile, TellsThatRosCamerasAreSwapped) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("right.yaml", yaml(ros_entries("48"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              AllOf(HasSubstr("right.yaml"), HasSubstr("baseline of -0.12 m"), HasSubstr("swap")));
}

TEST_F(StereoCalibrationFile, TellsThatRosCamerasWereNotCalibratedAsAPair) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("right.yaml", yaml(ros_entries("0"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("P[3] is 0"));
}

TEST_F(StereoCalibrationFile, NamesAMissingRosPartner) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("has no right.yaml"));
}

TEST_F(StereoCalibrationFile, RefusesAFisheyeModel) {
  Entries left = ros_entries("0");
  left["distortion_model"] = "equidistant";
  folder_.write("left.yaml", yaml(left, ""));
  folder_.write("right.yaml", yaml(ros_entries("-48"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("'distortion_model' is 'equidistant'"));
}

TEST_F(StereoCalibrationFile, TellsThatCamerasAreSwapped) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "0.12, 0., 0.")),
              AllOf(HasSubstr("stereo.yml: 'T'"), HasSubstr("-0.12 m, must be > 0"),
                    HasSubstr("swap the left and right cameras")));
}

TEST_F(StereoCalibrationFile, RefusesABaselineInMillimetres) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-120., 0., 0.")),
              HasSubstr("in metres, not millimetres"));
}

TEST_F(StereoCalibrationFile, RefusesCamerasAboveOneAnother) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-0.01, 0.12, 0.")), HasSubstr("side by side"));
}

TEST_F(StereoCalibrationFile, RefusesCamerasInFrontOfOneAnother) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-0.001, 0., 4.9")),
              HasSubstr("'T' puts one camera in front of the other; mount them side by side"));
}

TEST_F(StereoCalibrationFile, RefusesCamerasThatLookAnotherWay) {
  EXPECT_THAT(error_with("R", matrix(3, 3, "-1., 0., 0., 0., 1., 0., 0., 0., -1.")),
              HasSubstr("'R' turns the cameras by 180 degrees; must be at most 60"));
  EXPECT_THAT(error_with("R", matrix(3, 3, "0., -1., 0., 1., 0., 0., 0., 0., 1.")),
              HasSubstr("'R' turns the cameras by 90 degrees; must be at most 60"));
}

TEST_F(StereoCalibrationFile, RefusesLensesThatAreNotAlike) {
  EXPECT_THAT(error_with("K2", matrix(3, 3, "5., 0., 320., 0., 5., 240., 0., 0., 1.")),
              HasSubstr("'K2' has a focal length of 5 px, the left camera 500"));
  EXPECT_THAT(error_with("K2", matrix(3, 3, "1001., 0., 320., 0., 1001., 240., 0., 0., 1.")),
              HasSubstr("'K2' has a focal length of 1001 px, the left camera 500"));
}

TEST_F(StereoCalibrationFile, RefusesARectificationThatDoesNotBelongToTheCameras) {
  const auto with_projections = [](const std::string& cx, const std::string& offset) {
    const std::string identity = matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.");
    Entries entries = opencv_entries();
    entries["R1"] = entries["R2"] = identity;
    entries["P1"] = matrix(3, 4, "500., 0., " + cx + ", 0., 0., 500., 240., 0., 0., 0., 1., 0.");
    entries["P2"] =
        matrix(3, 4, "500., 0., 320., " + offset + ", 0., 500., 240., 0., 0., 0., 1., 0.");
    return yaml(entries);
  };
  // 500 px * 0.12 m = 60; cv::stereoRectify may put the principal point beside the image.
  const std::string usual = folder_.write("usual.yml", with_projections("-100.", "-60."));
  EXPECT_TRUE(read_stereo_calibration(usual).rectification);
  EXPECT_THAT(
      error_of_file(with_projections("5000.", "-60.")),
      HasSubstr("'P1' has its principal point (5000, 240) far outside the image of 640x480"));
  EXPECT_THAT(error_of_file(with_projections("320.", "-64.")),
              HasSubstr("'P2' has a baseline of 0.128 m, 'T' of 0.120021 m"));
}

TEST_F(StereoCalibrationFile, RefusesARectificationOfOtherRowsOrFocalLengths) {
  const auto error_of_right = [this](const std::string& fx, const std::string& fy,
                                     const std::string& cy) {
    Entries entries = opencv_entries();
    entries["R1"] = entries["R2"] = matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.");
    entries["P1"] = matrix(3, 4, "500., 0., 320., 0., 0., 500., 240., 0., 0., 0., 1., 0.");
    entries["P2"] =
        matrix(3, 4, fx + ", 0., 320., -60., 0., " + fy + ", " + cy + ", 0., 0., 0., 1., 0.");
    return error_of_file(yaml(entries));
  };
  const std::string kOther = "'P2' has another focal length or other rows";
  EXPECT_THAT(error_of_right("510.", "500.", "240."), HasSubstr(kOther));
  EXPECT_THAT(error_of_right("500.", "510.", "240."), HasSubstr(kOther));
  EXPECT_THAT(error_of_right("500.", "500.", "241."), HasSubstr(kOther));
  EXPECT_THAT(error_of_right("500.", "0.", "240."), HasSubstr("'P2' has no focal length > 0"));
  EXPECT_THAT(error_of_right("0.5", "0.5", "240."),
              HasSubstr("'P2' has a focal length of 0.5 px, the lens 510"));
}

TEST_F(StereoCalibrationFile, RefusesAMatrixOfNoCamera) {
  for (const char* data :
       {"500., 0., 320., 0., 501., 240., 0., 0., 2.", "500., 50., 320., 0., 501., 240., 0., 0., 1.",
        "500., 0., 320., 0., 501., 240., 0., 1., 1."})
    EXPECT_THAT(error_with("K1", matrix(3, 3, data)), HasSubstr("'K1' is no camera matrix"));
  EXPECT_THAT(error_with("K1", matrix(3, 3, "500., 0., 320., 0., 1., 240., 0., 0., 1.")),
              HasSubstr("'K1' has focal lengths 500 and 1 px"));
}

TEST_F(StereoCalibrationFile, RefusesADistortionThatFoldsTheImage) {
  // 0.4 + 8 * 0.4^3 - 60 * 0.4^5 + 100 * 0.4^7 = 0.46; from there on it falls.
  EXPECT_THAT(error_with("D1", matrix(1, 5, "8., -60., 0., 0., 100.")),
              HasSubstr("'D1' folds the image: 231 px from its middle it ends"));
  EXPECT_THAT(error_with("D2", matrix(1, 5, "1e6, -1e9, 5., 5., 1e12")),
              HasSubstr("'D2' stretches the image more than 3 times"));
  Entries wide = opencv_entries();
  wide["K1"] = matrix(3, 3, "320., 0., 320., 0., 320., 240., 0., 0., 1.");  // 120 degrees
  wide["D1"] = matrix(1, 8, "0.5, 0.02, 0., 0., 0., 0.9, 0.1, 0.");
  EXPECT_NO_THROW(read_stereo_calibration(folder_.write("wide.yml", yaml(wide))));
}

TEST_F(StereoCalibrationFile, RefusesABaselineOfNothing) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-1e-9, 0., 0.")),
              HasSubstr("'T' gives a baseline of 1e-09 m; write it in metres"));
}

TEST_F(StereoCalibrationFile, RefusesAHeightOfNoRobot) {
  EXPECT_THAT(error_with("sensor_height_m", "1e9"),
              HasSubstr("'sensor_height_m' is 1e+09; must be > 0 and <= 100 metres"));
}

TEST_F(StereoCalibrationFile, IsReadWithAByteOrderMark) {
  const std::string path = folder_.write("stereo.yml", "\xEF\xBB\xBF" + yaml(opencv_entries()));
  EXPECT_EQ(baseline_m(read_stereo_calibration(path)), 0.12);
}

TEST_F(StereoCalibrationFile, RefusesAFolderInPlaceOfARosFile) {
  std::filesystem::create_directory(folder_ / "left.yaml");
  folder_.write("right.yaml", yaml(ros_entries("-48"), ""));
  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("left.yaml: is a folder; give a calibration file"));
}

TEST_F(StereoCalibrationFile, RefusesARotationThatIsNone) {
  EXPECT_THAT(error_with("R", matrix(3, 3, "1.1, 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R' is not a rotation"));
  EXPECT_THAT(error_with("R", matrix(3, 3, "-1., 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R' is not a rotation"));
}

TEST_F(StereoCalibrationFile, RefusesARotationThatIsNotSquare) {
  EXPECT_THAT(error_with("R", matrix(3, 1, "0.1, 0.2, 0.3")),
              HasSubstr("'R' is 3 x 1; must be 3 x 3"));
}

TEST_F(StereoCalibrationFile, RefusesNumbersThatAreNotFinite) {
  EXPECT_THAT(error_with("K1", matrix(3, 3, ".Nan, 0., 320., 0., 501., 240., 0., 0., 1.")),
              HasSubstr("'K1' holds a value that is no finite number"));
  EXPECT_THAT(error_with("D1", matrix(1, 5, "0., .Inf, 0., 0., 0.")), HasSubstr("'D1' holds"));
}

TEST_F(StereoCalibrationFile, RefusesACalibrationOfAnotherImageSize) {
  EXPECT_THAT(error_with("image_width", "320"), HasSubstr("outside the image of 320x480"));
}

TEST_F(StereoCalibrationFile, RefusesAFocalLengthOfZero) {
  EXPECT_THAT(error_with("K2", matrix(3, 3, "0., 0., 320., 0., 501., 240., 0., 0., 1.")),
              HasSubstr("both must be > 0"));
}

TEST_F(StereoCalibrationFile, RefusesAnUnknownNumberOfDistortionCoefficients) {
  EXPECT_THAT(error_with("D2", matrix(1, 3, "0., 0., 0.")),
              HasSubstr("must be 0, 4, 5, 8, 12 or 14"));
}

TEST_F(StereoCalibrationFile, RefusesSizesThatCannotBe) {
  EXPECT_THAT(error_with("image_height", "-480"), HasSubstr("'image_height' is -480"));
  EXPECT_THAT(error_with("image_height", "480.5"), HasSubstr("not a whole number"));
}

TEST_F(StereoCalibrationFile, NamesEveryMissingKey) {
  for (const auto& [key, value] : opencv_entries()) {
    if (key == "D1" || key == "D2") continue;  // none = no distortion
    Entries entries = opencv_entries();
    entries.erase(key);
    EXPECT_THAT(error_of_file(yaml(entries)), HasSubstr("'" + key + "' is missing")) << key;
  }
}

TEST_F(StereoCalibrationFile, WantsAllOfTheRectificationOrNone) {
  EXPECT_THAT(error_with("R1", matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R2' is missing"));
}

TEST_F(StereoCalibrationFile, RefusesGravityThatIsNoUnitVector) {
  EXPECT_THAT(error_with("down", "[ 0., 9.81, 0. ]"), HasSubstr("must be a unit vector"));
}

TEST_F(StereoCalibrationFile, RefusesFilesThatAreNoCalibration) {
  EXPECT_THAT(error_of_file(""), HasSubstr("is empty"));
  EXPECT_THAT(
      error_of_file("%YAML:1.0\n---\nK1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                    "   data: [ 5.2060000"),
      HasSubstr("stereo.yml"));
  EXPECT_THAT(error_of_file("\xFF\xD8\xFF\xE0 a picture"), HasSubstr("stereo.yml"));
  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_ / "none.yml"); }),
              HasSubstr("none.yml: cannot be read"));
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
