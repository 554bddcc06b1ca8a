#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace limbcast::pose_fitter {

struct ClusterParams {
  double voxel_m, inward_m, reach_m, dense_points;
};

/// Number of points near a link.
struct LinkDensity {
  float mean = 0.0F, min = 0.0F;
};

/// The points of one segment, thinned, moved into the body and laid out for the two questions of
/// findBestFit: which points are near a place, and how many are near a link.
class Cluster {
 public:
  /// Points that are not finite, out of reach or at the sensor itself are left out.
  Cluster(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Vector3f& seed_m,
          const ClusterParams& params);

  int size() const { return static_cast<int>(points_.size()); }
  const Eigen::Vector3f& point(int index) const { return points_[index]; }

  /// Calls visit(index) for every point no farther than `radius_m`, in the order of indices within
  /// a row of cells.
  template <class Visit>
  void visit_near(const Eigen::Vector3f& center, float radius_m, Visit visit) const;

  /// Points near the line from `start` to `end`: within a box of 12 cm around places 4 cm apart,
  /// each counted up to dense_points.
  LinkDensity density(const Eigen::Vector3f& start, const Eigen::Vector3f& end) const;

  /// One bit for each point that lies within `radius_m` of the line from `start` to `end`.
  void mark_near_line(const Eigen::Vector3f& start, const Eigen::Vector3f& end, float radius_m,
                      std::vector<std::uint64_t>& bits) const;

 private:
  void thin(const std::vector<Eigen::Vector3f>& points_m, const Eigen::Vector3f& seed_m,
            const ClusterParams& params);
  void build_search_cells();
  void build_density(double dense_points);
  int search_cell(const Eigen::Vector3i& cell) const {
    return (cell.z() * search_size_.y() + cell.y()) * search_size_.x() + cell.x();
  }
  Eigen::Vector3i search_place(const Eigen::Vector3f& point) const;

  std::vector<Eigen::Vector3f> points_;  ///< sorted by search cell
  Eigen::Vector3f lowest_ = Eigen::Vector3f::Zero(), highest_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i search_size_ = Eigen::Vector3i::Zero();
  std::vector<int> search_begin_;  ///< first point of each cell, one more at the end
  Eigen::Vector3f density_lowest_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i density_size_ = Eigen::Vector3i::Zero();
  std::vector<std::uint8_t> density_;
};

/// Edge of the cells of the search [m]; an implementation's number, no result depends on it.
inline constexpr float kSearchCellM = 0.08F;

template <class Visit>
void Cluster::visit_near(const Eigen::Vector3f& center, float radius_m, Visit visit) const {
  if (points_.empty()) return;
  const Eigen::Vector3f reach = Eigen::Vector3f::Constant(radius_m);
  if (((center + reach).array() < lowest_.array()).any() ||
      ((center - reach).array() > highest_.array()).any()) {
    return;
  }
  const Eigen::Vector3i from = search_place(center - reach), to = search_place(center + reach);
  const float limit = radius_m * radius_m;
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      // Cells of a row follow one another, and so do their points.
      const int begin = search_begin_[search_cell({from.x(), y, z})];
      const int end = search_begin_[search_cell({to.x(), y, z}) + 1];
      for (int i = begin; i < end; ++i) {
        if ((points_[i] - center).squaredNorm() <= limit) visit(i);
      }
    }
  }
}

}  // namespace limbcast::pose_fitter
