#include "modules/reconstructor/speckles.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace limbcast::reconstructor {
namespace {

/// By OpenCV, in sixteenths of a pixel.
cv::Mat1f without_speckles_of_opencv(const SpeckleParams& params, const cv::Mat1f& disparity_px) {
  constexpr double kSteps = 16.0;
  cv::Mat1s fixed;
  disparity_px.convertTo(fixed, CV_16S, kSteps);
  cv::filterSpeckles(fixed, 0, params.max_size_px, params.max_step_px * kSteps);
  cv::Mat1f result = disparity_px.clone();
  result.setTo(0.0F, fixed == 0);
  return result;
}

TEST(RemoveSpeckles, DoesWhatOpenCvDoes) {
  cv::RNG random(1);
  // From nothing but noise to large surfaces with a few holes.
  for (const double share_of_holes : {0.6, 0.4, 0.2, 0.02}) {
    cv::Mat1f disparity_px(120, 161);
    random.fill(disparity_px, cv::RNG::UNIFORM, 10.0, 13.0);
    cv::Mat1f chance(disparity_px.size());
    random.fill(chance, cv::RNG::UNIFORM, 0.0, 1.0);
    disparity_px.setTo(0.0F, chance < share_of_holes);
    for (const int max_size_px : {1, 10, 100}) {
      const SpeckleParams params{max_size_px, 2.0F};
      const cv::Mat1f expected = without_speckles_of_opencv(params, disparity_px);
      cv::Mat1f filtered = disparity_px.clone();
      remove_speckles(params, filtered);
      EXPECT_EQ(cv::countNonZero(filtered != expected), 0)
          << share_of_holes << " holes, " << max_size_px << " px";
    }
  }
}

TEST(RemoveSpeckles, JoinsWhatMeetsFurtherDown) {
  // A U of 5 pixels: its arms are two groups until its bottom joins them.
  cv::Mat1f disparity_px = (cv::Mat1f(2, 3) << 5.0F, 0.0F, 5.0F, 5.0F, 5.0F, 5.0F);
  cv::Mat1f filtered = disparity_px.clone();
  remove_speckles({4, 2.0F}, filtered);
  EXPECT_EQ(cv::countNonZero(filtered != disparity_px), 0);
  remove_speckles({5, 2.0F}, filtered);
  EXPECT_EQ(cv::countNonZero(filtered), 0);
}

}  // namespace
}  // namespace limbcast::reconstructor
