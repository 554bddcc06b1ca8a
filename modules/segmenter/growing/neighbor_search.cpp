#include "modules/segmenter/growing/neighbor_search.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <numeric>
#include <utility>

namespace limbcast::segmenter {
namespace {

bool is_point(const Cloud& cloud, std::size_t index) {
  return !cloud.is_hole(index) && cloud.points_m[index].allFinite();
}

float squared_distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  // Written out, so that both searches round alike and agree on points at the very limit.
  const float x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
  return x * x + y * y + z * z;
}

/// The cloud's points as nanoflann wants to see them.
struct PointsOfCloud {
  const Cloud& cloud;
  std::vector<std::uint32_t> indices;  ///< without holes

  std::size_t kdtree_get_point_count() const { return indices.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return cloud.points_m[indices[i]][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};

class KdTreeSearch : public NeighborSearch {
 public:
  explicit KdTreeSearch(const Cloud& cloud)
      : points_(make_points(cloud)), tree_(3, points_), named_(cloud.points_m.size(), 0) {}

  void reset() override { std::fill(named_.begin(), named_.end(), std::uint8_t{0}); }
  void name(std::uint32_t index) override { named_[index] = 1; }
  void take_neighbors(std::uint32_t index, float radius_m,
                      std::vector<std::uint32_t>& neighbors) override {
    const Eigen::Vector3f& center = points_.cloud.points_m[index];
    const float limit = radius_m * radius_m;
    found_.clear();
    // A little wider, then decided as the lattice decides: the tree leaves out the limit itself.
    tree_.radiusSearch(center.data(), limit * 1.001F, found_,
                       nanoflann::SearchParams(32, 0.0F, false));
    const auto first = static_cast<std::ptrdiff_t>(neighbors.size());
    for (const auto& [i, unused] : found_) {
      const std::uint32_t neighbor = points_.indices[i];
      if (named_[neighbor] != 0 ||
          squared_distance(points_.cloud.points_m[neighbor], center) > limit)
        continue;
      named_[neighbor] = 1;
      neighbors.push_back(neighbor);
    }
    std::sort(neighbors.begin() + first, neighbors.end());
  }

 private:
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointsOfCloud>,
                                          PointsOfCloud, 3, std::uint32_t>;
  static PointsOfCloud make_points(const Cloud& cloud) {
    PointsOfCloud points{cloud, {}};
    for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
      if (is_point(cloud, i)) points.indices.push_back(static_cast<std::uint32_t>(i));
    }
    return points;
  }

  PointsOfCloud points_;
  Tree tree_;
  std::vector<std::uint8_t> named_;
  std::vector<std::pair<std::uint32_t, float>> found_;
};

class LatticeSearch : public NeighborSearch {
 public:
  explicit LatticeSearch(const Cloud& cloud) : cloud_(cloud), next_(cloud.points_m.size() + 1) {
    reset();
  }

  void reset() override {
    std::iota(next_.begin(), next_.end(), 0U);
    for (std::uint32_t i = 0; i < cloud_.points_m.size(); ++i) {
      if (!is_point(cloud_, i)) next_[i] = i + 1;
    }
  }
  void name(std::uint32_t index) override { next_[index] = index + 1; }
  void take_neighbors(std::uint32_t index, float radius_m,
                      std::vector<std::uint32_t>& neighbors) override {
    const Eigen::Vector3f& center = cloud_.points_m[index];
    const int u = static_cast<int>(index) % cloud_.width,
              v = static_cast<int>(index) / cloud_.width;
    const int half_u =
        half_window(center.x(), center.z(), radius_m, cloud_.camera->fx, cloud_.width);
    const int half_v =
        half_window(center.y(), center.z(), radius_m, cloud_.camera->fy, cloud_.height);
    const int left = std::max(0, u - half_u), right = std::min(cloud_.width - 1, u + half_u);
    for (int row = std::max(0, v - half_v); row <= std::min(cloud_.height - 1, v + half_v); ++row) {
      const auto start = static_cast<std::uint32_t>(row * cloud_.width);
      const std::uint32_t end = start + static_cast<std::uint32_t>(right);
      for (std::uint32_t i = unnamed_from(start + static_cast<std::uint32_t>(left)); i <= end;
           i = unnamed_from(i + 1)) {
        if (squared_distance(cloud_.points_m[i], center) > radius_m * radius_m) continue;
        next_[i] = i + 1;
        neighbors.push_back(i);
      }
    }
  }

 private:
  /// Pixels that a ball of `radius_m` around (x, z) can reach along one image axis: |q_x/q_z - x/z|
  /// <= radius * |(x, z)| / (z * (z - radius)), by Cauchy-Schwarz; and one for rounding.
  static int half_window(float x_m, float z_m, float radius_m, double focal_px, int size) {
    if (z_m <= radius_m * 1.01F) return size;
    const double tangent =
        radius_m * std::hypot(x_m, z_m) / (static_cast<double>(z_m) * (z_m - radius_m));
    return std::min(size, static_cast<int>(std::ceil(focal_px * tangent)) + 1);
  }
  /// First point at or after `index` that nobody named; its way there is shortened for the next
  /// time.
  std::uint32_t unnamed_from(std::uint32_t index) {
    std::uint32_t end = index;
    while (next_[end] != end) end = next_[end];
    while (next_[index] != end) index = std::exchange(next_[index], end);
    return end;
  }

  const Cloud& cloud_;
  std::vector<std::uint32_t> next_;  ///< itself for a point that nobody named, else one further on
};

}  // namespace

std::unique_ptr<NeighborSearch> make_kd_tree_search(const Cloud& cloud) {
  return std::make_unique<KdTreeSearch>(cloud);
}

std::unique_ptr<NeighborSearch> make_lattice_search(const Cloud& cloud) {
  return std::make_unique<LatticeSearch>(cloud);
}

}  // namespace limbcast::segmenter
