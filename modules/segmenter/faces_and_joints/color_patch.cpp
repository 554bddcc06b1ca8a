#include "modules/segmenter/faces_and_joints/color_patch.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace limbcast::segmenter {
namespace {

/// Colours times their weights, and the weights: 1 for a pixel that is known, 0 for one that is
/// not.
struct WeightedImage {
  cv::Mat3f sum;
  cv::Mat1f weight;
};

WeightedImage halved(const WeightedImage& image) {
  const cv::Size half((image.weight.cols + 1) / 2, (image.weight.rows + 1) / 2);
  WeightedImage result;
  cv::resize(image.sum, result.sum, half, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(image.weight, result.weight, half, 0.0, 0.0, cv::INTER_AREA);
  return result;
}

/// Pull and push (S. Gortler et al., "The Lumigraph", SIGGRAPH 1996): what is missing at one
/// resolution comes from the next lower one.
cv::Mat3f filled(const WeightedImage& image) {
  constexpr float kLeastWeight = 1e-6F;
  const cv::Size size = image.weight.size();
  cv::Mat3f colors(size, cv::Vec3f(0.0F, 0.0F, 0.0F));
  if (size.width > 1 || size.height > 1)
    cv::resize(filled(halved(image)), colors, size, 0.0, 0.0, cv::INTER_LINEAR);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const float weight = image.weight(v, u);
      if (weight > kLeastWeight) colors(v, u) = image.sum(v, u) + (1.0F - weight) * colors(v, u);
    }
  }
  return colors;
}

}  // namespace

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

void fill_in(cv::Mat3b& image, const cv::Mat1b& hole) {
  // What is filled in is smooth: a smaller image tells it as well, in a third of the time.
  constexpr int kLongestSide_px = 128;
  const double scale =
      std::min(1.0, static_cast<double>(kLongestSide_px) / std::max(image.cols, image.rows));
  const cv::Size small_size(std::max(1, cvRound(scale * image.cols)),
                            std::max(1, cvRound(scale * image.rows)));
  cv::Mat3b seen = image.clone(), small_seen;
  seen.setTo(cv::Scalar::all(0), hole);
  cv::resize(seen, small_seen, small_size, 0.0, 0.0, cv::INTER_AREA);
  constexpr double kKnown = 255.0;
  cv::Mat1b small_known;
  cv::resize(hole == 0, small_known, small_size, 0.0, 0.0, cv::INTER_AREA);
  WeightedImage known;
  small_seen.convertTo(known.sum, CV_32F);
  small_known.convertTo(known.weight, CV_32F, 1.0 / kKnown);
  cv::Mat3b fill;
  cv::resize(cv::Mat3b(filled(known)), fill, image.size(), 0.0, 0.0, cv::INTER_LINEAR);
  fill.copyTo(image, hole);
}

}  // namespace limbcast::segmenter
