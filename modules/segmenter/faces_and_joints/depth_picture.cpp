#include "modules/segmenter/faces_and_joints/depth_picture.hpp"

#include <algorithm>

#include "modules/segmenter/range_image.hpp"

namespace limbcast::segmenter {

std::optional<DepthPicture> draw_depths(const Scene& scene, const LabelledPerson& person,
                                        const DepthPictureParams& params) {
  const Eigen::Vector3f down = scene.lattice.frame.down();
  const Eigen::Vector3f middle_m = person.head_m + params.middle_below_head_m * down;
  DepthPicture picture;
  picture.frame_from_picture = upright_view(middle_m, down);
  const Eigen::Vector3f middle_in_picture_m = picture.frame_from_picture.transpose() * middle_m;
  const auto camera = camera_towards(middle_in_picture_m, params.side_m, kDepthPictureSide_px);
  if (!camera) return std::nullopt;
  picture.camera = *camera;
  picture.middle_m = middle_in_picture_m.z();
  picture.of_scan = !scene.cloud.organized();
  picture.channels.create(kDepthPictureSide_px, kDepthPictureSide_px);
  picture.channels.setTo(cv::Scalar::all(0.0));
  for (int v = 0; v < kDepthPictureSide_px; ++v) {
    for (int u = 0; u < kDepthPictureSide_px; ++u) {
      // One metre along the picture's axis.
      const Eigen::Vector3f ray =
          picture.frame_from_picture *
          camera->back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const auto seen = look_along(scene, ray);
      if (!seen) continue;
      const float depth = std::clamp((seen->along - picture.middle_m) / params.unit_m,
                                     -params.most_units, params.most_units);
      picture.channels(v, u) = person.labels[seen->point] == person.label
                                   ? cv::Vec4f(1.0F, depth, 0.0F, 0.0F)
                                   : cv::Vec4f(0.0F, 0.0F, depth < 0.0F ? -1.0F : 1.0F, depth);
    }
  }
  return picture;
}

}  // namespace limbcast::segmenter
