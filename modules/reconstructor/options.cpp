#include "modules/reconstructor/options.hpp"

#include "common/formatted.hpp"

namespace limbcast::reconstructor {

void declare(config::Section& section, ReconstructorOptions& options) {
  section.add(
      "near-limit-m", options.near_limit_m, "m",
      "nearest depth, 0 = 0.4, of depth cameras 0.3; a stereo pair that would need more than 255 "
      "disparities is matched smaller",
      {0.0, 100.0});
  section.add("far-limit-m", options.far_limit_m, "m", "drop points beyond", {0.2, 1000.0});
  section.add("image-scale", options.image_scale, "",
              "size of the rectified images against the camera's: smaller is faster, less exact",
              {0.1, 1.0});
  section.add("roi-x", options.roi_x, "px",
              "region of interest in the rectified left image: left column", {0, 100000});
  section.add("roi-y", options.roi_y, "px", "region of interest: upper row", {0, 100000});
  section.add("roi-width", options.roi_width, "px",
              "region of interest: width, 0 = to the right border", {0, 100000});
  section.add("roi-height", options.roi_height, "px",
              "region of interest: height, 0 = to the lower border", {0, 100000});
  section.add("ground-plane", options.ground_plane,
              "find gravity and the sensor's height from the ground where nobody told them");
}

void check(const ReconstructorOptions& options) {
  for (const double near_limit_m : {options.stereo_near_limit_m(), options.depth_near_limit_m()}) {
    if (near_limit_m < options.far_limit_m) continue;
    throw config::UsageError(formatted("near-limit-m (%g) must be less than far-limit-m (%g)",
                                       near_limit_m, options.far_limit_m));
  }
}

}  // namespace limbcast::reconstructor
