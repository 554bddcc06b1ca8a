#include "modules/segmenter/stage.hpp"

#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"

namespace limbcast::segmenter {

void declare(config::Section& section, StageOptions& options) {
  declare(section, options.algorithm);
  section.add_input_channel("point-cloud-channel", options.point_cloud_channel, "point clouds");
  section.add_output_channel("segments-channel", options.segments_channel, "person candidates");
  section.add_input_channel("body-poses-channel", options.body_poses_channel,
                            "what is made of the candidates; no more are made than are taken");
}

segments_t Stage::process(const point_cloud_t& cloud) const {
  return lcm_io::to_message(segmenter_.segment(lcm_io::from_message(cloud)));
}

}  // namespace limbcast::segmenter
