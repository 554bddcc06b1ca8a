#include "common/camera/calibration_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/common/camera/calibration_yaml.hpp"

namespace limbcast {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

using StereoCalibrationCheck = StereoCalibrationFile;

TEST_F(StereoCalibrationCheck, TellsThatRosCamerasAreSwapped) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("right.yaml", yaml(ros_entries("48"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              AllOf(HasSubstr("right.yaml"), HasSubstr("baseline of -0.12 m"), HasSubstr("swap")));
}

TEST_F(StereoCalibrationCheck, TellsThatRosCamerasWereNotCalibratedAsAPair) {
  folder_.write("left.yaml", yaml(ros_entries("0"), ""));
  folder_.write("right.yaml", yaml(ros_entries("0"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("P[3] is 0"));
}

TEST_F(StereoCalibrationCheck, RefusesAModelThatItDoesNotKnow) {
  EXPECT_THAT(error_with("distortion_model", "omnidir"),
              HasSubstr("stereo.yml: 'distortion_model' is 'omnidir'; calibrate with plumb_bob, "
                        "rational_polynomial or equidistant"));
}

TEST_F(StereoCalibrationCheck, RefusesAFisheyeBesideAnOrdinaryLens) {
  Entries left = ros_entries("0");
  left["distortion_model"] = "equidistant";
  left["distortion_coefficients"] = ros_matrix(1, 4, "0.01, 0.02, -0.01, 0.002");
  folder_.write("left.yaml", yaml(left, ""));
  folder_.write("right.yaml", yaml(ros_entries("-48"), ""));

  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              AllOf(HasSubstr("right.yaml: 'distortion_model' differs from "),
                    HasSubstr("left.yaml"), HasSubstr("with the same model")));
}

TEST_F(StereoCalibrationCheck, RefusesAFisheyeOfOtherThanFourCoefficients) {
  const std::string kAdvice = "; of a fisheye (equidistant) must be 4: k1 k2 k3 k4";
  EXPECT_THAT(error_with("distortion_model", "equidistant"),
              HasSubstr("stereo.yml: 'D1' has 5 coefficients" + kAdvice));
  Entries entries = fisheye_entries();
  entries["D2"] = matrix(1, 0, "");
  EXPECT_THAT(error_of_file(yaml(entries)), HasSubstr("'D2' has 0 coefficients" + kAdvice));
  entries.erase("D2");
  EXPECT_THAT(error_of_file(yaml(entries)), HasSubstr("'D2'"));
}

TEST_F(StereoCalibrationCheck, RefusesAFisheyeThatFoldsTheImage) {
  Entries entries = fisheye_entries();
  // a (1 - a^6 / 7) is greatest at 1 rad: 6 / 7 of 224 px.
  entries["D1"] = matrix(1, 4, "0., 0., -0.14285714286, 0.");
  EXPECT_THAT(error_of_file(yaml(entries)),
              HasSubstr("'D1' folds the image: 192 px from its middle it ends"));
}

TEST_F(StereoCalibrationCheck, AcceptsAFisheyeWhoseImageReachesBeyond90Degrees) {
  Entries entries = fisheye_entries();
  entries["K1"] = entries["K2"] = matrix(3, 3, "180., 0., 320., 0., 180., 240., 0., 0., 1.");
  EXPECT_NO_THROW(read_stereo_calibration(folder_.write("wide.yml", yaml(entries))));
}

TEST_F(StereoCalibrationCheck, TellsThatCamerasAreSwapped) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "0.12, 0., 0.")),
              AllOf(HasSubstr("stereo.yml: 'T'"), HasSubstr("-0.12 m, must be > 0"),
                    HasSubstr("swap the left and right cameras")));
}

TEST_F(StereoCalibrationCheck, RefusesABaselineInMillimetres) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-120., 0., 0.")),
              HasSubstr("in metres, not millimetres"));
}

TEST_F(StereoCalibrationCheck, RefusesCamerasAboveOneAnother) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-0.01, 0.12, 0.")), HasSubstr("side by side"));
}

TEST_F(StereoCalibrationCheck, RefusesCamerasInFrontOfOneAnother) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-0.001, 0., 4.9")),
              HasSubstr("'T' puts one camera in front of the other; mount them side by side"));
}

TEST_F(StereoCalibrationCheck, RefusesCamerasThatLookAnotherWay) {
  EXPECT_THAT(error_with("R", matrix(3, 3, "-1., 0., 0., 0., 1., 0., 0., 0., -1.")),
              HasSubstr("'R' turns the cameras by 180 degrees; must be at most 60"));
  EXPECT_THAT(error_with("R", matrix(3, 3, "0., -1., 0., 1., 0., 0., 0., 0., 1.")),
              HasSubstr("'R' turns the cameras by 90 degrees; must be at most 60"));
}

TEST_F(StereoCalibrationCheck, RefusesLensesThatAreNotAlike) {
  EXPECT_THAT(error_with("K2", matrix(3, 3, "5., 0., 320., 0., 5., 240., 0., 0., 1.")),
              HasSubstr("'K2' has a focal length of 5 px, the left camera 500"));
  EXPECT_THAT(error_with("K2", matrix(3, 3, "1001., 0., 320., 0., 1001., 240., 0., 0., 1.")),
              HasSubstr("'K2' has a focal length of 1001 px, the left camera 500"));
}

TEST_F(StereoCalibrationCheck, RefusesAPrincipalPointThatNobodyWrote) {
  const std::string kAdvice =
      "; neither may be exactly 0, which is written where it is not known; calibrate again";
  EXPECT_THAT(error_with("K1", matrix(3, 3, "500., 0., 0., 0., 500., 0., 0., 0., 1.")),
              HasSubstr("stereo.yml: 'K1' has its principal point at (0, 0)" + kAdvice));
  EXPECT_THAT(error_with("K2", matrix(3, 3, "500., 0., 0., 0., 500., 240., 0., 0., 1.")),
              HasSubstr("stereo.yml: 'K2' has its principal point at (0, 240)" + kAdvice));
  EXPECT_THAT(error_with("K2", matrix(3, 3, "500., 0., 320., 0., 500., 0., 0., 0., 1.")),
              HasSubstr("stereo.yml: 'K2' has its principal point at (320, 0)" + kAdvice));
}

TEST_F(StereoCalibrationCheck, RefusesARectificationThatDoesNotBelongToTheCameras) {
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
  EXPECT_THAT(error_of_file(with_projections("0.", "-60.")),
              HasSubstr("'P1' has its principal point at (0, 240); neither may be exactly 0"));
  EXPECT_THAT(error_of_file(with_projections("320.", "-64.")),
              HasSubstr("'P2' has a baseline of 0.128 m, 'T' of 0.120021 m"));
}

TEST_F(StereoCalibrationCheck, RefusesARectificationOfOtherRowsOrFocalLengths) {
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

TEST_F(StereoCalibrationCheck, RefusesAMatrixOfNoCamera) {
  for (const char* data :
       {"500., 0., 320., 0., 501., 240., 0., 0., 2.", "500., 50., 320., 0., 501., 240., 0., 0., 1.",
        "500., 0., 320., 0., 501., 240., 0., 1., 1."})
    EXPECT_THAT(error_with("K1", matrix(3, 3, data)), HasSubstr("'K1' is no camera matrix"));
  EXPECT_THAT(error_with("K1", matrix(3, 3, "500., 0., 320., 0., 1., 240., 0., 0., 1.")),
              HasSubstr("'K1' has focal lengths 500 and 1 px"));
}

TEST_F(StereoCalibrationCheck, RefusesADistortionThatFoldsTheImage) {
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

TEST_F(StereoCalibrationCheck, RefusesABaselineOfNothing) {
  EXPECT_THAT(error_with("T", matrix(3, 1, "-1e-9, 0., 0.")),
              HasSubstr("'T' gives a baseline of 1e-09 m; write it in metres"));
}

TEST_F(StereoCalibrationCheck, RefusesAHeightOfNoRobot) {
  EXPECT_THAT(error_with("sensor_height_m", "1e9"),
              HasSubstr("'sensor_height_m' is 1e+09; must be > 0 and <= 100 metres"));
}

TEST_F(StereoCalibrationCheck, RefusesAFolderInPlaceOfARosFile) {
  std::filesystem::create_directory(folder_ / "left.yaml");
  folder_.write("right.yaml", yaml(ros_entries("-48"), ""));
  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_.path()); }),
              HasSubstr("left.yaml: is a folder; give a calibration file"));
}

TEST_F(StereoCalibrationCheck, RefusesARotationThatIsNone) {
  EXPECT_THAT(error_with("R", matrix(3, 3, "1.1, 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R' is not a rotation"));
  EXPECT_THAT(error_with("R", matrix(3, 3, "-1., 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R' is not a rotation"));
}

TEST_F(StereoCalibrationCheck, RefusesARotationThatIsNotSquare) {
  EXPECT_THAT(error_with("R", matrix(3, 1, "0.1, 0.2, 0.3")),
              HasSubstr("'R' is 3 x 1; must be 3 x 3"));
}

TEST_F(StereoCalibrationCheck, CountsTheNumbersOfAMatrixThatTellsTheRightSize) {
  EXPECT_THAT(error_with("R", matrix(3, 3, "1., 0.")),
              HasSubstr("'R' has 2 numbers; must be 3 x 3"));
}

TEST_F(StereoCalibrationCheck, TellsTheLineThatIsNoYaml) {
  const auto error = [this](const std::string& text) {
    return error_of<InputError>([&] { read_stereo_calibration(folder_.write("c.yml", text)); });
  };
  EXPECT_THAT(
      error("%YAML:1.0\n---\nK1:\n\t- 5\n"),
      HasSubstr("c.yml: is no valid YAML (line 4: Tabs are prohibited in YAML!); calibrate"));
  EXPECT_THAT(error("K1:\n\t- 5\n"), HasSubstr("(line 2: Tabs are prohibited"));
}

TEST_F(StereoCalibrationCheck, RefusesNumbersThatAreNotFinite) {
  EXPECT_THAT(error_with("K1", matrix(3, 3, ".Nan, 0., 320., 0., 501., 240., 0., 0., 1.")),
              HasSubstr("'K1' holds a value that is no finite number"));
  EXPECT_THAT(error_with("D1", matrix(1, 5, "0., .Inf, 0., 0., 0.")), HasSubstr("'D1' holds"));
}

TEST_F(StereoCalibrationCheck, RefusesACalibrationOfAnotherImageSize) {
  EXPECT_THAT(error_with("image_width", "320"), HasSubstr("outside the image of 320x480"));
}

TEST_F(StereoCalibrationCheck, RefusesAFocalLengthOfZero) {
  EXPECT_THAT(error_with("K2", matrix(3, 3, "0., 0., 320., 0., 501., 240., 0., 0., 1.")),
              HasSubstr("both must be > 0"));
}

TEST_F(StereoCalibrationCheck, RefusesAnUnknownNumberOfDistortionCoefficients) {
  EXPECT_THAT(error_with("D2", matrix(1, 3, "0., 0., 0.")),
              HasSubstr("must be 0, 4, 5, 8, 12 or 14"));
}

TEST_F(StereoCalibrationCheck, RefusesSizesThatCannotBe) {
  EXPECT_THAT(error_with("image_height", "-480"), HasSubstr("'image_height' is -480"));
  EXPECT_THAT(error_with("image_height", "480.5"), HasSubstr("not a whole number"));
}

TEST_F(StereoCalibrationCheck, TellsLongNumbersAsTheyStandInTheFile) {
  EXPECT_THAT(error_with("image_width", "99999999999"),
              HasSubstr("'image_width' is 99999999999; must be 1 to 8192 px"));
  // 2^32 + 480 would be wrapped to 480, 2^32 + 1 to 1.
  EXPECT_THAT(error_with("image_height", "4294967776"), HasSubstr("is 4294967776; must be"));
  EXPECT_THAT(error_with("sensor_height_m", "4294967297"),
              HasSubstr("'sensor_height_m' is 4.29497e+09; must be"));
  EXPECT_THAT(error_with("T", "[ -4294967296, 0, 0 ]"), HasSubstr("of 4.29497e+09 m"));
  EXPECT_THAT(error_of_file("{\"image_width\": 99999999999}"),
              HasSubstr("is 99999999999; must be"));
  EXPECT_THAT(error_of_file("<?xml version=\"1.0\"?>\n<opencv_storage><image_width>99999999999"
                            "</image_width></opencv_storage>\n"),
              HasSubstr("is 99999999999; must be"));
}

TEST_F(StereoCalibrationCheck, TakesALongSerialNumberForNoSize) {
  Entries entries = opencv_entries();
  entries["camera_name"] = "740112071234";
  entries["serials"] = "[ 740112071234,740112071235 ]";
  EXPECT_NO_THROW(read_stereo_calibration(folder_.write("stereo.yml", yaml(entries))));
}

TEST_F(StereoCalibrationCheck, NamesEveryMissingKey) {
  for (const auto& [key, value] : opencv_entries()) {
    if (key == "D1" || key == "D2") continue;  // none = no distortion
    Entries entries = opencv_entries();
    entries.erase(key);
    EXPECT_THAT(error_of_file(yaml(entries)), HasSubstr("'" + key + "' is missing")) << key;
  }
}

TEST_F(StereoCalibrationCheck, WantsAllOfTheRectificationOrNone) {
  EXPECT_THAT(error_with("R1", matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.")),
              HasSubstr("'R2' is missing"));
}

TEST_F(StereoCalibrationCheck, RefusesGravityThatIsNoUnitVector) {
  EXPECT_THAT(error_with("down", "[ 0., 9.81, 0. ]"), HasSubstr("must be a unit vector"));
}

TEST_F(StereoCalibrationCheck, RefusesFilesThatAreNoCalibration) {
  EXPECT_THAT(error_of_file(""), HasSubstr("is empty"));
  EXPECT_THAT(
      error_of_file("%YAML:1.0\n---\nK1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                    "   data: [ 5.2060000"),
      HasSubstr("stereo.yml"));
  EXPECT_THAT(error_of_file("\xFF\xD8\xFF\xE0 a picture"), HasSubstr("stereo.yml"));
  EXPECT_THAT(error_of<InputError>([&] { read_stereo_calibration(folder_ / "none.yml"); }),
              HasSubstr("none.yml: cannot be read"));
}

}  // namespace
}  // namespace limbcast
