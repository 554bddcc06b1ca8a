#include "modules/reconstructor/silhouettes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <vector>

#include "common/simd.hpp"
#include "modules/reconstructor/marks.hpp"

namespace limbcast::reconstructor {
namespace {

/// Three pixels along the outline are taken together, against noise.
constexpr int kAcross = 3;
using ThreeRows = std::array<const std::uint8_t*, kAcross>;

LIMBCAST_SIMD void add_differences(const ThreeRows& before, const ThreeRows& after, int count,
                                   std::uint16_t* __restrict sums) {
  const auto [b0, b1, b2] = before;
  const auto [a0, a1, a2] = after;
  for (int i = 0; i < count; ++i)
    sums[i] = static_cast<std::uint16_t>(
        sums[i] + std::abs((a0[i] + a1[i] + a2[i]) - (b0[i] + b1[i] + b2[i])));
}

LIMBCAST_SIMD void mark_steps(const float* __restrict here, const float* __restrict outside,
                              float min_step_px, int count, std::uint8_t* __restrict is_step) {
  for (int i = 0; i < count; ++i) is_step[i] = here[i] - outside[i] >= min_step_px ? 1 : 0;
}

/// Change of brightness from the pixel before to the one after, in a row (`along` = (1, 0)) or in a
/// column, summed over the channels and three pixels across; 0 at the image's border.
cv::Mat1w edges_along(const std::vector<cv::Mat1b>& channels, cv::Point along) {
  cv::Mat1w edges(channels[0].size(), std::uint16_t{0});
  const cv::Point across(along.y, along.x);
  for (int v = 1; v + 1 < edges.rows; ++v) {
    for (const cv::Mat1b& channel : channels) {
      ThreeRows before{}, after{};
      for (int i = 0; i < kAcross; ++i) {
        const cv::Point middle = cv::Point(1, v) + (i - 1) * across;
        before[i] = channel.ptr(middle.y - along.y) + middle.x - along.x;
        after[i] = channel.ptr(middle.y + along.y) + middle.x + along.x;
      }
      add_differences(before, after, edges.cols - 2, edges[v] + 1);
    }
  }
  return edges;
}

/// Looks along rows, or columns, for seams that end at an edge of the image.
class SeamFinder {
 public:
  SeamFinder(const std::vector<cv::Mat1b>& channels, cv::Point along, const cv::Mat1f& disparity_px,
             const SilhouetteParams& params)
      : channels_(channels),
        edges_(edges_along(channels, along)),
        disparity_px_(disparity_px),
        params_(params),
        edge_unit_(static_cast<float>(kAcross * channels.size())) {}

  /// Of things that begin in the direction `inwards`, (1, 0) for instance at their left outline.
  void mark(cv::Point inwards, cv::Mat1b& is_seam) const {
    const int first_row = std::max(inwards.y, 0), end_row = edges_.rows + std::min(inwards.y, 0);
    const int first = std::max(inwards.x, 0), end = edges_.cols + std::min(inwards.x, 0);
    std::vector<std::uint8_t> is_step(edges_.cols, 0);
    for (int v = first_row; v < end_row; ++v) {
      mark_steps(disparity_px_[v] + first, disparity_px_[v - inwards.y] + first - inwards.x,
                 params_.min_step_px, end - first, &is_step[first]);
      for (int u = find_mark(is_step, first); u < end; u = find_mark(is_step, u + 1))
        mark_seam({u, v}, inwards, is_seam);
    }
  }

 private:
  bool is_in_image(cv::Point pixel) const {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < edges_.cols && pixel.y < edges_.rows;
  }

  void mark_seam(cv::Point outermost, cv::Point inwards, cv::Mat1b& is_seam) const {
    const int width = seam_width(outermost, inwards);
    if (width == 0 || !is_outline(outermost, inwards) ||
        !has_color_of_outside(outermost, inwards, width))
      return;
    for (int i = 0; i < width; ++i) is_seam(outermost + i * inwards) = 255;
  }

  /// Whether what lies outside is farther, or not seen at all.
  bool is_outline(cv::Point outermost, cv::Point inwards) const {
    cv::Point outside = outermost - inwards;
    for (int i = 0; i < params_.max_hole_px && is_in_image(outside); ++i, outside -= inwards)
      if (const float disparity_px = disparity_px_(outside); disparity_px > 0.0F)
        return disparity_px_(outermost) - disparity_px >= params_.min_step_px;
    return is_in_image(outside);
  }

  /// How far inwards of the outermost pixel the image's edge lies [px]; 0 where there is none.
  int seam_width(cv::Point outermost, cv::Point inwards) const {
    const int reach = reach_of_surface(outermost, inwards);
    const auto edge = [&](int i) { return edges_(outermost + i * inwards); };
    std::uint16_t strongest = 0;
    for (int i = -1; i < reach; ++i) strongest = std::max(strongest, edge(i));
    const float least = std::max(params_.min_edge * edge_unit_,
                                 params_.min_edge_share * static_cast<float>(strongest));
    int i = -1;  // the edge may lie just outside: then there is no seam
    while (i < reach && edge(i) < least) ++i;
    if (i == reach) return 0;
    while (i + 1 < reach && edge(i + 1) > edge(i)) ++i;  // on to the middle of a blurred edge
    return std::max(i, 0);
  }

  /// How many pixels inwards, at most a seam's width, are of the outermost one's surface.
  int reach_of_surface(cv::Point outermost, cv::Point inwards) const {
    constexpr float kSlopePx = 2.0F;  // more than a surface turns over the width of a seam
    int reach = 0;
    for (cv::Point pixel = outermost;
         reach < params_.max_seam_px && is_in_image(pixel) && disparity_px_(pixel) > 0.0F &&
         std::abs(disparity_px_(pixel) - disparity_px_(outermost)) <= kSlopePx;
         pixel += inwards)
      ++reach;
    return reach;
  }

  bool has_color_of_outside(cv::Point outermost, cv::Point inwards, int width) const {
    constexpr int kSample = 3, kClear = 2;  // [px]; clear of the edge's blur
    const cv::Point outside = outermost - (kSample + kClear) * inwards;
    const cv::Point inside = outermost + (width + 1) * inwards;
    float to_outside = 0.0F, to_inside = 0.0F;
    for (const cv::Mat1b& channel : channels_) {
      const float seam = mean_brightness(channel, outermost, inwards, width);
      to_outside += std::abs(seam - mean_brightness(channel, outside, inwards, kSample));
      to_inside += std::abs(seam - mean_brightness(channel, inside, inwards, kSample));
    }
    return to_outside <= params_.max_color_ratio * to_inside;
  }
  float mean_brightness(const cv::Mat1b& channel, cv::Point first, cv::Point inwards,
                        int count) const {
    const cv::Point across(inwards.y, inwards.x);
    int sum = 0;
    for (int i = 0; i < count; ++i) {
      cv::Point middle = first + i * inwards;
      middle.x = std::clamp(middle.x, 1, edges_.cols - 2);
      middle.y = std::clamp(middle.y, 1, edges_.rows - 2);
      sum += channel(middle - across) + channel(middle) + channel(middle + across);
    }
    return static_cast<float>(sum) / static_cast<float>(kAcross * count);
  }

  const std::vector<cv::Mat1b>& channels_;
  cv::Mat1w edges_;
  const cv::Mat1f& disparity_px_;
  const SilhouetteParams& params_;
  float edge_unit_;  ///< what an edge of one grey level in all channels sums up to
};

}  // namespace

void trim_silhouettes(const cv::Mat& image, const SilhouetteParams& params,
                      cv::Mat1f& disparity_px) {
  if (image.cols < kAcross || image.rows < kAcross) return;
  std::vector<cv::Mat1b> channels;
  cv::split(image, channels);
  cv::Mat1b is_seam(disparity_px.size(), uchar{0});
  for (const cv::Point along : {cv::Point(1, 0), cv::Point(0, 1)}) {
    const SeamFinder finder(channels, along, disparity_px, params);
    finder.mark(along, is_seam);
    finder.mark(-along, is_seam);
  }
  disparity_px.setTo(0.0F, is_seam);
}

}  // namespace limbcast::reconstructor
