#include "modules/reconstructor/near_look.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/core/fast_math.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "modules/reconstructor/colors.hpp"
#include "modules/reconstructor/semi_global.hpp"

namespace limbcast::reconstructor {
namespace {

/// A pair, as small as near surfaces can be seen in it.
struct SmallPair {
  cv::Mat1b left, right;

  cv::Mat1f match(int num_disparities) const {
    SemiGlobalParams params;
    params.num_disparities = num_disparities;
    return match_semi_global(left, right, params);
  }
  /// Difference of brightness of what a disparity takes for the same point.
  int misfit(int u, int v, float disparity_px) const {
    return std::abs(left(v, u) - right(v, std::max(0, u - cvRound(disparity_px))));
  }
};

/// What a group of near pixels would leave unexplained, and what the best that is not near leaves.
struct Group {
  int pixels = 0;
  double near_misfit = 0.0, usual_misfit = 0.0;
  float nearest_px = 0.0F;

  bool is_surface(const NearLookParams& params) const {
    return pixels >= params.min_pixels && near_misfit <= params.max_misfit * usual_misfit;
  }
};

std::vector<Group> measure_groups(const SmallPair& pair, const cv::Mat1f& disparity_px,
                                  const cv::Mat1f& usual_px, float min_near_px) {
  cv::Mat1i names;
  std::vector<Group> groups(static_cast<std::size_t>(
      cv::connectedComponents(disparity_px >= min_near_px, names, 4, CV_32S)));
  for (int v = 0; v < names.rows; ++v) {
    for (int u = 0; u < names.cols; ++u) {
      if (names(v, u) == 0) continue;
      Group& group = groups[static_cast<std::size_t>(names(v, u))];
      ++group.pixels;
      group.nearest_px = std::max(group.nearest_px, disparity_px(v, u));
      // Where nothing usual matches there is nothing to compare.
      if (usual_px(v, u) <= 0.0F) continue;
      group.near_misfit += pair.misfit(u, v, disparity_px(v, u));
      group.usual_misfit += pair.misfit(u, v, usual_px(v, u));
    }
  }
  return groups;
}

}  // namespace

int find_num_disparities(const RectifiedPair& pair, int usual, int most,
                         const NearLookParams& params) {
  const int by = pair.left.cols / params.width_px;
  if (most <= usual || by < 1 || usual / by < 2) return most;
  const SmallPair small{shrunk(pair.left, by), shrunk(pair.right, by)};
  const cv::Mat1f disparity_px = small.match(most / by + 1);
  const float min_near_px = static_cast<float>(usual - 1) / static_cast<float>(by);
  if (cv::countNonZero(disparity_px >= min_near_px) < params.min_pixels) return usual;
  const cv::Mat1f usual_px = small.match(usual / by - 1);
  float nearest_px = 0.0F;
  for (const Group& group : measure_groups(small, disparity_px, usual_px, min_near_px)) {
    if (group.is_surface(params)) nearest_px = std::max(nearest_px, group.nearest_px);
  }
  if (nearest_px <= 0.0F) return usual;
  // A pixel of the small images is so many of the pair's.
  return std::clamp(cvCeil((nearest_px + 1.0F) * static_cast<float>(by)) + 1, usual, most);
}

}  // namespace limbcast::reconstructor
