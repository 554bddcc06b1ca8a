#include "modules/segmenter/color_patch.hpp"

#include <opencv2/imgproc.hpp>

namespace limbcast::segmenter {

cv::Mat3b color_image(const Cloud& cloud) {
  // OpenCV has no view of constant data.
  return {cloud.height, cloud.width,
          reinterpret_cast<cv::Vec3b*>(const_cast<Bgr*>(cloud.colors.data()))};
}

Eigen::Affine2f image_from_patch(const UprightSquare& square, int patch_px) {
  const auto side_px = static_cast<float>(patch_px);
  const Eigen::Vector2f down = square.side_px / side_px * square.down;
  Eigen::Affine2f transform;
  transform.linear().col(0) = Eigen::Vector2f(down.y(), -down.x());
  transform.linear().col(1) = down;
  transform.translation() =
      square.center_px - transform.linear() * Eigen::Vector2f::Constant(0.5F * side_px);
  return transform;
}

cv::Mat3b cut_out(const cv::Mat3b& image, const UprightSquare& square, int patch_px,
                  cv::BorderTypes outside) {
  const Eigen::Affine2f from_patch = image_from_patch(square, patch_px);
  const cv::Matx23f rows(from_patch(0, 0), from_patch(0, 1), from_patch(0, 2),  //
                         from_patch(1, 0), from_patch(1, 1), from_patch(1, 2));
  cv::Mat3b patch;
  cv::warpAffine(image, patch, rows, cv::Size(patch_px, patch_px),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, outside);
  return patch;
}

}  // namespace limbcast::segmenter
