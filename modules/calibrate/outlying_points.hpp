#pragma once

#include <string>
#include <vector>

#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/lens_fit.hpp"
#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// A point that one image shows elsewhere than the other points of its board put it.
struct OutlyingPoint {
  std::string view;
  Side side = Side::kLeft;
  int id = 0;
  double error_px = 0.0;
};

/// Views without their outlying points.
struct GoodPoints {
  std::vector<View> views;
  std::vector<OutlyingPoint> left_out;
};

/// Leaves single points out that one camera's lens and the others of their board put elsewhere: a
/// corner that slipped to a finger's edge or a glare's. Where more of a board than a few are off,
/// the view is wrong and not its points, and all of them stay. `lenses` are those of these views,
/// whether fitted with the outlying points or without.
GoodPoints without_outlying_points(const std::vector<View>& views, const Board& board,
                                   const Lenses& lenses, const FitParams& params);

/// Each camera alone (fit_lenses), from the points that are not outlying by the lenses that these
/// give.
struct GoodFit {
  GoodPoints points;
  Lenses lenses;
};
GoodFit fit_good_points(const std::vector<View>& views, const Board& board, const cv::Size& size,
                        Distortion distortion, const FitParams& params);

}  // namespace limbcast::calibrate
