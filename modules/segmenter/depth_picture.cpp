#include "modules/segmenter/depth_picture.hpp"

#include <algorithm>
#include <cmath>

#include "modules/segmenter/range_image.hpp"

namespace limbcast::segmenter {
namespace {

/// Index of the pixel of `view` that shows a ray of its camera's frame; nothing beside it.
std::optional<std::size_t> pixel_at(const RangeImage& view, const Eigen::Vector3f& ray) {
  constexpr float kLeastZ = 0.05F;  // beside the camera there is no pixel
  if (!(ray.z() > kLeastZ)) return std::nullopt;
  const Eigen::Vector2f px = view.camera.project(ray).array().round();
  if (!(px.minCoeff() >= 0.0F) || !(px.x() < static_cast<float>(view.camera.width)) ||
      !(px.y() < static_cast<float>(view.camera.height)))
    return std::nullopt;
  return static_cast<std::size_t>(px.y()) * view.camera.width + static_cast<std::size_t>(px.x());
}

}  // namespace

std::optional<DepthPicture> draw_depths(const RangeImage& view, const Eigen::Vector3f& head_m,
                                        const Eigen::Vector3f& down,
                                        const DepthPictureParams& params) {
  const Eigen::Vector3f middle_m = head_m + params.middle_below_head_m * down;
  DepthPicture picture;
  picture.frame_from_picture = upright_view(middle_m, down);
  const Eigen::Vector3f middle_in_picture_m = picture.frame_from_picture.transpose() * middle_m;
  const auto camera = camera_towards(middle_in_picture_m, params.side_m, kDepthPictureSide_px);
  if (!camera) return std::nullopt;
  picture.camera = *camera;
  picture.middle_m = middle_in_picture_m.z();
  picture.channels.create(kDepthPictureSide_px, kDepthPictureSide_px);
  picture.channels.setTo(cv::Scalar::all(0.0));
  const Eigen::Matrix3f view_from_picture =
      view.frame_from_image.transpose() * picture.frame_from_picture;
  for (int v = 0; v < kDepthPictureSide_px; ++v) {
    for (int u = 0; u < kDepthPictureSide_px; ++u) {
      // One metre along the picture's axis.
      const Eigen::Vector3f ray =
          view_from_picture *
          camera->back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const auto pixel = pixel_at(view, ray);
      if (!pixel || !(view.depth_m[*pixel] > 0.0F)) continue;
      const float behind_middle_m = view.depth_m[*pixel] / ray.z() - picture.middle_m;
      cv::Vec3f& channels = picture.channels(v, u);
      if (view.labels[*pixel] == PixelLabel::kPerson) {
        channels[0] = 1.0F;
        channels[1] =
            std::clamp(behind_middle_m / params.unit_m, -params.most_units, params.most_units);
      } else {
        channels[2] = behind_middle_m < 0.0F ? -1.0F : 1.0F;
      }
    }
  }
  return picture;
}

}  // namespace limbcast::segmenter
