#include "modules/simulate/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace limbcast::simulate {
namespace {

/// Nearest and farthest depth around each pixel, holes left out.
void depth_range(const cv::Mat& depth_m, int radius_px, cv::Mat& nearest, cv::Mat& farthest) {
  const cv::Mat kernel =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius_px + 1, 2 * radius_px + 1});
  cv::Mat filled = depth_m.clone();
  filled.setTo(1e3F, depth_m <= 0.0F);
  cv::erode(filled, nearest, kernel);
  cv::dilate(depth_m, farthest, kernel);
}

/// Pixels of the left image that a camera or projector at `baseline_m` to the right does not see.
cv::Mat hidden_from_right(const cv::Mat& depth_m, double focal_times_baseline) {
  cv::Mat hidden(depth_m.size(), CV_8U, cv::Scalar(0));
  for (int v = 0; v < depth_m.rows; ++v) {
    // Going right in the left image, the right image is filled from the left as well; a pixel is
    // hidden when one farther right, nearer to the camera, lands left of it or on it.
    double leftmost = 1e9;
    for (int u = depth_m.cols - 1; u >= 0; --u) {
      const float z = depth_m.at<float>(v, u);
      if (z <= 0.0F) continue;
      const double landing = u - focal_times_baseline / z;
      if (landing > leftmost - 0.5) hidden.at<std::uint8_t>(v, u) = 255;
      leftmost = std::min(leftmost, landing);
    }
  }
  return hidden;
}

/// Threshold of a normal variable that `share` of it exceeds, by bisection of the error function.
float exceeded_by(double share) {
  double low = -6.0;
  double high = 6.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return static_cast<float>(low);
}

/// Nearer things grow over what lies behind them by up to `reach_px`, ragged.
cv::Mat grown(const cv::Mat& depth_m, double reach_px, double edge_share, Rng& rng) {
  if (reach_px < 0.5) return depth_m.clone();
  const int most = static_cast<int>(std::ceil(reach_px));
  const cv::Mat raggedness = smooth_noise(depth_m.cols, depth_m.rows, 4.0, rng);
  cv::Mat result = depth_m.clone();
  for (int radius = most; radius >= 1; --radius) {
    cv::Mat nearest;
    cv::Mat farthest;
    depth_range(depth_m, radius, nearest, farthest);
    // Few places grow by the whole reach, half of them by the half.
    const float threshold = exceeded_by(std::clamp(1.0 - (radius - 0.5) / reach_px, 0.02, 0.98));
    for (int v = 0; v < depth_m.rows; ++v) {
      for (int u = 0; u < depth_m.cols; ++u) {
        const float near = nearest.at<float>(v, u);
        const bool edge = near < depth_m.at<float>(v, u) * (1.0 - edge_share);
        if (edge && raggedness.at<float>(v, u) > threshold) result.at<float>(v, u) = near;
      }
    }
  }
  return result;
}

}  // namespace

cv::Mat smooth_noise(int width, int height, double sigma_px, Rng& rng) {
  cv::Mat noise(height, width, CV_32F);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) noise.at<float>(v, u) = rng.pixel_noise();
  }
  if (sigma_px > 0.2)
    cv::GaussianBlur(noise, noise, {}, sigma_px, sigma_px, cv::BORDER_REFLECT_101);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(noise, mean, deviation);
  return (noise - mean[0]) / std::max(deviation[0], 1e-6);
}

DepthSensorParams draw_depth_sensor(Rng& rng) {
  DepthSensorParams params;
  const double scale = rng.uniform(0.4, 1.4);
  params.constant_sigma_m *= scale;
  params.quadratic_sigma_per_m *= scale;
  params.correlation_px = rng.uniform(0.0, 2.0);
  params.lateral_sigma_px = rng.uniform(0.2, 1.0);
  params.flying_share = rng.uniform(0.0, 0.5);
  params.skirt_px = rng.chance(0.25) ? rng.uniform(1.0, 8.0) : 0.0;
  params.projector_baseline_m = rng.uniform(0.0, 0.075);
  params.grazing_cosine = rng.uniform(0.02, 0.15);
  params.speckle_share = rng.uniform(0.0, 0.02);
  params.step_px = rng.chance(0.5) ? 0.125 : 0.0;
  return params;
}

StereoSensorParams draw_stereo_sensor(Rng& rng) {
  StereoSensorParams params;
  params.sigma_px = rng.uniform(0.06, 0.22);
  params.correlation_px = rng.uniform(1.5, 3.5);
  params.weak_texture = rng.uniform(1.0, 3.0);
  params.fattening_px = rng.uniform(0.0, 6.0);
  params.hole_share = rng.uniform(0.0, 0.03);
  params.blunder_share = rng.uniform(0.0, 0.01);
  params.occlusion_filled = rng.uniform(0.0, 0.6);
  return params;
}

cv::Mat sense_depth(const cv::Mat& true_depth_m, const cv::Mat& facing, const PinholeCamera& camera,
                    const DepthSensorParams& params, Rng rng) {
  const int width = true_depth_m.cols;
  const int height = true_depth_m.rows;
  const cv::Mat solid = grown(true_depth_m, params.skirt_px, 0.04, rng);
  cv::Mat nearest;
  cv::Mat farthest;
  depth_range(solid, 1, nearest, farthest);
  const double focal_times_baseline =
      camera.fx * 0.075;  // Kinect's, for the steps of its disparity
  const cv::Mat hidden = hidden_from_right(solid, camera.fx * params.projector_baseline_m);
  const cv::Mat noise = smooth_noise(width, height, params.correlation_px, rng);
  const cv::Mat spots = smooth_noise(width, height, 1.5, rng);
  const float spot = exceeded_by(params.speckle_share);
  cv::Mat sensed(height, width, CV_32F, cv::Scalar(0));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int from_u =
          std::clamp(u + static_cast<int>(std::lround(params.lateral_sigma_px * rng.pixel_noise())),
                     0, width - 1);
      const int from_v =
          std::clamp(v + static_cast<int>(std::lround(params.lateral_sigma_px * rng.pixel_noise())),
                     0, height - 1);
      double z = solid.at<float>(from_v, from_u);
      const bool flies = rng.chance(params.flying_share);
      const double between = rng.uniform();
      if (z <= 0.0 || z > params.max_depth_m || hidden.at<std::uint8_t>(v, u) != 0) continue;
      if (spots.at<float>(v, u) > spot) continue;
      // A person's skirt has no true surface: it is measured, falsely, as if it faced the camera.
      if (facing.at<float>(from_v, from_u) < params.grazing_cosine &&
          solid.at<float>(v, u) == true_depth_m.at<float>(v, u))
        continue;
      const float near = nearest.at<float>(v, u);
      const float far = farthest.at<float>(v, u);
      if (flies && far - near > 0.03F * near) z = near + between * (far - near);
      z += noise.at<float>(v, u) *
           (params.constant_sigma_m + params.quadratic_sigma_per_m * (z - 0.4) * (z - 0.4));
      if (params.step_px > 0.0) {
        const double disparity = focal_times_baseline / z;
        z = focal_times_baseline /
            (std::max(1.0, std::round(disparity / params.step_px)) * params.step_px);
      }
      sensed.at<float>(v, u) = static_cast<float>(std::max(0.0, z));
    }
  }
  return sensed;
}

cv::Mat sense_stereo(const cv::Mat& true_depth_m, const PinholeCamera& camera,
                     const StereoSensorParams& params, Rng rng) {
  const int width = true_depth_m.cols;
  const int height = true_depth_m.rows;
  const double fb = camera.fx * params.baseline_m;
  const cv::Mat hidden = hidden_from_right(true_depth_m, fb);
  const cv::Mat solid = grown(true_depth_m, params.fattening_px, 0.04, rng);
  const cv::Mat noise = smooth_noise(width, height, params.correlation_px, rng);
  const cv::Mat texture = smooth_noise(width, height, 15.0, rng);  // weak where high
  const cv::Mat holes = smooth_noise(width, height, 6.0, rng);
  const cv::Mat blunders = smooth_noise(width, height, 4.0, rng);
  const cv::Mat blunder_px = smooth_noise(width, height, 4.0, rng);
  const cv::Mat filling = smooth_noise(width, height, 4.0, rng);
  const float hole = exceeded_by(params.hole_share);
  const float blunder = exceeded_by(params.blunder_share);
  const float filled = exceeded_by(params.occlusion_filled);
  cv::Mat sensed(height, width, CV_32F, cv::Scalar(0));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float z = solid.at<float>(v, u);
      if (z <= 0.0F || holes.at<float>(v, u) + 0.5F * texture.at<float>(v, u) > 1.12F * hole)
        continue;
      const bool grown_here = z != true_depth_m.at<float>(v, u);
      if (hidden.at<std::uint8_t>(v, u) != 0 && !grown_here && filling.at<float>(v, u) < filled)
        continue;
      const double weakness = std::clamp(0.5 + 0.5 * texture.at<float>(v, u), 0.0, 1.0);
      double disparity = fb / z + params.sigma_px * noise.at<float>(v, u) *
                                      (1.0 + (params.weak_texture - 1.0) * weakness);
      if (blunders.at<float>(v, u) > blunder) disparity += 8.0 * blunder_px.at<float>(v, u);
      if (disparity < 1.0 || disparity > params.disparities) continue;
      sensed.at<float>(v, u) = static_cast<float>(fb / disparity);
    }
  }
  return sensed;
}

}  // namespace limbcast::simulate
