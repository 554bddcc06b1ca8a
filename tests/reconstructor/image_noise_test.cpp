#include "modules/reconstructor/image_noise.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "modules/reconstructor/colors.hpp"
#include "modules/reconstructor/matcher.hpp"
#include "tests/reconstructor/stereo_truth.hpp"
#include "tests/reconstructor/synthetic_pair.hpp"

namespace limbcast::reconstructor {
namespace {

cv::Mat1b with_noise(const cv::Mat& grey, double sigma, std::uint64_t seed) {
  cv::Mat1f noise(grey.size()), sum;
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  grey.convertTo(sum, CV_32F);
  return cv::Mat1b(sum + noise);
}

/// Walls in the light and a dark corner of a third of the image.
cv::Mat1b room() {
  cv::Mat1b grey(480, 640);
  for (int v = 0; v < grey.rows; ++v)
    for (int u = 0; u < grey.cols; ++u) grey(v, u) = static_cast<uchar>(120 + u / 8);
  for (int u = 0; u < 400; u += 20) cv::line(grey, {u, 0}, {u + 40, 479}, cv::Scalar(180), 3);
  grey(cv::Rect(420, 0, 220, 480)) = 40;
  return grey;
}

TEST(ImageNoise, IsToldBesideSlopesAndEdges) {
  EXPECT_LT(noise_of(room()), 0.3);
  for (const double sigma : {2.0, 5.0, 10.0})
    EXPECT_NEAR(noise_of(with_noise(room(), sigma, 1)), sigma, 0.15 * sigma);
}

TEST(ImageNoise, IsToldOfDarkParts) {
  cv::Mat1b image = room();
  const cv::Rect dark(420, 0, 220, 480);
  with_noise(image(dark), 4.0, 1).copyTo(image(dark));
  EXPECT_NEAR(noise_of(image), 4.0, 0.6);
}

TEST(ImageNoise, IsLittleInRecordings) {
  const std::string folder = test::stereo_dev_folder() + "/general";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const std::vector<std::string> names = test::frame_names(folder);
  for (std::size_t i = 0; i < names.size(); i += 10)
    EXPECT_LT(noise_of(grey_of(test::read_true_frame(folder, names[i], 1.0).left)), 1.0) << i;
}

TEST(ImageNoise, LeavesAQuietPairAsItIs) {
  const cv::Mat1b left = with_noise(room(), 1.0, 1), right = with_noise(room(), 1.0, 2);
  const QuietPair quiet = quieted(left, right);
  EXPECT_EQ(quiet.left.data, left.data);
  EXPECT_EQ(quiet.right.data, right.data);
}

TEST(ImageNoise, IsBlurredAlikeWhereOneImageHasIt) {
  const cv::Mat1b left = with_noise(room(), 5.0, 1), right = room();
  const QuietPair quiet = quieted(left, right);
  EXPECT_LT(noise_of(quiet.left), 1.5);
  EXPECT_GT(cv::norm(quiet.right, right, cv::NORM_INF), 5.0);
}

TEST(ImageNoise, TakesFewMatches) {
  // Structure of 15 px and a contrast as clothes have it.
  cv::Mat left = test::scene_texture();
  cv::GaussianBlur(left, left, {}, 2.0);
  constexpr int kDisparity_px = 20;
  cv::Mat right;
  cv::copyMakeBorder(left.colRange(kDisparity_px, left.cols), right, 0, 0, 0, kDisparity_px,
                     cv::BORDER_REPLICATE);
  const DisparityImage found = match(with_noise(left, 8.0, 1), with_noise(right, 8.0, 2));
  const cv::Mat1f seen = found.disparity_px.colRange(64, left.cols - kDisparity_px);
  const int near = cv::countNonZero((seen > kDisparity_px - 1) & (seen < kDisparity_px + 1));
  EXPECT_GT(near, 0.85 * static_cast<double>(seen.total()));
}

}  // namespace
}  // namespace limbcast::reconstructor
