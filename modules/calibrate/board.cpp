#include "modules/calibrate/board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "common/units.hpp"

namespace limbcast::calibrate {
namespace {

/// Share of a square that a marker takes, and of the distance of two circles that one is wide.
constexpr double kMarkerShare = 0.7, kCircleShare = 0.5;

cv::Size lattice(const Board& board) { return {board.columns, board.rows}; }

/// The smallest of OpenCV's dictionaries with these markers that has enough for the board. Its
/// markers are the first ones of the larger ones; the fewer there are, the more misread bits still
/// tell which one is meant.
cv::Ptr<cv::aruco::Dictionary> dictionary_of(const Board& board) {
  static const std::map<std::string, int> kSmallest = {{"4x4", cv::aruco::DICT_4X4_50},
                                                       {"5x5", cv::aruco::DICT_5X5_50},
                                                       {"6x6", cv::aruco::DICT_6X6_50}};
  // In OpenCV's numbers the larger ones follow, in this order.
  constexpr std::array<int, 4> kSizes = {50, 100, 250, 1000};
  const int num_markers = (board.columns + 1) * (board.rows + 1) / 2;
  // Of a board with more markers than any has OpenCV tells with the largest.
  const auto size = std::lower_bound(kSizes.begin(), kSizes.end() - 1, num_markers);
  return cv::aruco::getPredefinedDictionary(kSmallest.at(board.dictionary) +
                                            static_cast<int>(size - kSizes.begin()));
}

cv::Ptr<cv::aruco::CharucoBoard> charuco_of(const Board& board) {
  return cv::aruco::CharucoBoard::create(board.columns + 1, board.rows + 1,
                                         static_cast<float>(board.square_m),
                                         static_cast<float>(board.marker_m), dictionary_of(board));
}

BoardPoints numbered(std::vector<cv::Point2f> pixels) {
  BoardPoints points;
  points.ids.resize(pixels.size());
  std::iota(points.ids.begin(), points.ids.end(), 0);
  points.pixels = std::move(pixels);
  return points;
}

/// Window of cv::cornerSubPix: 11 x 11 px as in OpenCV's calibration example, at least 5 x 5.
constexpr int kHalfWindow_px = 5, kLeastHalfWindow_px = 2;
/// On a chessboard it may be larger: a third of the shortest side of a square holds one corner
/// only.
constexpr double kHalfWindowSquares = 1.0 / 3.0;

/// The shortest distance of neighbours in a row or a column of a lattice, row by row [px].
double shortest_side_px(const std::vector<cv::Point2f>& lattice, int columns) {
  double shortest_px = std::numeric_limits<double>::infinity();
  const auto stride = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const bool is_last_of_row = i % stride == stride - 1;
    if (!is_last_of_row) shortest_px = std::min(shortest_px, cv::norm(lattice[i + 1] - lattice[i]));
    if (i + stride < lattice.size())
      shortest_px = std::min(shortest_px, cv::norm(lattice[i + stride] - lattice[i]));
  }
  return shortest_px;
}

void refine_corners(const cv::Mat& grey, std::vector<cv::Point2f>& corners, int half_window_px) {
  constexpr int kIterations = 50;
  constexpr double kStep_px = 0.005;
  cv::cornerSubPix(grey, corners, {half_window_px, half_window_px}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kIterations, kStep_px});
}

/// The sector-based detector (Duda and Frese 2018) stands blur and glare; the older one finds some
/// boards at a slant that it misses. Both give corners to refine: those of the former are off by up
/// to 0.2 px on boards at a slant of 30 degrees, refined ones by 0.03 px.
std::optional<BoardPoints> find_chessboard(const cv::Mat& grey, const Board& board) {
  constexpr int kFlags =
      cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCornersSB(grey, lattice(board), corners, kFlags) &&
      !cv::findChessboardCorners(grey, lattice(board), corners))
    return std::nullopt;
  const auto half_window_px =
      static_cast<int>(kHalfWindowSquares * shortest_side_px(corners, board.columns));
  refine_corners(grey, corners, std::max(kLeastHalfWindow_px, half_window_px));
  return numbered(corners);
}

std::optional<BoardPoints> find_circles(const cv::Mat& grey, const Board& board) {
  // The first way misses boards that are turned about their normal by some 30 to 60 degrees or
  // tilted much, the second one some that the first one finds.
  constexpr int kGrid = cv::CALIB_CB_SYMMETRIC_GRID;
  std::vector<cv::Point2f> centres;
  if (!cv::findCirclesGrid(grey, lattice(board), centres, kGrid) &&
      !cv::findCirclesGrid(grey, lattice(board), centres, kGrid | cv::CALIB_CB_CLUSTERING))
    return std::nullopt;
  return numbered(centres);
}

/// Half the width of the largest window about a corner that holds nothing of the markers beside it
/// [px]; they stand half of the difference between square and marker away.
int free_half_window_px(const std::vector<std::vector<cv::Point2f>>& markers, const Board& board) {
  double smallest_side_px = std::numeric_limits<double>::infinity();
  for (const std::vector<cv::Point2f>& marker : markers) {
    for (std::size_t i = 0; i < marker.size(); ++i)
      smallest_side_px =
          std::min(smallest_side_px, cv::norm(marker[i] - marker[(i + 1) % marker.size()]));
  }
  const double gap_squares = 0.5 * (board.square_m - board.marker_m) / board.square_m;
  return static_cast<int>(gap_squares * smallest_side_px * board.square_m / board.marker_m);
}

std::optional<BoardPoints> find_charuco(const cv::Mat& grey, const Board& board) {
  const cv::Ptr<cv::aruco::CharucoBoard> charuco = charuco_of(board);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> marker_ids;
  std::vector<std::vector<cv::Point2f>> unread;
  cv::aruco::detectMarkers(grey, charuco->dictionary, markers, marker_ids,
                           cv::aruco::DetectorParameters::create(), unread);
  if (marker_ids.empty()) return std::nullopt;
  // In small or noisy markers single bits are misread; where one stands tells which it is. A corner
  // wants both markers beside it, so that one unread marker costs four.
  cv::aruco::refineDetectedMarkers(grey, charuco, markers, marker_ids, unread);
  BoardPoints points;
  cv::aruco::interpolateCornersCharuco(markers, marker_ids, grey, charuco, points.pixels,
                                       points.ids);
  if (points.ids.empty()) return std::nullopt;
  // OpenCV stops at a step of 0.1 px.
  refine_corners(
      grey, points.pixels,
      std::clamp(free_half_window_px(markers, board), kLeastHalfWindow_px, kHalfWindow_px));
  return points;
}

/// OpenCV's detectors throw on smaller pictures than can show a board.
bool can_show(const cv::Mat& grey, const Board& board) {
  constexpr int kLeastSquare_px = 4;
  return std::min(grey.cols, grey.rows) >=
         kLeastSquare_px * (std::min(board.columns, board.rows) + 1);
}

cv::Mat draw_squares(const Board& board, int square_px) {
  cv::Mat image((board.rows + 1) * square_px, (board.columns + 1) * square_px, CV_8UC1,
                cv::Scalar(255));
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = row % 2; column <= board.columns; column += 2)
      image({column * square_px, row * square_px, square_px, square_px}).setTo(0);
  }
  return image;
}

cv::Mat draw_circles(const Board& board, int square_px) {
  cv::Mat image(board.rows * square_px, board.columns * square_px, CV_8UC1, cv::Scalar(255));
  // Fractions of a pixel, so that no centre is rounded.
  constexpr int kFractionBits = 4, kUnit = 1 << kFractionBits;
  const int radius = cvRound(0.5 * kCircleShare * square_px * kUnit);
  for (int id = 0; id < board.num_points(); ++id) {
    const int column = id % board.columns;
    const int row = id / board.columns;
    const cv::Point2d centre(square_px * (column + 0.5) - 0.5, square_px * (row + 0.5) - 0.5);
    cv::circle(image, {cvRound(centre.x * kUnit), cvRound(centre.y * kUnit)}, radius, 0, cv::FILLED,
               cv::LINE_AA, kFractionBits);
  }
  return image;
}

cv::Mat draw_charuco(const Board& board, int square_px) {
  cv::Mat image;
  charuco_of(board)->draw({(board.columns + 1) * square_px, (board.rows + 1) * square_px}, image);
  return image;
}

/// How well two lattices lie the same way round: the sum over pairs of points on opposite sides of
/// the middle of what their lines have in common [px^2].
double agreement_of(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += (a[i] - a[a.size() - 1 - i]).dot(b[i] - b[b.size() - 1 - i]);
  return sum;
}

/// A lattice of `side` columns and rows, numbered as somebody does who has turned it by 90 degrees.
std::vector<cv::Point2f> turned_by_quarter(const std::vector<cv::Point2f>& lattice, int side) {
  std::vector<cv::Point2f> turned;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column)
      turned.push_back(lattice[(side - 1 - column) * side + row]);
  }
  return turned;
}

}  // namespace

cv::Point3f Board::point_m(int id) const {
  const int column = id % columns;
  const int row = id / columns;
  return {static_cast<float>(square_m * column), static_cast<float>(square_m * row), 0.0F};
}

void declare(config::Section& section, BoardOptions& options) {
  section.add_choice("board", options.kind, {"chessboard", "circles", "charuco"},
                     "what is on the board");
  section.add("columns", options.columns, "", "inner corners in a row (circles in a row)", {3, 25});
  section.add("rows", options.rows, "", "inner corners in a column (circles in a column)", {3, 25});
  section.add("square-mm", options.square_mm, "mm",
              "side of a square as measured on the board (distance of two circles' centres)",
              {0.1, 10000.0});
  section.add("marker-mm", options.marker_mm, "mm", "side of a ChArUco marker; 0: 0.7 of a square",
              {0.0, 10000.0});
  section.add_choice("dictionary", options.dictionary, {"4x4", "5x5", "6x6"},
                     "ChArUco markers: OpenCV's DICT_4X4, DICT_5X5 or DICT_6X6");
}

Board to_board(const BoardOptions& options) {
  static const std::map<std::string, BoardKind> kKinds = {{"chessboard", BoardKind::kChessboard},
                                                          {"circles", BoardKind::kCircles},
                                                          {"charuco", BoardKind::kCharuco}};
  if (options.marker_mm >= options.square_mm)
    throw config::UsageError("'marker-mm' must be smaller than 'square-mm'");
  Board board;
  board.kind = kKinds.at(options.kind);
  board.columns = options.columns;
  board.rows = options.rows;
  board.square_m = options.square_mm / kMillimetersPerMeter<double>;
  board.marker_m = options.marker_mm > 0.0 ? options.marker_mm / kMillimetersPerMeter<double>
                                           : kMarkerShare * board.square_m;
  board.dictionary = options.dictionary;
  return board;
}

std::optional<BoardPoints> find_board(const cv::Mat& grey, const Board& board) {
  if (!can_show(grey, board)) return std::nullopt;
  switch (board.kind) {
    case BoardKind::kCircles:
      return find_circles(grey, board);
    case BoardKind::kCharuco:
      return find_charuco(grey, board);
    case BoardKind::kChessboard:
      break;
  }
  return find_chessboard(grey, board);
}

std::optional<BoardPoints> glimpse_board(const cv::Mat& grey, const Board& board) {
  if (!can_show(grey, board)) return std::nullopt;
  if (board.kind != BoardKind::kChessboard) return find_board(grey, board);
  constexpr int kLargestWidth_px = 640;
  const double scale = std::min(1.0, static_cast<double>(kLargestWidth_px) / grey.cols);
  cv::Mat small;
  cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
  if (!can_show(small, board)) return std::nullopt;
  constexpr int kFlags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(small, lattice(board), corners, kFlags)) return std::nullopt;
  for (cv::Point2f& corner : corners) corner /= scale;
  return numbered(std::move(corners));
}

void align_numbering(const Board& board, const BoardPoints& left, BoardPoints& right) {
  if (board.kind == BoardKind::kCharuco) return;
  std::vector<cv::Point2f> turned = right.pixels;
  const int turns = board.columns == board.rows ? 4 : 2;
  double best = -std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const double agreement = agreement_of(left.pixels, turned);
    if (agreement > best) right.pixels = turned;
    best = std::max(best, agreement);
    turned = turns == 4 ? turned_by_quarter(turned, board.columns)
                        : std::vector<cv::Point2f>(turned.rbegin(), turned.rend());
  }
}

cv::Mat draw_board(const Board& board, int square_px) {
  cv::Mat image;
  if (board.kind == BoardKind::kChessboard) image = draw_squares(board, square_px);
  if (board.kind == BoardKind::kCircles) image = draw_circles(board, square_px);
  if (board.kind == BoardKind::kCharuco) image = draw_charuco(board, square_px);
  const int margin_px = square_px / 2;
  cv::copyMakeBorder(image, image, margin_px, margin_px, margin_px, margin_px, cv::BORDER_CONSTANT,
                     cv::Scalar(255));
  return image;
}

}  // namespace limbcast::calibrate
