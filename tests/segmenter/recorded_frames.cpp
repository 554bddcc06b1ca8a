#include "tests/segmenter/recorded_frames.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/recording.hpp"
#include "common/cloud/ground_plane.hpp"

namespace limbcast::segmenter {
namespace {

namespace fs = std::filesystem;

nlohmann::json read_truth(const std::string& path) {
  std::ifstream file(path + "_gt.json");
  return file ? nlohmann::json::parse(file) : nlohmann::json();
}

/// The frame's cloud from the true depth of the left camera, with the stamp's gravity.
Cloud true_cloud(const std::string& path, const PinholeCamera& camera, const Stamp& stamp) {
  cv::Mat1f depth;
  cv::imread(path + "_depth.png", cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, 0.001);
  const cv::Mat color = cv::imread(path + "_left.jpg");
  Cloud cloud;
  cloud.stamp = stamp;
  cloud.camera = camera;
  cloud.width = depth.cols;
  cloud.height = depth.rows;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      cloud.points_m.push_back(
          camera.back_project(static_cast<float>(u), static_cast<float>(v), depth(v, u)));
      const auto& bgr = color.at<cv::Vec3b>(v, u);
      cloud.colors.push_back({bgr[0], bgr[1], bgr[2]});
    }
  }
  complete_gravity(cloud);
  return cloud;
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

FrameReader::FrameReader(const std::string& folder, DepthFrom depth_from)
    : depth_from_(depth_from) {
  std::set<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().string();
    for (const std::string suffix : {"_left.jpg", "_depth.png", ".pcd"}) {
      if (file.size() <= suffix.size()) continue;
      const std::size_t at = file.size() - suffix.size();
      if (file.compare(at, std::string::npos, suffix) == 0) paths.insert(file.substr(0, at));
    }
  }
  paths_.assign(paths.begin(), paths.end());
  if (fs::exists(folder + "/timestamps.csv")) {
    for (const FrameTime& time : read_timestamps(folder + "/timestamps.csv")) {
      if (time.down)
        gravity_[time.name] = {time.down->cast<float>(), GravitySource::kRecording, std::nullopt};
    }
  }
  const std::string calibration = folder + "/calibration.yml";
  if (paths_.empty() || !fs::exists(calibration)) return;
  const reconstructor::ReconstructorOptions options;
  if (fs::exists(paths_[0] + "_left.jpg"))
    stereo_.emplace(read_stereo_calibration(calibration), options);
  else
    depth_.emplace(read_depth_calibration(calibration), options);
}

Stamp FrameReader::stamp_of(const std::string& name) const {
  Stamp stamp;
  const auto known = gravity_.find(name);
  if (known != gravity_.end()) stamp.gravity = known->second;
  return stamp;
}

LoadedFrame FrameReader::read(const std::string& path) const {
  LoadedFrame frame;
  frame.name = fs::path(path).filename();
  const nlohmann::json truth = read_truth(path);
  frame.labelled = truth.is_object();
  if (frame.labelled) frame.persons = read_persons(truth);
  const Stamp stamp = stamp_of(frame.name);
  if (fs::exists(path + "_mask.png"))
    frame.mask = cv::imread(path + "_mask.png", cv::IMREAD_UNCHANGED);
  if (stereo_) {
    frame.color = cv::imread(path + "_left.jpg");
    const cv::Mat right = cv::imread(path + "_right.jpg");
    const auto pair = stereo_->rectifier().rectify(frame.color, right);
    frame.cloud = depth_from_ == DepthFrom::kTruth
                      ? true_cloud(path, stereo_->rectifier().camera(), stamp)
                      : stereo_->reconstruct({stamp, frame.color, right});
    frame.color = pair.left;
  } else if (depth_) {
    if (fs::exists(path + "_color.jpg")) frame.color = cv::imread(path + "_color.jpg");
    frame.cloud = depth_->reconstruct(
        {stamp, frame.color, cv::imread(path + "_depth.png", cv::IMREAD_UNCHANGED)});
  } else {
    load_laser(path, frame.cloud);
    frame.cloud.stamp = stamp;
    frame.cloud.stamp.depth_noise = {0.01F, 0.0F};
    complete_gravity(frame.cloud);
  }
  return frame;
}

}  // namespace limbcast::segmenter
