#pragma once

#include <limbcast/lens_t.hpp>
#include <limbcast/mounting_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <string>

#include "common/camera/calibration.hpp"

namespace limbcast::lcm_io {

lens_t to_message(const LensCalibration& lens);
LensCalibration from_message(const lens_t& message);

mounting_t to_message(const Mounting& mounting);
Mounting from_message(const mounting_t& message);

stereo_calibration_t to_message(const StereoCalibration& calibration, std::int64_t utime,
                                const std::string& sensor);
/// Throws MessageError where a number is not finite, an image or focal length not positive, or R no
/// rotation, or only one of the lenses a fisheye.
StereoCalibration from_message(const stereo_calibration_t& message);

}  // namespace limbcast::lcm_io
