#include "modules/segmenter/bodies/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "modules/segmenter/scene/lattice_box.hpp"

namespace limbcast::segmenter {
namespace {

/// Whether the surface bends or makes a step near a point: the rim of an arm before a sofa. A flat
/// surface has none, however steep it is seen.
bool is_edge(const Lattice& lattice, int u, int v, float max_bend_m) {
  const float depth_m = lattice.depth_m[lattice.index(u, v)];
  for (const auto& [du, dv] : {std::pair{2, 0}, {0, 2}}) {
    const auto before = lattice.find(u - du, v - dv), after = lattice.find(u + du, v + dv);
    if (!before || !after) continue;
    const float bend_m = lattice.depth_m[*before] + lattice.depth_m[*after] - 2.0F * depth_m;
    if (std::abs(bend_m) > max_bend_m) return true;
  }
  return false;
}

/// Pixels of the lattice that a length takes at a point's distance.
float to_px(const Lattice& lattice, std::size_t i, float length_m) {
  return length_m * lattice.focal_px / lattice.depth_m[i];
}

/// 255 where a disc of the params' radius fits into the smooth surface of the cluster.
cv::Mat1b wide_parts(const Lattice& lattice, const std::vector<std::int16_t>& labels,
                     std::int16_t label, const cv::Rect& box, const FurnitureParams& params) {
  // A border of zeros: what lies outside the box is not the cluster's.
  cv::Mat1b smooth(box.height + 2, box.width + 2, uchar{0});
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      const std::size_t i = lattice.index(box.x + u, box.y + v);
      const float max_bend_m = std::max(
          params.min_bend_m, params.bend_sigmas * lattice.depth_noise.sigma_m(lattice.depth_m[i]));
      if (labels[i] == label && !is_edge(lattice, box.x + u, box.y + v, max_bend_m))
        smooth(v + 1, u + 1) = 255;
    }
  }
  cv::Mat1f to_rim, to_core;
  cv::distanceTransform(smooth, to_rim, cv::DIST_L2, 3);
  cv::Mat1b not_core(smooth.size(), uchar{255}), wide(box.size(), uchar{0});
  const auto radius_px = [&](int u, int v) {
    return to_px(lattice, lattice.index(box.x + u, box.y + v), params.limb_radius_m);
  };
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      if (smooth(v + 1, u + 1) != 0 && to_rim(v + 1, u + 1) >= radius_px(u, v))
        not_core(v + 1, u + 1) = 0;
    }
  }
  cv::distanceTransform(not_core, to_core, cv::DIST_L2, 3);
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      if (smooth(v + 1, u + 1) != 0 && to_core(v + 1, u + 1) <= radius_px(u, v)) wide(v, u) = 255;
    }
  }
  return wide;
}

/// Whether the trunk or the head may be at a place, told from the head's centre.
bool may_be_trunk(const Eigen::Vector3f& from_head_m, const FurnitureParams& params) {
  if (from_head_m.z() > -params.neck_m) return from_head_m.norm() <= params.head_radius_m;
  return std::abs(from_head_m.x()) <= params.trunk_radius_m &&
         from_head_m.y() <= params.trunk_depth_m;
}

}  // namespace

std::vector<std::uint32_t> find_furniture(const Lattice& lattice, const HeadCandidate& head,
                                          const std::vector<std::int16_t>& labels,
                                          const std::vector<std::uint32_t>& points,
                                          const FurnitureParams& params) {
  std::vector<std::uint32_t> furniture;
  if (points.empty()) return furniture;
  const cv::Rect box = box_around(lattice, points);
  const std::int16_t label = labels[points.front()];
  const cv::Mat1b wide = wide_parts(lattice, labels, label, box, params);
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      if (wide(v, u) == 0) continue;
      const std::size_t i = lattice.index(box.x + u, box.y + v);
      if (!may_be_trunk(from_head(lattice, head, lattice.level_m[i]), params))
        furniture.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return furniture;
}

void leave_furniture(const Lattice& lattice, const FurnitureParams& params, JointGrowth& growth) {
  std::vector<std::uint32_t> furniture;
  const auto clusters = points_by_label(growth.labels(), growth.heads().size());
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const auto part =
        find_furniture(lattice, growth.heads()[k], growth.labels(), clusters[k], params);
    furniture.insert(furniture.end(), part.begin(), part.end());
  }
  if (!furniture.empty()) growth.grow_without(furniture);
}

}  // namespace limbcast::segmenter
