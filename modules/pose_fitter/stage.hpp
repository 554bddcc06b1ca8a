#pragma once

#include <limbcast/body_poses_t.hpp>
#include <limbcast/segments_t.hpp>
#include <string>

#include "common/config/options.hpp"
#include "modules/pose_fitter/options.hpp"
#include "modules/pose_fitter/pose_fitter.hpp"

namespace limbcast::pose_fitter {

struct StageOptions {
  PoseFitterOptions algorithm;
  std::string segments_channel = "SEGMENTS";
  std::string body_poses_channel = "BODY_POSES";
};

/// Binds the keys of section [pose_fitter].
void declare(config::Section& section, StageOptions& options);

/// From messages to messages: the one wiring of the pose fitter, for the process and for
/// limbcast-replay. Several threads may use one object.
class Stage {
 public:
  explicit Stage(const StageOptions& options) : fitter_(options.algorithm) {}

  body_poses_t process(const segments_t& segments) const;

 private:
  PoseFitter fitter_;
};

}  // namespace limbcast::pose_fitter
