#include "modules/segmenter/faces_and_joints/pose_network.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "modules/segmenter/faces_and_joints/blaze_pose.hpp"
#include "modules/segmenter/faces_and_joints/move_net.hpp"

namespace limbcast::segmenter {
namespace {

/// The square may not be wider [px]: so near to the camera its places are no numbers to work with.
constexpr float kLongestSide_px = 1e5F;

/// The part of the image that a square needs; empty where the square lies outside.
cv::Rect part_around(const UprightSquare& square, const cv::Size& image) {
  constexpr float kNeighbor_px = 1.0F;  // of the last pixel, for interpolation
  const float reach_px = 0.5F * square.side_px * square.down.lpNorm<1>() + kNeighbor_px;
  const auto clamped = [&](float place_px, int size_px) {
    return static_cast<int>(std::clamp(place_px, 0.0F, static_cast<float>(size_px)));
  };
  const int left = clamped(std::floor(square.center_px.x() - reach_px), image.width);
  const int right = clamped(std::ceil(square.center_px.x() + reach_px) + 1.0F, image.width);
  const int top = clamped(std::floor(square.center_px.y() - reach_px), image.height);
  const int bottom = clamped(std::ceil(square.center_px.y() + reach_px) + 1.0F, image.height);
  return {left, top, right - left, bottom - top};
}

/// A part of the cloud's image without other people. Their silhouettes would look like people, so
/// what is around them is drawn on.
cv::Mat3b paint_others_over(const Cloud& cloud, const LabelledPerson& person,
                            const cv::Rect& part) {
  cv::Mat3b image = color_image(cloud)(part).clone();
  cv::Mat1b others(part.size(), 0);
  for (int v = 0; v < part.height; ++v) {
    const std::int16_t* labels =
        person.labels.data() + static_cast<std::size_t>(part.y + v) * cloud.width + part.x;
    for (int u = 0; u < part.width; ++u) {
      if (labels[u] >= 0 && labels[u] != person.label) others(v, u) = 1;
    }
  }
  if (cv::countNonZero(others) > 0) fill_in(image, others);
  return image;
}

}  // namespace

PoseNetwork::PoseNetwork(const PoseNetworkParams& params, PictureNetworkKind kind)
    : params_(params) {
  if (!params.enabled) return;
  networks_ = std::make_unique<InstancePool<PictureNetwork>>(
      [kind, library = params.library]() -> std::unique_ptr<PictureNetwork> {
        if (kind == PictureNetworkKind::kMoveNet) return std::make_unique<MoveNet>(library);
        return std::make_unique<BlazePose>(library);
      });
}

PoseNetwork::~PoseNetwork() = default;

std::optional<ImagePose> PoseNetwork::look(const Cloud& cloud, const LabelledPerson& person,
                                           const Eigen::Vector3f& down) const {
  if (!networks_ || !cloud.organized() || cloud.colors.empty()) return std::nullopt;
  const std::optional<UprightSquare> square = square_around(*cloud.camera, person.head_m, down);
  if (!square) return std::nullopt;
  const cv::Rect part = part_around(*square, {cloud.width, cloud.height});
  if (part.empty()) return std::nullopt;
  UprightSquare square_in_part = *square;
  square_in_part.center_px -= Eigen::Vector2f(part.x, part.y);
  const cv::Mat3b input = cut_out(paint_others_over(cloud, person, part), square_in_part,
                                  kPictureSide_px, cv::BORDER_CONSTANT);
  ImagePose pose = networks_->with([&](PictureNetwork& network) { return network.see(input); });
  const Eigen::Affine2f image_from_input = image_from_patch(*square, kPictureSide_px);
  for (ImageJoint& joint : pose.joints) joint.px = image_from_input * joint.px;
  return pose;
}

std::optional<UprightSquare> PoseNetwork::square_around(const PinholeCamera& camera,
                                                        const Eigen::Vector3f& head_m,
                                                        const Eigen::Vector3f& down) const {
  const Eigen::Vector3f middle_m = head_m + params_.middle_below_head_m * down;
  if (!(head_m.z() > 0.0F) || !(middle_m.z() > 0.0F)) return std::nullopt;
  const float side_px = static_cast<float>(camera.fx) / middle_m.z() * params_.side_m;
  if (side_px < params_.min_side_px || side_px > kLongestSide_px) return std::nullopt;
  const Eigen::Vector2f center_px = camera.project(middle_m);
  const Eigen::Vector2f down_px = center_px - camera.project(head_m);
  // From straight above nothing in the image is down.
  if (!(down_px.norm() > 1.0F)) return std::nullopt;
  return UprightSquare{center_px, down_px.normalized(), side_px};
}

}  // namespace limbcast::segmenter
