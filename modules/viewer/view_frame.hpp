#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "common/human_model/body_pose.hpp"

namespace limbcast::viewer {

/// How a module fared when the frame was made.
struct ModuleFigures {
  std::string module, host;
  double rate_out_hz = 0.0;
  std::optional<double> latency_p50_ms;
};

/// All that is known about one moment of one sensor; what did not come is not there.
struct ViewFrame {
  Stamp stamp;
  int number = 0;  ///< counts the frames that are shown, from 0
  std::optional<Cloud> cloud;
  std::optional<Segments> segments;
  std::optional<BodyPoses> poses;
  std::optional<BodyPoses> truth;  ///< as on GROUND_TRUTH
  std::vector<ModuleFigures> modules;
};

}  // namespace limbcast::viewer
