#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/image_params.hpp"

namespace limbcast::segmenter {

/// Side of the square picture that the network of depths takes [px].
constexpr int kDepthPictureSide_px = 128;

/// A person's depths, from the sensor's place, upright.
struct DepthPicture {
  /// Of each pixel: 1 where the person's own surface is; how much farther than the picture's middle
  /// it is [units of unit_m], else 0; what else was measured there: 1 behind the middle, -1 before
  /// it, 0 nothing.
  cv::Mat3f channels;
  PinholeCamera camera;
  Eigen::Matrix3f frame_from_picture;  ///< rotation to the cloud's frame
  float middle_m = 0.0F;               ///< how far away the middle is, along the optical axis
};

/// Draws what `view` shows around the head at `head_m`; `down` is gravity's direction, both in the
/// cloud's frame. Nothing of somebody above or behind the sensor.
std::optional<DepthPicture> draw_depths(const RangeImage& view, const Eigen::Vector3f& head_m,
                                        const Eigen::Vector3f& down,
                                        const DepthPictureParams& params);

}  // namespace limbcast::segmenter
