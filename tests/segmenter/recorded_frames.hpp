#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/reconstructor/reconstructor.hpp"

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
struct LoadedFrame {
  std::string name;
  Cloud cloud;
  cv::Mat color;  ///< empty for a laser
  cv::Mat mask;   ///< person's index at each pixel; empty where there is none
  std::vector<TruePerson> persons;
  bool labelled = false;

  /// Shows somebody who is kept for checking: not to be trained on.
  bool for_checking() const {
    return std::any_of(persons.begin(), persons.end(),
                       [](const TruePerson& person) { return person.for_checking(); });
  }
};

/// Depth of a stereo pair.
enum class DepthFrom { kReconstructor, kTruth };

/// Reads the frames of one set: a folder of pairs, of depth images or of laser scans.
class FrameReader {
 public:
  FrameReader(const std::string& folder, DepthFrom depth_from);

  /// Paths of the frames without their suffixes, sorted.
  const std::vector<std::string>& paths() const { return paths_; }
  bool is_stereo() const { return stereo_.has_value(); }
  LoadedFrame read(const std::string& path) const;

 private:
  Stamp stamp_of(const std::string& name) const;

  DepthFrom depth_from_;
  std::vector<std::string> paths_;
  std::map<std::string, Gravity> gravity_;
  std::optional<reconstructor::StereoReconstructor> stereo_;
  std::optional<reconstructor::DepthReconstructor> depth_;
};

}  // namespace limbcast::segmenter
