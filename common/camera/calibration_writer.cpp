#include "common/camera/calibration_writer.hpp"

#include <opencv2/core.hpp>
#include <vector>

#include "common/camera/opencv_conversion.hpp"
#include "common/whole_file.hpp"

namespace limbcast {
namespace {

/// Collects the text of a YAML file.
cv::FileStorage yaml_text() {
  constexpr int kMode =
      cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML;
  return {".yml", kMode};
}

void write_size(cv::FileStorage& file, const PinholeCamera& camera) {
  file << "image_width" << camera.width << "image_height" << camera.height;
}

void write_lens(cv::FileStorage& file, const std::string& matrix_key,
                const std::string& distortion_key, const LensCalibration& lens) {
  // Other programs take a missing key for an error.
  const std::vector<double> none(5, 0.0);
  file << matrix_key << cv::Mat(camera_matrix(lens.camera));
  file << distortion_key
       << cv::Mat(lens.distortion.empty() ? none : lens.distortion, true).reshape(1, 1);
}

/// Nothing where it is what readers take it for.
void write_model(cv::FileStorage& file, const std::string& key, const LensCalibration& lens) {
  if (lens.model == LensModel::kFisheye) file << key << kFisheyeName;
}

void write_mounting(cv::FileStorage& file, const Mounting& mounting) {
  if (mounting.down) file << "down" << cv::Mat(to_cv(*mounting.down));
  if (mounting.sensor_height_m) file << "sensor_height_m" << *mounting.sensor_height_m;
}

/// Q takes (u, v, disparity, 1) to a point, as cv::reprojectImageTo3D wants it.
cv::Mat disparity_to_point(const Rectification& rectification) {
  const double focal_px = rectification.P1(0, 0);
  const double tx_m = rectification.P2(0, 3) / rectification.P2(0, 0);
  const double cx_difference_px = rectification.P1(0, 2) - rectification.P2(0, 2);
  return (cv::Mat_<double>(4, 4) << 1.0, 0.0, 0.0, -rectification.P1(0, 2),  //
          0.0, 1.0, 0.0, -rectification.P1(1, 2),                            //
          0.0, 0.0, 0.0, focal_px,                                           //
          0.0, 0.0, -1.0 / tx_m, cx_difference_px / tx_m);
}

void write_rectification(cv::FileStorage& file, const Rectification& rectification) {
  file << "R1" << cv::Mat(to_cv(rectification.R1)) << "R2" << cv::Mat(to_cv(rectification.R2));
  file << "P1" << cv::Mat(to_cv(rectification.P1)) << "P2" << cv::Mat(to_cv(rectification.P2));
  file << "Q" << disparity_to_point(rectification);
}

void write_depth_camera(cv::FileStorage& file, const DepthCamera& depth_camera) {
  file << "depth_image_width" << depth_camera.lens.camera.width;
  file << "depth_image_height" << depth_camera.lens.camera.height;
  write_model(file, "depth_distortion_model", depth_camera.lens);
  write_lens(file, "depth_camera_matrix", "depth_distortion_coefficients", depth_camera.lens);
  file << "R" << cv::Mat(to_cv(depth_camera.R)) << "T" << cv::Mat(to_cv(depth_camera.T));
}

}  // namespace

void write_stereo_calibration(const std::string& path, const StereoCalibration& calibration) {
  cv::FileStorage file = yaml_text();
  write_size(file, calibration.left.camera);
  write_model(file, "distortion_model", calibration.left);
  write_lens(file, "K1", "D1", calibration.left);
  write_lens(file, "K2", "D2", calibration.right);
  file << "R" << cv::Mat(to_cv(calibration.R)) << "T" << cv::Mat(to_cv(calibration.T));
  if (calibration.rectification) write_rectification(file, *calibration.rectification);
  write_mounting(file, calibration.mounting);
  write_whole_file(path, file.releaseAndGetString());
}

void write_depth_calibration(const std::string& path, const DepthCalibration& calibration) {
  cv::FileStorage file = yaml_text();
  write_size(file, calibration.color.camera);
  write_model(file, "distortion_model", calibration.color);
  write_lens(file, "camera_matrix", "distortion_coefficients", calibration.color);
  file << "depth_scale" << calibration.depth_scale_m;
  if (calibration.depth_camera) write_depth_camera(file, *calibration.depth_camera);
  write_mounting(file, calibration.mounting);
  write_whole_file(path, file.releaseAndGetString());
}

}  // namespace limbcast
