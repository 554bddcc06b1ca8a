#include "tests/reconstructor/stereo_truth.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/camera/calibration_reader.hpp"

namespace limbcast::test {
std::string stereo_dev_folder() { return std::string(LIMBCAST_DATA_DIR) + "/stereo_dev"; }

StereoCalibration read_calibration(const std::string& folder) {
  return read_stereo_calibration(folder + "/calibration.yml");
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
