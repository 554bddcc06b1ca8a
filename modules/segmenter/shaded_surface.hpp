#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "modules/segmenter/image_params.hpp"

namespace limbcast::segmenter {

/// The surface that points stand on, drawn as a lamp over the sensor's shoulder would show it: what
/// somebody looks like of whom no colours are known. Points in the camera's optical frame; the
/// picture is as large as the camera's image, a plain wall where no surface is.
cv::Mat3b draw_shaded(const std::vector<Eigen::Vector3f>& points_m, const PinholeCamera& camera,
                      const ShadedSurfaceParams& params);

}  // namespace limbcast::segmenter
