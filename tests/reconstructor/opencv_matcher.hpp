#pragma once

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/reconstructor/rectifier.hpp"

namespace limbcast::test {

/// Disparities [px, 0 = none] by one of OpenCV's matchers, on the pair padded at the left, so that
/// it loses no columns either.
inline cv::Mat1f run_opencv(cv::StereoMatcher& matcher, const reconstructor::RectifiedPair& pair) {
  const int border = matcher.getNumDisparities();
  cv::Mat left, right, found;
  cv::cvtColor(pair.left, left, cv::COLOR_BGR2GRAY);
  cv::cvtColor(pair.right, right, cv::COLOR_BGR2GRAY);
  cv::copyMakeBorder(left, left, 0, 0, border, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, right, 0, 0, border, 0, cv::BORDER_REPLICATE);
  matcher.compute(left, right, found);
  cv::Mat1f disparity_px;
  found.colRange(border, found.cols)
      .convertTo(disparity_px, CV_32F, 1.0 / cv::StereoMatcher::DISP_SCALE);
  return cv::max(disparity_px, 0.0F);
}

/// OpenCV's semi-global matcher as its samples set it, with three ways (`MODE_SGBM_3WAY`) or more.
inline cv::Ptr<cv::StereoMatcher> opencv_sgbm(int num_disparities, int mode) {
  constexpr int kBlock = 5, kSmallStep = 8 * kBlock * kBlock, kLargeStep = 32 * kBlock * kBlock;
  return cv::StereoSGBM::create(0, num_disparities, kBlock, kSmallStep, kLargeStep, 1, 0, 10, 100,
                                2, mode);
}

}  // namespace limbcast::test
