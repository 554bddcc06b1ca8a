#include "common/camera/calibration_reader.hpp"

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "common/camera/calibration_checks.hpp"
#include "common/camera/rotation_check.hpp"
#include "common/camera/yaml_reader.hpp"
#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast {
namespace {

namespace fs = std::filesystem;

/// Above this a height is taken for one in millimetres or a mistyped one [m].
constexpr double kLargestSensorHeight_m = 100.0;

int read_size(const YamlReader& yaml, const std::string& key) {
  const double size_px = yaml.integer(key);
  if (!(size_px >= 1.0 && size_px <= kMaxImageSide)) {
    yaml.fail(key, formatted("is %.0f", size_px),
              "must be 1 to " + std::to_string(kMaxImageSide) + " px");
  }
  return static_cast<int>(size_px);
}

/// The name that ROS has for a model; what OpenCV's calibration program writes is understood too.
/// A pinhole where the file does not say.
LensModel read_model(const YamlReader& yaml, const std::string& prefix) {
  const std::string key = prefix + "distortion_model";
  if (!yaml.has(key)) {
    const std::string flag = prefix + "fisheye_model";
    return yaml.has(flag) && yaml.number(flag) != 0.0 ? LensModel::kFisheye : LensModel::kPinhole;
  }
  const std::string model = yaml.text(key);
  if (model == "plumb_bob" || model == "rational_polynomial") return LensModel::kPinhole;
  // Some versions of ROS' calibrator call it "fisheye".
  if (model == kFisheyeName || model == "fisheye") return LensModel::kFisheye;
  yaml.fail(key, "is '" + model + "'",
            "calibrate with plumb_bob, rational_polynomial or " + std::string(kFisheyeName));
}

std::vector<double> read_distortion(const YamlReader& yaml, const std::string& key,
                                    LensModel model) {
  std::vector<double> coefficients = yaml.numbers(key);
  const std::string found = "has " + std::to_string(coefficients.size()) + " coefficients";
  if (model == LensModel::kFisheye) {
    if (coefficients.size() == kFisheyeCoefficients) return coefficients;
    yaml.fail(key, found, "of a fisheye (equidistant) must be 4: k1 k2 k3 k4");
  }
  for (const std::size_t count : {0U, 4U, 5U, 8U, 12U, 14U}) {
    if (coefficients.size() == count) return coefficients;
  }
  yaml.fail(key, found, "must be 0, 4, 5, 8, 12 or 14");
}

/// `prefix`: of the keys of the image's size and the lens' model.
LensCalibration read_lens(const YamlReader& yaml, const std::string& matrix_key,
                          const std::string& distortion_key, const std::string& prefix = "") {
  const int width = read_size(yaml, prefix + "image_width");
  const int height = read_size(yaml, prefix + "image_height");
  LensCalibration lens;
  lens.camera = checked_pinhole(yaml, matrix_key, width, height,
                                Eigen::Matrix3d(yaml.matrix(matrix_key, 3, 3)));
  lens.model = read_model(yaml, prefix);
  // Without its coefficients a fisheye is another lens.
  if (yaml.has(distortion_key) || lens.model == LensModel::kFisheye) {
    lens.distortion = read_distortion(yaml, distortion_key, lens.model);
    check_distortion(yaml, distortion_key, lens);
  }
  return lens;
}

Eigen::Matrix3d read_rotation(const YamlReader& yaml, const std::string& key) {
  Eigen::Matrix3d R = yaml.matrix(key, 3, 3);
  const double deviation = deviation_from_rotation(R);
  if (!(deviation <= kRotationTolerance)) {
    yaml.fail(key, "is not a rotation (off by " + text_of(deviation) + ")", "calibrate again");
  }
  return R;
}

Mounting read_mounting(const YamlReader& yaml) {
  Mounting mounting;
  if (yaml.has("down")) {
    const Eigen::Vector3d down = yaml.matrix("down", 3, 1);
    // A unit vector that was written with few digits still has about this length.
    if (std::abs(down.norm() - 1.0) > 0.05) {
      yaml.fail("down", "has length " + text_of(down.norm()), "must be a unit vector");
    }
    mounting.down = down.normalized();
  }
  if (yaml.has("sensor_height_m")) {
    const double height_m = yaml.number("sensor_height_m");
    if (height_m <= 0.0 || height_m > kLargestSensorHeight_m) {
      yaml.fail("sensor_height_m", "is " + text_of(height_m),
                "must be > 0 and <= " + text_of(kLargestSensorHeight_m) + " metres");
    }
    mounting.sensor_height_m = height_m;
  }
  return mounting;
}

std::optional<Rectification> read_rectification(const YamlReader& yaml,
                                                const StereoCalibration& calibration) {
  if (!yaml.has("R1") && !yaml.has("R2") && !yaml.has("P1") && !yaml.has("P2")) return std::nullopt;
  Rectification rectification;
  rectification.R1 = read_rotation(yaml, "R1");
  rectification.R2 = read_rotation(yaml, "R2");
  rectification.P1 = yaml.matrix("P1", 3, 4);
  rectification.P2 = yaml.matrix("P2", 3, 4);
  check_rectified(yaml, "P1", rectification.P1, calibration.left.camera);
  check_rectified(yaml, "P2", rectification.P2, calibration.right.camera);
  check_rows_match(yaml, "P2", rectification);
  check_baseline(yaml, "P2", {rectification.P2(0, 3) / rectification.P2(0, 0), 0.0, 0.0});
  check_same_baseline(yaml, calibration.T, rectification.P2);
  return rectification;
}

StereoCalibration read_opencv_stereo(const YamlReader& yaml) {
  StereoCalibration calibration;
  const std::string right_key = yaml.first_of({"K2", "M2"});
  calibration.left = read_lens(yaml, yaml.first_of({"K1", "M1"}), "D1");
  calibration.right = read_lens(yaml, right_key, "D2");
  calibration.R = read_rotation(yaml, "R");
  calibration.T = yaml.matrix("T", 3, 1);
  check_baseline(yaml, "T", calibration.T);
  check_alike(yaml, right_key, "R", calibration);
  calibration.rectification = read_rectification(yaml, calibration);
  calibration.mounting = read_mounting(yaml);
  return calibration;
}

LensCalibration read_ros_lens(const YamlReader& yaml) {
  return read_lens(yaml, "camera_matrix", "distortion_coefficients");
}

std::optional<DepthCamera> read_depth_camera(const YamlReader& yaml) {
  if (!yaml.has("depth_camera_matrix")) return std::nullopt;
  DepthCamera camera;
  camera.lens = read_lens(yaml, "depth_camera_matrix", "depth_distortion_coefficients", "depth_");
  camera.R = read_rotation(yaml, "R");
  camera.T = yaml.matrix("T", 3, 1);
  check_near(yaml, "T", camera.T);
  return camera;
}

StereoCalibration read_ros_pair(const YamlReader& left, const YamlReader& right) {
  StereoCalibration calibration;
  calibration.left = read_ros_lens(left);
  calibration.right = read_ros_lens(right);
  if (calibration.left.camera.width != calibration.right.camera.width ||
      calibration.left.camera.height != calibration.right.camera.height) {
    right.fail("image_width", "and image_height differ from " + left.path(),
               "give two calibrations of the same image size");
  }
  if (calibration.left.model != calibration.right.model) {
    right.fail("distortion_model", "differs from " + left.path() + ": one is a fisheye's",
               "calibrate both cameras with the same model");
  }
  Rectification rectification;
  rectification.R1 = read_rotation(left, "rectification_matrix");
  rectification.R2 = read_rotation(right, "rectification_matrix");
  rectification.P1 = left.matrix("projection_matrix", 3, 4);
  rectification.P2 = right.matrix("projection_matrix", 3, 4);
  check_rectified(left, "projection_matrix", rectification.P1, calibration.left.camera);
  check_rectified(right, "projection_matrix", rectification.P2, calibration.right.camera);
  if (rectification.P2(0, 3) == 0.0) {
    right.fail("projection_matrix", "has no baseline (P[3] is 0)",
               "calibrate the two as a stereo pair");
  }
  check_rows_match(right, "projection_matrix", rectification);
  const Eigen::Vector3d t_rectified{rectification.P2(0, 3) / rectification.P2(0, 0), 0.0, 0.0};
  check_baseline(right, "projection_matrix", t_rectified);
  // p_rect_right = p_rect_left + t, with p_rect_left = R1 p_left and p_rect_right = R2 p_right.
  calibration.R = rectification.R2.transpose() * rectification.R1;
  calibration.T = rectification.R2.transpose() * t_rectified;
  check_alike(right, "camera_matrix", "rectification_matrix", calibration);
  calibration.rectification = rectification;
  calibration.mounting = read_mounting(left);
  return calibration;
}

/// The existing file of that stem in `folder`, .yaml or .yml.
fs::path yaml_in(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".yaml", ".yml"}) {
    fs::path path = folder / (stem + extension);
    if (fs::exists(path)) return path;
  }
  throw InputError(folder.string() + ": has no " + stem +
                   ".yaml; give a folder with left.yaml and " +
                   "right.yaml, or a calibration file");
}

std::optional<fs::path> right_of(const fs::path& left) {
  std::string name = left.filename().string();
  const std::size_t place = name.rfind("left");
  if (place == std::string::npos) return std::nullopt;
  name.replace(place, 4, "right");
  return left.parent_path() / name;
}

/// Recordings of both kinds of camera have a calibration.yml.
void check_is_stereo(const YamlReader& yaml) {
  for (const char* key : {"depth_scale", "depth_camera_matrix"}) {
    if (yaml.has(key))
      throw InputError(yaml.path() + ": is a depth camera's calibration (has '" + key +
                       "'), for limbcast-depth-camera; give a stereo camera's");
  }
}

void check_is_depth(const YamlReader& yaml) {
  const std::string key = yaml.first_of({"K1", "M1"});
  if (!yaml.has("camera_matrix") && yaml.has(key))
    throw InputError(yaml.path() + ": is a stereo camera's calibration (has '" + key +
                     "'), for limbcast-stereo-camera; give a depth camera's");
}

}  // namespace

StereoCalibration read_stereo_calibration(const std::string& path) {
  if (fs::is_directory(path)) {
    return read_ros_pair(YamlReader(yaml_in(path, "left").string()),
                         YamlReader(yaml_in(path, "right").string()));
  }
  const YamlReader yaml(path);
  check_is_stereo(yaml);
  if (!yaml.has("camera_matrix")) return read_opencv_stereo(yaml);
  const auto right = right_of(path);
  if (!right) {
    throw InputError(path + ": is the camera_info of one camera; name the pair left.yaml and " +
                     "right.yaml and give the left one");
  }
  return read_ros_pair(yaml, YamlReader(right->string()));
}

std::vector<std::string> calibration_files(const std::string& path) {
  std::vector<std::string> files{path};
  if (const auto right = right_of(path)) files.push_back(right->string());
  return files;
}

DepthCalibration read_depth_calibration(const std::string& path) {
  if (fs::is_directory(path))
    throw InputError(path +
                     ": is a folder, as a stereo pair's calibration may be; give the file "
                     "of a depth camera's");
  const YamlReader yaml(path);
  check_is_depth(yaml);
  DepthCalibration calibration;
  calibration.color = read_ros_lens(yaml);
  calibration.depth_camera = read_depth_camera(yaml);
  if (yaml.has("depth_scale")) calibration.depth_scale_m = yaml.number("depth_scale");
  if (calibration.depth_scale_m <= 0.0 || calibration.depth_scale_m > 0.1) {
    yaml.fail("depth_scale", "is " + text_of(calibration.depth_scale_m),
              "must be > 0 and <= 0.1 metres a unit (0.001 for millimetres)");
  }
  calibration.mounting = read_mounting(yaml);
  return calibration;
}

double baseline_m(const StereoCalibration& calibration) { return -calibration.T.x(); }

}  // namespace limbcast
