#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "modules/calibrate/board.hpp"
#include "modules/calibrate/seen_area.hpp"
#include "modules/calibrate/sharpness.hpp"

namespace limbcast::calibrate {

enum class Side { kLeft, kRight };

/// A pair as a source gives it, 8-bit grey.
struct GreyPair {
  std::string name;
  cv::Mat left, right;
  std::int64_t utime = 0;  ///< when it was taken [us]; of separate shots nobody asks
};

/// The board as both cameras see it at once.
struct View {
  std::string name;
  BoardPoints left, right;
};

/// Why a pair gives no view.
struct Reason {
  std::string kind;  ///< without figures: pairs are counted by it
  std::string text;  ///< empty: there is none
};
inline constexpr const char* kBoardMoves = "the board moves";

struct RejectedView {
  std::string name;
  Reason reason;
};

struct ViewParams {
  /// Points that both images must show. A pose has 6 unknowns and 4 points give it; more tell
  /// lens and error apart.
  int min_points = 12;
  /// Of the edges on the board.
  SharpnessParams sharpness;
  /// A shot whose points stand within this of those of one before adds nothing but its noise [px]:
  /// a copy, or a board on a stand. Of a board that is held the points move by whole pixels.
  double min_shot_shift_px = 0.5;
  /// In a video or live: how fast the points may move [px/s]. Two cameras that are paired within
  /// 10 ms (--pair-tolerance-ms) then see them 0.3 px apart, no more than a good view's error.
  /// Hands that hold a board still pass. A speed, as the frames of a busy computer lie far apart.
  double max_speed_px_s = 30.0;
  /// In a video or live: a view adds something where the board has moved by this share of the
  /// image's width; some thirty such places cover the image.
  double min_shift = 0.04;
  /// Or where it looks different: its points moved against one another by this share of its size.
  /// That is a tilt from 0 to 25 degrees, or a fourteenth of the distance.
  double min_shape_change = 0.07;
};

/// Gathers views that are fit for calibration and says why others are not.
class ViewCollector {
 public:
  /// `in_sequence`: the pairs come from a video or live camera, not as separate shots.
  ViewCollector(const Board& board, bool in_sequence, const ViewParams& params = {})
      : board_(board), in_sequence_(in_sequence), params_(params) {}

  /// True: the pair gave a view. Throws InputError where its size is not that of the first pair.
  bool add(const GreyPair& pair);

  const std::vector<View>& views() const { return views_; }
  const std::vector<RejectedView>& rejected() const { return rejected_; }
  const cv::Size& image_size() const { return image_size_; }
  /// By the pairs so far, of which there must be one.
  SeenAreas seen_areas(LensModel model) const { return seen_areas_.areas(model); }

 private:
  /// Where a frame of a video shows the board, roughly.
  struct Glimpse {
    View view;
    std::int64_t utime = 0;
  };

  void check_size(const GreyPair& pair);
  Reason why_wait(const GreyPair& pair);
  Reason why_not_here(const Glimpse& glimpse) const;
  Reason why_no_new_shot(const View& view) const;
  Reason find_view(const GreyPair& pair, std::optional<View>& view) const;

  Board board_;
  bool in_sequence_;
  ViewParams params_;
  cv::Size image_size_;
  SeenAreaFinder seen_areas_;
  std::optional<Glimpse> previous_;   ///< in the pair before, good or not
  std::vector<View> taken_glimpses_;  ///< one for each view of a video
  std::vector<View> views_;
  std::vector<RejectedView> rejected_;
};

/// Points that both images show, in the same order.
struct CommonPoints {
  std::vector<int> ids;
  std::vector<cv::Point2f> left, right;
};
CommonPoints common_points(const BoardPoints& left, const BoardPoints& right);

}  // namespace limbcast::calibrate
