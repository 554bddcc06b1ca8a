#pragma once

namespace limbcast::calibrate {

/// When a view or a point is an outlier, and when a fit ends.
struct FitParams {
  /// Views without which nothing is computed. Three fix the intrinsics of a lens without
  /// distortion (Zhang 2000); with five terms of distortion and noise five are the least.
  int min_views = 5;
  /// A view is an outlier where its error is more than so many times the median view's, and more
  /// than so many pixels. Wrong points are off by whole pixels; by eye on OpenCV's example pairs,
  /// whose good views reach twice the median and 0.5 px.
  double outlier_factor = 3.0, outlier_px = 0.6;
  /// A point is outlying where it stands farther from where the others of its board put it than so
  /// many times their median distance, and than so many pixels. The points of OpenCV's example
  /// pairs are off by up to 3.8 medians and 0.5 px, of rendered boards by 3.4 and 0.4; where a
  /// point in every second view was off by 3 px the focal length was by 0.37 %. Less leaves good
  /// points out and hides that a lens or a board is none such.
  double outlying_factor = 6.0, outlying_px = 1.0;
  /// At most this share of the points that an image shows of the board, but one in any case; where
  /// more are off it is the view that is wrong. Five of a board of 9 x 6.
  double max_outlying_share = 0.1;
  /// How often the lenses are fitted without the points that are outlying by those before. Mostly
  /// the second time finds the same as the first.
  int max_point_rounds = 4;
  /// Views are compared by the lenses that each camera alone has found where the standard deviation
  /// of their focal lengths is no more than this share of them, and a view may be off by so many
  /// pixels more for each per cent of it. On rendered boards of which good views were off by 1.8 px
  /// it was 0.9 %.
  double known_focal_sigma = 0.01, lens_error_px_per_percent = 2.0;
  /// How far a board is turned [rad] and moved [sides of a square] to see how its pixels change.
  /// That is thousandths to hundredths of a pixel: far above rounding, and still a straight line.
  double small_motion = 1e-4;
  /// Where the fit of all at once ends: iterations, and change of the unknowns as a share of them.
  /// Stricter than the 30 and 1e-6 that cv::stereoCalibrate has by default.
  int max_iterations = 100;
  double min_change = 1e-7;
  /// Fields across the longer side of the image from which the fit of a fisheye lens begins
  /// [degrees], those that are sold; in such steps it finds the lens from the nearest one.
  double smallest_fisheye_deg = 60.0, largest_fisheye_deg = 240.0, fisheye_step_deg = 20.0;
};

}  // namespace limbcast::calibrate
