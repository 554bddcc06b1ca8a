#pragma once

#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <string>

#include "common/config/options.hpp"
#include "modules/segmenter/options.hpp"
#include "modules/segmenter/segmenter.hpp"

namespace limbcast::segmenter {

struct StageOptions {
  SegmenterOptions algorithm;
  std::string point_cloud_channel = "POINT_CLOUD";
  std::string segments_channel = "SEGMENTS";
  std::string body_poses_channel = "BODY_POSES";
};

/// Binds the keys of section [segmenter].
void declare(config::Section& section, StageOptions& options);

/// From messages to messages: the one wiring of the segmenter, for the process and for
/// limbcast-replay. Several threads may use one object.
class Stage {
 public:
  explicit Stage(const StageOptions& options) : segmenter_(to_params(options.algorithm)) {}

  segments_t process(const point_cloud_t& cloud) const;

 private:
  Segmenter segmenter_;
};

}  // namespace limbcast::segmenter
