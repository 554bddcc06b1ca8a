#include "modules/segmenter/scene/surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace limbcast::segmenter {
namespace {

constexpr std::int32_t kNone = -1, kUnseen = -2;

/// Everything that may lie on a surface is marked unseen, the rest none.
std::vector<std::int32_t> mark_points(const Lattice& lattice, float ground_cut_m,
                                      const std::vector<std::int16_t>* taken) {
  std::vector<std::int32_t> marks(lattice.size(), kNone);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const bool ground = lattice.frame.ground_known && lattice.level_m[i].z() < ground_cut_m;
    const bool free = taken == nullptr || (*taken)[i] == kNobody;
    if (lattice.depth_m[i] > 0.0F && !ground && free) marks[i] = kUnseen;
  }
  return marks;
}

/// Walks over one surface after the other.
class Walker {
 public:
  Walker(const Lattice& lattice, const SurfaceParams& params, Surfaces& surfaces)
      : lattice_(lattice), params_(params), surfaces_(surfaces) {}

  Surface walk(std::uint32_t start, std::int32_t name) {
    Surface surface;
    Eigen::AlignedBox3f box;
    points_ = {start};
    surfaces_.of_point[start] = name;
    std::size_t next = 0;
    while (next < points_.size()) {
      const std::uint32_t i = points_[next++];
      const float side_m = lattice_.depth_m[i] / lattice_.focal_px;
      surface.area_m2 += side_m * side_m;
      box.extend(lattice_.level_m[i]);
      take_neighbors(i, name);
    }
    surface.extent_m = box.sizes().head<2>().maxCoeff();
    return surface;
  }

 private:
  void take_neighbors(std::uint32_t i, std::int32_t name) {
    const float step_m = params_.longest_step_m(lattice_.depth_m[i]);
    const int u = static_cast<int>(i) % lattice_.width, v = static_cast<int>(i) / lattice_.width;
    for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const auto n = lattice_.find(u + du, v + dv);
      if (!n || surfaces_.of_point[*n] != kUnseen) continue;
      if ((lattice_.level_m[*n] - lattice_.level_m[i]).squaredNorm() > step_m * step_m) continue;
      surfaces_.of_point[*n] = name;
      points_.push_back(*n);
    }
  }

  const Lattice& lattice_;
  const SurfaceParams& params_;
  Surfaces& surfaces_;
  std::vector<std::uint32_t> points_;
};

}  // namespace

Surfaces find_surfaces(const Lattice& lattice, const SurfaceParams& params,
                       const std::vector<std::int16_t>* taken) {
  Surfaces surfaces{mark_points(lattice, params.ground_cut_m, taken), {}};
  Walker walker(lattice, params, surfaces);
  for (std::uint32_t i = 0; i < lattice.size(); ++i) {
    if (surfaces.of_point[i] != kUnseen) continue;
    surfaces.all.push_back(walker.walk(i, static_cast<std::int32_t>(surfaces.all.size())));
  }
  return surfaces;
}

std::vector<std::vector<std::uint32_t>> points_by_surface(const Surfaces& surfaces) {
  return points_by_label(surfaces.of_point, surfaces.all.size());
}

}  // namespace limbcast::segmenter
