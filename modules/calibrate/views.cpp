#include "modules/calibrate/views.hpp"

#include <algorithm>
#include <limits>

#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast::calibrate {
namespace {

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
  std::optional<View> view;
  std::string reason = find_view(pair, view);
  if (view && reason.empty()) reason = why_not(*view);
  previous_ = view;
  if (reason.empty()) {
    views_.push_back(*view);
  } else {
    rejected_.push_back({pair.name, reason});
  }
  return reason.empty();
}

void ViewCollector::check_size(const GreyPair& pair) {
  if (image_size_.empty()) image_size_ = pair.left.size();
  for (const cv::Mat* image : {&pair.left, &pair.right}) {
    if (image->size() == image_size_) continue;
    throw InputError(pair.name + ": an image is " + size_text(image->size()) + ", the first one " +
                     size_text(image_size_) + "; take all with the same cameras and settings");
  }
}

/// Why there is no view, empty where there is one.
std::string ViewCollector::find_view(const GreyPair& pair, std::optional<View>& view) {
  std::optional<BoardPoints> left = find_board(pair.left, board_);
  if (!left) return "board not found in the left image";
  std::optional<BoardPoints> right = find_board(pair.right, board_);
  if (!right) return "board not found in the right image";
  align_numbering(board_, *left, *right);
  view = View{pair.name, std::move(*left), std::move(*right)};
  for (const auto& [image, points, side] : {std::tuple(&pair.left, &view->left, "left"),
                                            std::tuple(&pair.right, &view->right, "right")}) {
    const std::optional<double> width_px = edge_width_px(*image, board_, *points);
    if (width_px && *width_px > params_.max_edge_width_px)
      return formatted(
          "blurred: edges in the %s image are %.1f px wide (limit %.1f): motion or focus", side,
          *width_px, params_.max_edge_width_px);
  }
  return "";
}

std::string ViewCollector::why_not(const View& view) const {
  const auto num_common = static_cast<int>(common_points(view.left, view.right).ids.size());
  if (num_common < params_.min_points)
    return formatted("both images show %d points of the board, %d are needed", num_common,
                     params_.min_points);
  if (!in_sequence_) return "";
  if (!previous_) return "the board has just come into view";
  const double motion_px = std::max(mean_distance_px(view.left, previous_->left),
                                    mean_distance_px(view.right, previous_->right));
  if (motion_px > params_.max_motion_px)
    return formatted("moved by %.1f px since the frame before (limit %.1f)", motion_px,
                     params_.max_motion_px);
  for (const View& other : views_) {
    if (mean_distance_px(view.left, other.left) < params_.min_change * image_size_.width)
      return "stands where it stood in " + other.name;
  }
  return "";
}

}  // namespace limbcast::calibrate
