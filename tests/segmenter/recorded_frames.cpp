#include "tests/segmenter/recorded_frames.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

namespace limbcast::segmenter {
namespace {

namespace fs = std::filesystem;

nlohmann::json read_truth(const std::string& path) {
  std::ifstream file(path + "_gt.json");
  return file ? nlohmann::json::parse(file) : nlohmann::json();
}

/// The direction timestamps.csv tells for this frame: what a run on the recording would know.
Gravity read_gravity(const std::string& path) {
  std::ifstream file(fs::path(path).parent_path() / "timestamps.csv");
  const std::string name = fs::path(path).filename();
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.size() < 5 || row[0] != name) continue;
    return {Eigen::Vector3f(std::stof(row[2]), std::stof(row[3]), std::stof(row[4])).normalized(),
            GravitySource::kRecording, std::nullopt};
  }
  return {};
}

cv::Mat1f sgbm_depth(const std::string& path, float focal_times_baseline) {
  cv::Mat left = cv::imread(path + "_left.jpg"), right = cv::imread(path + "_right.jpg");
  const int disparities = left.cols > 900 ? 128 : 64;
  const int block = 5;
  cv::copyMakeBorder(left, left, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, right, 0, 0, disparities, 0, cv::BORDER_REPLICATE);
  const auto matcher =
      cv::StereoSGBM::create(0, disparities, block, 8 * 3 * block * block, 32 * 3 * block * block,
                             1, 63, 10, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  cv::Mat disparity;
  matcher->compute(left, right, disparity);
  disparity = disparity.colRange(disparities, disparity.cols);
  cv::Mat1f depth(disparity.size(), 0.0F);
  for (int i = 0; i < static_cast<int>(disparity.total()); ++i) {
    const float d =
        static_cast<float>(disparity.at<std::int16_t>(i / disparity.cols, i % disparity.cols)) /
        16.0F;
    if (d > 0.9F) depth(i / disparity.cols, i % disparity.cols) = focal_times_baseline / d;
  }
  return depth;
}

void fill_cloud(const cv::Mat1f& depth, const cv::Mat& color, Cloud& cloud) {
  constexpr float kFarthest_m = 10.0F;
  cloud.width = depth.cols;
  cloud.height = depth.rows;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const float z = depth(v, u) < kFarthest_m ? depth(v, u) : 0.0F;
      cloud.points_m.push_back(
          cloud.camera->back_project(static_cast<float>(u), static_cast<float>(v), z));
      const auto bgr = color.at<cv::Vec3b>(v, u);
      cloud.colors.push_back({bgr[0], bgr[1], bgr[2]});
    }
  }
}

PinholeCamera read_camera(const nlohmann::json& truth) {
  // The D435 of rgbd_pointing; frames without a label carry no camera of their own.
  PinholeCamera camera{640, 480, 617.25, 617.5486450195312, 317.3921203613281, 245.98019409179688};
  if (truth.is_object() && truth.at("camera").is_object()) {
    const auto& c = truth.at("camera");
    camera = {c.at("width"), c.at("height"), c.at("fx"), c.at("fy"), c.at("cx"), c.at("cy")};
  }
  return camera;
}

void load_laser(const std::string& path, Cloud& cloud) {
  std::ifstream file(path + ".pcd", std::ios::binary);
  int count = 0;
  for (std::string line; std::getline(file, line) && line.rfind("DATA", 0) != 0;) {
    if (line.rfind("POINTS ", 0) == 0) count = std::stoi(line.substr(7));
  }
  std::vector<float> values(static_cast<std::size_t>(count) * 4);
  file.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
  for (std::size_t i = 0; i < values.size(); i += 4) {
    const Eigen::Vector3f point(values[i], values[i + 1], values[i + 2]);
    if (point.allFinite()) cloud.points_m.push_back(point);
  }
  cloud.width = static_cast<int>(cloud.points_m.size());
  cloud.height = 1;
}

std::vector<TruePerson> read_persons(const nlohmann::json& truth) {
  std::vector<TruePerson> persons;
  for (const auto& entry : truth.at("persons")) {
    TruePerson person;
    if (entry.contains("body") && entry.at("body").is_string())
      person.body = entry.at("body").get<std::string>().substr(0, 2);
    person.mask_index = entry.value("mask_index", 0);
    if (entry.contains("body_yaw_deg") && entry.at("body_yaw_deg").is_number())
      person.yaw_deg = entry.at("body_yaw_deg");
    for (const auto& [name, xyz] : entry.at("joints").items()) {
      if (xyz.is_array()) person.joints_m[name] = Eigen::Vector3f(xyz[0], xyz[1], xyz[2]);
    }
    for (const auto& [name, visible] : entry.at("visible").items())
      person.visible[name] = visible.get<bool>();
    persons.push_back(std::move(person));
  }
  return persons;
}

}  // namespace

std::vector<std::string> frame_paths(const std::string& set) {
  std::set<std::string> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(LIMBCAST_DATA_DIR) / set)) {
    const std::string file = entry.path().string();
    for (const char* suffix : {"_left.jpg", "_color.jpg", ".pcd"}) {
      const auto at = file.size() - std::min(file.size(), std::string(suffix).size());
      if (file.compare(at, std::string::npos, suffix) == 0) paths.insert(file.substr(0, at));
    }
  }
  return {paths.begin(), paths.end()};
}

RecordedFrame load_frame(const std::string& path, DepthFrom depth_from) {
  RecordedFrame frame;
  frame.name = fs::path(path).filename();
  const nlohmann::json truth = read_truth(path);
  frame.labelled = truth.is_object();
  if (frame.labelled) frame.persons = read_persons(truth);
  frame.cloud.stamp.gravity = read_gravity(path);
  if (fs::exists(path + ".pcd")) {
    load_laser(path, frame.cloud);
    frame.cloud.stamp.depth_noise = {0.01F, 0.0F};
    return frame;
  }
  frame.cloud.camera = read_camera(truth);
  frame.mask = fs::exists(path + "_mask.png") ? cv::imread(path + "_mask.png", cv::IMREAD_UNCHANGED)
                                              : cv::Mat();
  const bool stereo = fs::exists(path + "_left.jpg");
  frame.color = cv::imread(path + (stereo ? "_left.jpg" : "_color.jpg"));
  cv::Mat1f depth;
  if (stereo && depth_from == DepthFrom::kSgbm) {
    const float baseline_m = truth.at("camera").at("baseline");
    const float fb = static_cast<float>(frame.cloud.camera->fx) * baseline_m;
    depth = sgbm_depth(path, fb);
    frame.cloud.stamp.depth_noise = {0.0F, 0.15F / fb};
  } else {
    cv::imread(path + "_depth.png", cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, 0.001);
    frame.cloud.stamp.depth_noise = {0.002F, 0.001F};
  }
  fill_cloud(depth, frame.color, frame.cloud);
  return frame;
}

}  // namespace limbcast::segmenter
