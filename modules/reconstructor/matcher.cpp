#include "modules/reconstructor/matcher.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
namespace {

/// Removes small groups of pixels that are cut off by steps in disparity.
void remove_speckles(const MatcherParams& params, cv::Mat1f& disparity_px) {
  constexpr double kSteps = 16.0;  // the filter takes whole numbers: sixteenths of a pixel
  cv::Mat1s fixed;
  disparity_px.convertTo(fixed, CV_16S, kSteps);
  cv::filterSpeckles(fixed, 0, params.speckle_size, params.speckle_step_px * kSteps);
  disparity_px.setTo(0.0F, fixed == 0);
}

}  // namespace

DisparityImage match(const cv::Mat& left, const cv::Mat& right, const MatcherParams& params) {
  const cv::Mat1b grey_left = grey_of(left), grey_right = grey_of(right);
  cv::Mat1f disparity_px = match_semi_global(grey_left, grey_right, params.semi_global);
  remove_speckles(params, disparity_px);
  fill_gaps(params.gaps, disparity_px);
  trim_silhouettes(left, params.silhouettes, disparity_px);
  refine_disparities(grey_left, grey_right, params.subpixel, disparity_px);
  const cv::Mat1b confidence = disparity_px > 0.0F;
  return {disparity_px, confidence};
}

}  // namespace limbcast::reconstructor
