#pragma once

#include <opencv2/core/mat.hpp>

#include "common/camera/calibration.hpp"

namespace limbcast::stereo_camera {

struct SwapCheckParams {
  /// Width of the small images that are compared [px]: coarse, and fast.
  int width_px = 160;
  /// Distance of the blocks and half their size [px of the small image].
  int step_px = 8, half_block_px = 5;
  /// By how much the lines of two cameras differ before rectification [px of the small image].
  int line_tolerance_px = 2;
  /// Largest disparity looked for, either way, as a share of the image's width.
  double reach = 0.2;
  /// Grey levels' standard deviation below which a block has no texture to match.
  double min_deviation = 6.0;
  /// Correlation that a match must have, and its lead over any other place on the line. By eye on
  /// stereo_dev: leaves 20 blocks or more a frame.
  double min_correlation = 0.9, min_lead = 0.05;
  /// A block counts as behind infinity by more than this [px of the small image].
  double margin_px = 0.75;
  /// Fewer blocks say nothing.
  int min_blocks = 20;
  /// Share of blocks behind infinity from which the images must be swapped: with the cameras in
  /// order only wrong matches are there, swapped all but the far ones.
  double min_share = 0.7;
};

/// What the blocks of a pair say: nothing can stand behind infinity, unless left and right are
/// swapped.
struct SwapEvidence {
  int blocks = 0, behind_infinity = 0;

  SwapEvidence& operator+=(const SwapEvidence& other) {
    blocks += other.blocks;
    behind_infinity += other.behind_infinity;
    return *this;
  }
};

/// 8-bit grey images as the camera took them.
SwapEvidence compare_blocks(const cv::Mat& left_grey, const cv::Mat& right_grey,
                            const StereoCalibration& calibration,
                            const SwapCheckParams& params = {});

bool looks_swapped(const SwapEvidence& evidence, const SwapCheckParams& params = {});

}  // namespace limbcast::stereo_camera
