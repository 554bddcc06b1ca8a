#include "modules/reconstructor/matcher.hpp"

#include <opencv2/core.hpp>

#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
DisparityImage match(const cv::Mat& left, const cv::Mat& right, const MatcherParams& params) {
  const cv::Mat1b grey_left = grey_of(left), grey_right = grey_of(right);
  const QuietPair quiet = quieted(grey_left, grey_right, params.noise);
  cv::Mat1f disparity_px = match_semi_global(quiet.left, quiet.right, params.semi_global);
  remove_speckles(params.speckles, disparity_px);
  fill_gaps(params.gaps, disparity_px);
  trim_silhouettes(left, params.silhouettes, disparity_px);
  refine_disparities(grey_left, grey_right, params.subpixel, disparity_px);
  const cv::Mat1b confidence = disparity_px > 0.0F;
  return {disparity_px, confidence};
}

}  // namespace limbcast::reconstructor
