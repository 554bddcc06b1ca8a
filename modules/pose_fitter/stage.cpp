#include "modules/pose_fitter/stage.hpp"

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"

namespace limbcast::pose_fitter {

void declare(config::Section& section, StageOptions& options) {
  declare(section, options.algorithm);
  section.add_input_channel("segments-channel", options.segments_channel, "person candidates");
  section.add_output_channel("body-poses-channel", options.body_poses_channel, "poses of people");
}

body_poses_t Stage::process(const segments_t& segments) const {
  return lcm_io::to_message(fitter_.fit(lcm_io::from_message(segments)));
}

}  // namespace limbcast::pose_fitter
