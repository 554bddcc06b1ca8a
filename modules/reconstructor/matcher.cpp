#include "modules/reconstructor/matcher.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/reconstructor/colors.hpp"

namespace limbcast::reconstructor {
namespace {

/// Matches the pair so many times smaller that its disparities are few enough, and enlarges what is
/// found.
DisparityImage match_smaller(const cv::Mat& left, const cv::Mat& right, MatcherParams params) {
  int& num_disparities = params.semi_global.num_disparities;
  const int times = (num_disparities + kMaxDisparities - 1) / kMaxDisparities;
  num_disparities = (num_disparities + times - 1) / times;
  // Whole pixels become one each: the images' last rows and columns may be left over.
  const cv::Size size(left.cols / times, left.rows / times);
  const cv::Rect inner(0, 0, size.width * times, size.height * times);
  cv::Mat small_left, small_right;
  cv::resize(left(inner), small_left, size, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(right(inner), small_right, size, 0.0, 0.0, cv::INTER_AREA);
  const DisparityImage small = match(small_left, small_right, params);
  DisparityImage result{cv::Mat1f(left.size(), 0.0F), cv::Mat1b(left.size(), uchar{0})};
  // No mean of two surfaces: what lies between them is not there.
  cv::resize(small.disparity_px * times, result.disparity_px(inner), inner.size(), 0.0, 0.0,
             cv::INTER_NEAREST_EXACT);
  cv::resize(small.confidence, result.confidence(inner), inner.size(), 0.0, 0.0,
             cv::INTER_NEAREST_EXACT);
  return result;
}

}  // namespace

DisparityImage match(const cv::Mat& left, const cv::Mat& right, const MatcherParams& params) {
  if (params.semi_global.num_disparities > kMaxDisparities)
    return match_smaller(left, right, params);
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
