#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "modules/calibrate/fit_params.hpp"
#include "modules/calibrate/lens_fit.hpp"
#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// A view that does not fit with the others.
struct Outlier {
  std::size_t index = 0;
  double excess = 0.0;  ///< error as a multiple of what is allowed
  std::string reason;
};

/// From the left camera to the right one, as most views put it. `lenses` are those of these views.
Pose pose_of_pair(const std::vector<View>& views, const Board& board, const Lenses& lenses,
                  const FitParams& params);

/// The view whose right image shows the board farthest from where the left one and the other views
/// put it, as a share of what is allowed. Before the lenses are refined by what both cameras see:
/// then they bend until a board that moved between the images fits and the good views no longer do.
/// The pose of the pair is that on which most views agree (least median of squares: Rousseeuw,
/// Least Median of Squares Regression, 1984), so that nearly half of the views may be wrong.
/// `lenses` are those of these views.
Outlier most_disagreeing_view(const std::vector<View>& views, const Board& board,
                              const Lenses& lenses, const FitParams& params);

}  // namespace limbcast::calibrate
