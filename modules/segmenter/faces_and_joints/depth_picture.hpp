#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "modules/segmenter/faces_and_joints/labelled_person.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/scene/scene.hpp"

namespace limbcast::segmenter {

/// Side of the square picture that the network of depths takes [px].
constexpr int kDepthPictureSide_px = 128;

/// A person's depths, from the sensor's place, upright.
struct DepthPicture {
  /// Of each pixel: 1 where the person's own surface is; how much farther than the picture's middle
  /// it is [units of unit_m], else 0; what else was measured there: 1 behind the middle, -1 before
  /// it, 0 nothing; how much farther than the middle that is, else 0.
  cv::Mat4f channels;
  PinholeCamera camera;
  Eigen::Matrix3f frame_from_picture;  ///< rotation to the cloud's frame
  float middle_m = 0.0F;               ///< how far away the middle is, along the optical axis
  bool of_scan = false;                ///< of a range finder's cloud, not of a camera's
};

/// Draws what the sensor saw around a person's head. An arm that was cut off as something else is
/// among what else was measured. Nothing of somebody above or behind the sensor.
std::optional<DepthPicture> draw_depths(const Scene& scene, const LabelledPerson& person,
                                        const DepthPictureParams& params);

}  // namespace limbcast::segmenter
