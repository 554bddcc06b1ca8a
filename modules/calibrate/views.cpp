#include "modules/calibrate/views.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>

#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast::calibrate {
namespace {

constexpr double kMicroseconds_s = 1e-6;

std::string size_text(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// Mean distance of the points that both have [px]; without any they are far apart.
double mean_distance_px(const BoardPoints& a, const BoardPoints& b) {
  const CommonPoints common = common_points(a, b);
  if (common.ids.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (std::size_t i = 0; i < common.ids.size(); ++i)
    sum += cv::norm(common.left[i] - common.right[i]);
  return sum / static_cast<double>(common.ids.size());
}

/// How far the board has moved in the image in which it moved more [px].
double shift_px(const View& a, const View& b) {
  return std::max(mean_distance_px(a.left, b.left), mean_distance_px(a.right, b.right));
}

Reason stands_as_in(const View& taken) {
  return {"the board stands where it stood", "stands where it stood in " + taken.name};
}

/// Both about their own middle.
void centre(CommonPoints& common) {
  for (std::vector<cv::Point2f>* points : {&common.left, &common.right}) {
    const cv::Scalar middle = cv::mean(*points);
    for (cv::Point2f& point : *points)
      point -= cv::Point2f(static_cast<float>(middle[0]), static_cast<float>(middle[1]));
  }
}

/// How far the points of `b` stand from those of `a` where the board's place does not count, as a
/// share of the board's size (RMS distance from its middle).
double shape_change(const BoardPoints& a, const BoardPoints& b) {
  CommonPoints common = common_points(a, b);
  if (common.ids.empty()) return std::numeric_limits<double>::infinity();
  centre(common);
  double differences = 0.0;
  double sizes = 0.0;
  for (std::size_t i = 0; i < common.ids.size(); ++i) {
    const cv::Point2f difference = common.right[i] - common.left[i];
    differences += difference.dot(difference);
    sizes += common.left[i].dot(common.left[i]);
  }
  return std::sqrt(differences / sizes);
}

Reason not_found_in(const char* side) {
  const std::string text = formatted("board not found in the %s image", side);
  return {text, text};
}

}  // namespace

CommonPoints common_points(const BoardPoints& left, const BoardPoints& right) {
  CommonPoints common;
  for (std::size_t l = 0, r = 0; l < left.ids.size() && r < right.ids.size();) {
    if (left.ids[l] == right.ids[r]) {
      common.ids.push_back(left.ids[l]);
      common.left.push_back(left.pixels[l++]);
      common.right.push_back(right.pixels[r++]);
    } else if (left.ids[l] < right.ids[r]) {
      ++l;
    } else {
      ++r;
    }
  }
  return common;
}

bool ViewCollector::add(const GreyPair& pair) {
  check_size(pair);
  seen_areas_.add(pair.left, pair.right);
  // Finding the points exactly takes some tenths of a second, too long for each frame of a camera.
  Reason reason = in_sequence_ ? why_wait(pair) : Reason{};
  std::optional<View> view;
  if (reason.text.empty()) reason = find_view(pair, view);
  if (reason.text.empty() && !in_sequence_) reason = why_no_new_shot(*view);
  if (!reason.text.empty()) {
    rejected_.push_back({pair.name, reason});
    return false;
  }
  views_.push_back(*view);
  if (in_sequence_) taken_glimpses_.push_back(previous_->view);
  return true;
}

void ViewCollector::check_size(const GreyPair& pair) {
  if (image_size_.empty()) image_size_ = pair.left.size();
  for (const cv::Mat* image : {&pair.left, &pair.right}) {
    if (image->size() == image_size_) continue;
    throw InputError(pair.name + ": an image is " + size_text(image->size()) + ", the first one " +
                     size_text(image_size_) + "; take all with the same cameras and settings");
  }
}

/// Why a frame of a video is not worth a closer look, empty where it is.
Reason ViewCollector::why_wait(const GreyPair& pair) {
  std::optional<BoardPoints> left = glimpse_board(pair.left, board_);
  std::optional<BoardPoints> right = left ? glimpse_board(pair.right, board_) : std::nullopt;
  if (!right) {
    previous_.reset();
    return not_found_in(left ? "right" : "left");
  }
  align_numbering(board_, *left, *right);
  Glimpse glimpse{{pair.name, std::move(*left), std::move(*right)}, pair.utime};
  Reason reason = why_not_here(glimpse);
  previous_ = std::move(glimpse);
  return reason;
}

Reason ViewCollector::why_not_here(const Glimpse& glimpse) const {
  constexpr const char* kIsNew = "the board has just come into view";
  if (!previous_) return {kIsNew, kIsNew};
  const double seconds = kMicroseconds_s * static_cast<double>(glimpse.utime - previous_->utime);
  const double motion_px = shift_px(glimpse.view, previous_->view);
  if (motion_px > params_.max_speed_px_s * seconds)
    return {kBoardMoves, formatted("moved by %.1f px in %.2f s (limit %.0f px/s)", motion_px,
                                   seconds, params_.max_speed_px_s)};
  for (const View& taken : taken_glimpses_) {
    if (mean_distance_px(glimpse.view.left, taken.left) < params_.min_shift * image_size_.width &&
        shape_change(taken.left, glimpse.view.left) < params_.min_shape_change)
      return stands_as_in(taken);
  }
  return {};
}

Reason ViewCollector::why_no_new_shot(const View& view) const {
  for (const View& taken : views_) {
    if (shift_px(view, taken) < params_.min_shot_shift_px) return stands_as_in(taken);
  }
  return {};
}

/// Why there is no view, empty where there is one.
Reason ViewCollector::find_view(const GreyPair& pair, std::optional<View>& view) const {
  std::optional<BoardPoints> left = find_board(pair.left, board_);
  if (!left) return not_found_in("left");
  std::optional<BoardPoints> right = find_board(pair.right, board_);
  if (!right) return not_found_in("right");
  align_numbering(board_, *left, *right);
  view = View{pair.name, std::move(*left), std::move(*right)};
  for (const auto& [image, points, side] : {std::tuple(&pair.left, &view->left, "left"),
                                            std::tuple(&pair.right, &view->right, "right")}) {
    const std::optional<EdgeWidth> edge = widest_edge(*image, board_, *points, params_.sharpness);
    if (edge && edge->width_px > edge->limit_px)
      return {"blurred", formatted("blurred: edges in the %s image are %.1f px wide (limit %.1f): "
                                   "motion or focus",
                                   side, edge->width_px, edge->limit_px)};
  }
  const auto num_common = static_cast<int>(common_points(view->left, view->right).ids.size());
  if (num_common < params_.min_points)
    return {"too few points in both images",
            formatted("both images show %d points of the board, %d are needed", num_common,
                      params_.min_points)};
  return {};
}

}  // namespace limbcast::calibrate
