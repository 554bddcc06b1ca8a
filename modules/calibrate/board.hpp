#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/options.hpp"

namespace limbcast::calibrate {

enum class BoardKind { kChessboard, kCircles, kCharuco };

/// A flat board with a lattice of points. Point `id` stands in column id % columns and row
/// id / columns.
struct Board {
  BoardKind kind = BoardKind::kChessboard;
  /// Inner corners (chessboard, ChArUco) or circles.
  int columns = 9, rows = 6;
  double square_m = 0.025;   ///< side of a square, or distance of two circles' centres
  double marker_m = 0.0175;  ///< side of a ChArUco marker
  std::string dictionary = "5x5";

  int num_points() const { return columns * rows; }
  cv::Point3f point_m(int id) const;
};

/// Points of a board in one image, in ascending order of their ids.
struct BoardPoints {
  std::vector<int> ids;
  std::vector<cv::Point2f> pixels;
};

/// What users tell about their board.
struct BoardOptions {
  std::string kind = "chessboard";
  /// With 25 mm squares this fits on a sheet of A4.
  int columns = 9, rows = 6;
  double square_mm = 25.0;
  double marker_mm = 0.0;  ///< 0: 0.7 of a square
  std::string dictionary = "5x5";
};

void declare(config::Section& section, BoardOptions& options);
/// Throws config::UsageError where no such board can be.
Board to_board(const BoardOptions& options);

/// The points of `board` in an 8-bit grey image, to a fraction of a pixel. Chessboard and circles:
/// all of them or nothing; ChArUco: those that are seen.
std::optional<BoardPoints> find_board(const cv::Mat& grey, const Board& board);

/// The same, quickly rather than exactly and in all cases: to see where a video shows the board.
std::optional<BoardPoints> glimpse_board(const cv::Mat& grey, const Board& board);

/// Chessboards and circles look the same upside down, with as many columns as rows also on their
/// side: gives `right` the numbering of `left`, as both cameras of a pair stand the same way up.
void align_numbering(const Board& board, const BoardPoints& left, BoardPoints& right);

/// The board as it is printed, 8-bit grey, `square_px` for each square, with a white
/// margin of half a square.
cv::Mat draw_board(const Board& board, int square_px);

}  // namespace limbcast::calibrate
