#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "modules/calibrate/board.hpp"

namespace limbcast::calibrate {

struct SharpnessParams {
  /// Edges of a chessboard in a sharp picture are up to about 3 px wide, as
  /// cv::estimateChessboardSharpness says; OpenCV's own example pairs reach 3.4. Wider: motion or
  /// focus.
  double max_edge_width_px = 5.0;
  /// Of the way from the middle of a circle to half-way to the next one the edge may take this
  /// share. Sharp ones take 0.2, none more than 0.6. Blurred more, circles grow together with the
  /// next and their middles shift: on rendered boards the focal length was off by less than 0.1 %
  /// up to this, and by 0.1 to 0.6 % beyond (README).
  double max_circle_edge_share = 0.55;
};

/// Width of edges from 10 to 90 % of their contrast, and up to which a picture is sharp [px].
struct EdgeWidth {
  double width_px = 0.0, limit_px = 0.0;
};

/// Of the edges of squares or circles between columns or between rows, whichever are blurred more;
/// nothing where not all points are seen, they are too small in the image to tell, or on a ChArUco
/// board: markers that are blurred are not found.
std::optional<EdgeWidth> widest_edge(const cv::Mat& grey, const Board& board,
                                     const BoardPoints& points, const SharpnessParams& params = {});

}  // namespace limbcast::calibrate
