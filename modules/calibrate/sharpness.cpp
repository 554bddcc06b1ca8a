#include "modules/calibrate/sharpness.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "common/median.hpp"

namespace limbcast::calibrate {
namespace {

constexpr double kLow = 0.1, kHigh = 0.9;  // of the contrast

/// Squares whose sides are shorter than this [px] OpenCV does not judge: it says so on stdout and
/// gives this for a width.
constexpr double kLeastSharpnessSide_px = 10.0, kNoSharpness = 9999.0;

/// The mean distance of a point and the one `step` after it: 1 along the rows, else along the
/// columns [px].
double mean_side_px(const std::vector<cv::Point2f>& lattice, const Board& board, int step) {
  double sum = 0.0;
  int count = 0;
  for (int id = 0; id + step < board.num_points(); ++id) {
    if (step == 1 && id % board.columns == board.columns - 1) continue;
    sum += cv::norm(lattice[id + step] - lattice[id]);
    ++count;
  }
  return sum / count;
}

/// Share of the way between two lattice points, from each to half-way, in which the brightness
/// changes; the median of all pairs of neighbours.
std::optional<double> circle_edge_share(const cv::Mat& grey, const Board& board,
                                        const std::vector<cv::Point2f>& centres, int step) {
  constexpr int kSamples = 64;  // fractions of a pixel
  std::vector<cv::Point2f> places;
  for (int id = 0; id + step < board.num_points(); ++id) {
    if (step == 1 && id % board.columns == board.columns - 1) continue;
    for (const auto& [from, to] : {std::pair(id, id + step), std::pair(id + step, id)}) {
      const cv::Point2f way = 0.5F * (centres[to] - centres[from]);
      for (int i = 0; i <= kSamples; ++i)
        places.push_back(centres[from] + static_cast<float>(i) / kSamples * way);
    }
  }
  cv::Mat profiles;
  cv::remap(grey, profiles,
            cv::Mat(places).reshape(2, static_cast<int>(places.size()) / (kSamples + 1)),
            cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  std::vector<double> shares;
  for (int row = 0; row < profiles.rows; ++row) {
    const auto* grey_levels = profiles.ptr<uchar>(row);
    const double middle = grey_levels[0];
    const double contrast = grey_levels[kSamples] - middle;
    const auto first_beyond = [&](double share) {
      int i = 0;
      while (i < kSamples && (grey_levels[i] - middle) / contrast < share) ++i;
      return i;
    };
    if (contrast != 0.0)
      shares.push_back((first_beyond(kHigh) - first_beyond(kLow)) / static_cast<double>(kSamples));
  }
  if (shares.empty()) return std::nullopt;
  return median(std::move(shares));
}

/// Of one direction: 1 along the rows, else along the columns.
std::optional<EdgeWidth> edge_of_circles(const cv::Mat& grey, const Board& board,
                                         const std::vector<cv::Point2f>& centres, int step,
                                         const SharpnessParams& params) {
  const double way_px = 0.5 * mean_side_px(centres, board, step);
  const std::optional<double> share = circle_edge_share(grey, board, centres, step);
  if (!share) return std::nullopt;
  return EdgeWidth{*share * way_px, params.max_circle_edge_share * way_px};
}

std::optional<EdgeWidth> edge_of_squares(const cv::Mat& grey, const Board& board,
                                         const std::vector<cv::Point2f>& corners, int step,
                                         const SharpnessParams& params) {
  if (mean_side_px(corners, board, step) < kLeastSharpnessSide_px) return std::nullopt;
  const double width_px = cv::estimateChessboardSharpness(
      grey, {board.columns, board.rows}, corners, static_cast<float>(kHigh - kLow), step == 1)[0];
  if (width_px >= kNoSharpness) return std::nullopt;
  return EdgeWidth{width_px, params.max_edge_width_px};
}

}  // namespace

std::optional<EdgeWidth> widest_edge(const cv::Mat& grey, const Board& board,
                                     const BoardPoints& points, const SharpnessParams& params) {
  const bool complete = static_cast<int>(points.ids.size()) == board.num_points();
  if (board.kind == BoardKind::kCharuco || !complete) return std::nullopt;
  std::optional<EdgeWidth> widest;
  // Motion blurs the edges across it only.
  for (const int step : {1, board.columns}) {
    const std::optional<EdgeWidth> edge =
        board.kind == BoardKind::kCircles
            ? edge_of_circles(grey, board, points.pixels, step, params)
            : edge_of_squares(grey, board, points.pixels, step, params);
    if (edge && (!widest || edge->width_px * widest->limit_px > widest->width_px * edge->limit_px))
      widest = edge;
  }
  return widest;
}

}  // namespace limbcast::calibrate
