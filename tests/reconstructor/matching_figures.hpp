#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "tests/reconstructor/stereo_truth.hpp"

namespace limbcast::test {

/// How well disparities fit the truth on people, gathered over frames.
class MatchingFigures {
 public:
  void add(const cv::Mat1f& disparity_px, const TrueFrame& frame);

  /// Nobody was seen: the other figures are not numbers.
  bool empty() const { return pixels_ == 0; }
  /// Share of the people's pixels with a disparity.
  double valid_share() const;
  /// Share of these that are off by more than 2 px.
  double bad_share() const;
  /// Error inside people (4 px from the silhouette): median of |error|, and of |error - its
  /// median|.
  double median_error_px() const;
  double mad_px() const;
  /// Spread (1.48 MAD) of the mean error of windows of 15 x 15 px: what smoothing cannot take away.
  double window_error_px() const;
  /// Largest minus smallest median error over 16 bins of the true disparity's fraction: pixel
  /// locking.
  double locking_px() const;
  /// Strict silhouettes: of the pixels at a person's depth near people those that are people
  /// (precision); of the people's pixels those at the right depth (within 1.5 px: recall); the same
  /// of parts thinner than 17 px.
  double precision() const;
  double recall() const;
  double thin_recall() const;

 private:
  void add_inside(const cv::Mat1f& disparity_px, const TrueFrame& frame, const cv::Mat1b& people);
  void add_silhouette(const cv::Mat1f& disparity_px, const TrueFrame& frame,
                      const cv::Mat1b& people);

  long pixels_ = 0, valid_ = 0, bad_ = 0, good_ = 0, fat_ = 0, thin_ = 0, thin_good_ = 0;
  std::vector<float> errors_px_, window_errors_px_;
  std::array<std::vector<float>, 16> errors_by_fraction_px_;
};

}  // namespace limbcast::test
