#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"

namespace limbcast::segmenter {

/// A person of the ground truth.
struct TruePerson {
  std::string body;  ///< "D1" to "D5", empty where not told
  int mask_index = 0;
  std::map<std::string, Eigen::Vector3f> joints_m;
  std::map<std::string, bool> visible;
  float yaw_deg = 0.0F;

  bool head_visible() const {
    return joints_m.count("head") > 0 && visible.count("head") > 0 && visible.at("head");
  }
  /// D4 and D5: nothing is tuned on these.
  bool for_checking() const { return body == "D4" || body == "D5"; }
};

/// One frame of the data folder.
struct RecordedFrame {
  std::string name;
  Cloud cloud;
  cv::Mat color;  ///< empty for a laser
  cv::Mat mask;   ///< person's index at each pixel; empty where there is none
  std::vector<TruePerson> persons;
  bool labelled = false;
};

/// Paths of a set's frames without their suffixes, sorted.
std::vector<std::string> frame_paths(const std::string& set);

/// Depth of a stereo pair.
enum class DepthFrom { kSgbm, kTruth };

RecordedFrame load_frame(const std::string& path, DepthFrom depth_from);

}  // namespace limbcast::segmenter
