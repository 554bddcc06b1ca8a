#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/pinhole_camera.hpp"
#include "modules/simulate/random.hpp"

namespace limbcast::simulate {

/// A camera that projects a pattern and triangulates it, as Kinect and RealSense do.
struct DepthSensorParams {
  double constant_sigma_m = 0.0012;  ///< Nguyen, Izadi and Lovell, 3DIMPVT 2012: sigma = 0.0012 +
  double quadratic_sigma_per_m = 0.0019;  ///< 0.0019 (z - 0.4)^2
  double correlation_px = 0.8;            ///< sigma of the patch over which the noise is alike
  double lateral_sigma_px =
      0.8;  ///< of the place that a pixel measures (same paper: 0.8 px): ragged edges
  double flying_share = 0.15;  ///< of the pixels at an edge that lie between front and back
  double skirt_px = 0.0;       ///< people grow by so much (a D435 with hole filling: up to 8)
  double projector_baseline_m =
      0.07;  ///< where the pattern does not reach is a hole; to the camera's right
  double grazing_cosine = 0.08;  ///< flatter surfaces return nothing
  double speckle_share = 0.003;  ///< of all pixels, in spots of a few pixels
  double max_depth_m = 6.0;      ///< beyond it there are holes
  double step_px = 0.125;        ///< of the disparity, 0 = none (Kinect: 1/8 px)
};

/// Another device with every frame: spreads the figures around the paper's, from good to bad.
DepthSensorParams draw_depth_sensor(Rng& rng);

/// What the sensor tells of the true depth [m], 32-bit float, 0 = hole. `facing`: see facing_image.
cv::Mat sense_depth(const cv::Mat& true_depth_m, const cv::Mat& facing, const PinholeCamera& camera,
                    const DepthSensorParams& params, Rng rng);

/// Depth from a passive stereo pair, without rendering the pair.
struct StereoSensorParams {
  double baseline_m = 0.12;
  double sigma_px = 0.12;  ///< of the disparity (SGBM's MAD on people is 0.11 to 0.15 px)
  double correlation_px =
      2.0;                    ///< sigma of the patch over which the noise is alike: about 5 px wide
  double weak_texture = 1.5;  ///< where texture is weak the noise is up to so many times stronger
  double fattening_px =
      3.0;  ///< silhouettes grow by up to so much (SGBM: 11 % of the pixels within 3 px)
  double hole_share = 0.02;      ///< of the image without texture: holes, in patches
  double blunder_share = 0.004;  ///< of the image with a wrong match, in patches
  double occlusion_filled =
      0.2;               ///< share of what the right camera cannot see that is filled all the same
  int disparities = 64;  ///< range of the search [px]: what is nearer is a hole
};

StereoSensorParams draw_stereo_sensor(Rng& rng);

/// What stereo matching tells of the true depth of the left camera [m], 32-bit float, 0 = hole.
cv::Mat sense_stereo(const cv::Mat& true_depth_m, const PinholeCamera& camera,
                     const StereoSensorParams& params, Rng rng);

/// White noise smoothed over `sigma_px`, of mean 0 and standard deviation 1, 32-bit float.
cv::Mat smooth_noise(int width, int height, double sigma_px, Rng& rng);

}  // namespace limbcast::simulate
