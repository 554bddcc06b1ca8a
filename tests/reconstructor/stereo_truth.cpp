#include "tests/reconstructor/stereo_truth.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgcodecs.hpp>

namespace limbcast::test {
namespace {

template <class Matrix>
Matrix read_matrix(const cv::FileStorage& file, const std::string& key) {
  cv::Mat values;
  file[key] >> values;
  Matrix result;
  cv::cv2eigen(values, result);
  return result;
}

LensCalibration read_lens(const cv::FileStorage& file, const std::string& number) {
  const auto matrix = read_matrix<Eigen::Matrix3d>(file, "K" + number);
  cv::Mat1d distortion;
  file["D" + number] >> distortion;
  LensCalibration lens;
  lens.camera = {static_cast<int>(file["image_width"]),
                 static_cast<int>(file["image_height"]),
                 matrix(0, 0),
                 matrix(1, 1),
                 matrix(0, 2),
                 matrix(1, 2)};
  lens.distortion.assign(distortion.begin(), distortion.end());
  return lens;
}

}  // namespace

std::string stereo_dev_folder() { return std::string(LIMBCAST_DATA_DIR) + "/stereo_dev"; }

StereoCalibration read_stereo_calibration(const std::string& folder) {
  const cv::FileStorage file(folder + "/calibration.yml", cv::FileStorage::READ);
  StereoCalibration calibration;
  calibration.left = read_lens(file, "1");
  calibration.right = read_lens(file, "2");
  calibration.R = read_matrix<Eigen::Matrix3d>(file, "R");
  calibration.T = read_matrix<Eigen::Vector3d>(file, "T");
  using Projection = Eigen::Matrix<double, 3, 4>;
  calibration.rectification = Rectification{
      read_matrix<Eigen::Matrix3d>(file, "R1"), read_matrix<Eigen::Matrix3d>(file, "R2"),
      read_matrix<Projection>(file, "P1"), read_matrix<Projection>(file, "P2")};
  return calibration;
}

std::vector<std::string> frame_names(const std::string& folder) {
  constexpr const char* kEnding = "_gt.json";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto position = name.rfind(kEnding);
    if (position != std::string::npos) names.push_back(name.substr(0, position));
  }
  std::sort(names.begin(), names.end());
  return names;
}

TrueFrame read_true_frame(const std::string& folder, const std::string& name,
                          double focal_baseline) {
  const std::string path = folder + "/" + name;
  TrueFrame frame;
  frame.left = cv::imread(path + "_left.jpg");
  frame.right = cv::imread(path + "_right.jpg");
  frame.person = cv::imread(path + "_mask.png", cv::IMREAD_UNCHANGED);
  const cv::Mat depth_mm = cv::imread(path + "_depth.png", cv::IMREAD_UNCHANGED);
  frame.disparity_px = cv::Mat1f(depth_mm.size(), 0.0F);
  for (int v = 0; v < depth_mm.rows; ++v)
    for (int u = 0; u < depth_mm.cols; ++u)
      if (const int mm = depth_mm.at<ushort>(v, u); mm > 0)
        frame.disparity_px(v, u) = static_cast<float>(focal_baseline * 1000.0 / mm);
  const auto truth = nlohmann::json::parse(std::ifstream(path + "_gt.json"));
  for (const auto& person : truth["persons"]) {
    const std::string body = person["body"];
    if (body.rfind("D4", 0) == 0 || body.rfind("D5", 0) == 0) frame.is_tuning = false;
  }
  for (int i = 0; i < 3; ++i) frame.down[i] = truth["down"][i];
  frame.sensor_height_m = truth["camera_height"];
  return frame;
}

}  // namespace limbcast::test
