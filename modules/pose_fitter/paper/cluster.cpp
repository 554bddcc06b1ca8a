#include "modules/pose_fitter/paper/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr float kDensityCellM = 0.04F;

struct Voxel {
  std::uint64_t key = 0;
  Vector3f sum = Vector3f::Zero();
  int count = 0;
};

/// Sums of the points in each cube, in the order in which cubes were first met.
class VoxelGrid {
 public:
  VoxelGrid(const Vector3f& center, float edge_m, std::size_t points)
      : center_(center), per_edge_(1.0F / edge_m) {
    std::size_t size = 256;
    while (size < points) size *= 2;
    slots_.assign(size, -1);
  }

  void add(const Vector3f& point) {
    const Vector3i cell = ((point - center_) * per_edge_).array().floor().cast<int>();
    const std::uint64_t key = (static_cast<std::uint64_t>(cell.x() + kHalf) << 40U) |
                              (static_cast<std::uint64_t>(cell.y() + kHalf) << 20U) |
                              static_cast<std::uint64_t>(cell.z() + kHalf);
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL >> 20U) & (slots_.size() - 1);
    while (slots_[slot] >= 0 && voxels_[slots_[slot]].key != key) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    if (slots_[slot] < 0) {
      // One slot a point is always enough, as there are no more cubes than points.
      slots_[slot] = static_cast<int>(voxels_.size());
      voxels_.push_back({key, Vector3f::Zero(), 0});
    }
    Voxel& voxel = voxels_[slots_[slot]];
    voxel.sum += point;
    ++voxel.count;
  }

  const std::vector<Voxel>& voxels() const { return voxels_; }

 private:
  static constexpr int kHalf = 1 << 18;
  Vector3f center_;
  float per_edge_;
  std::vector<int> slots_;
  std::vector<Voxel> voxels_;
};

}  // namespace

Cluster::Cluster(const std::vector<Vector3f>& points_m, const Vector3f& seed_m,
                 const ClusterParams& params) {
  thin(points_m, seed_m, params);
  if (points_.empty()) return;
  build_search_cells();
  build_density(params.dense_points);
}

void Cluster::thin(const std::vector<Vector3f>& points_m, const Vector3f& seed_m,
                   const ClusterParams& params) {
  const auto reach = static_cast<float>(params.reach_m * params.reach_m);
  VoxelGrid grid(seed_m, static_cast<float>(params.voxel_m), 2 * points_m.size());
  for (const Vector3f& point : points_m) {
    // Also false for NaN.
    if ((point - seed_m).squaredNorm() <= reach) grid.add(point);
  }
  points_.reserve(grid.voxels().size());
  for (const Voxel& voxel : grid.voxels()) {
    const Vector3f mean = voxel.sum / static_cast<float>(voxel.count);
    const float distance = mean.norm();
    if (distance < 1e-3F) continue;  // no ray to move it along
    points_.push_back(mean * (1.0F + static_cast<float>(params.inward_m) / distance));
  }
}

Vector3i Cluster::search_place(const Vector3f& point) const {
  const Vector3f cell = (point - lowest_) / kSearchCellM;
  const Vector3f last = (search_size_ - Vector3i::Ones()).cast<float>();
  return cell.cwiseMax(0.0F).cwiseMin(last).cast<int>();
}

void Cluster::build_search_cells() {
  lowest_ = highest_ = points_.front();
  for (const Vector3f& point : points_) {
    lowest_ = lowest_.cwiseMin(point);
    highest_ = highest_.cwiseMax(point);
  }
  search_size_ = ((highest_ - lowest_) / kSearchCellM).cast<int>() + Vector3i::Ones();
  search_begin_.assign(search_size_.prod() + 1, 0);
  std::vector<int> cells;
  cells.reserve(points_.size());
  for (const Vector3f& point : points_) {
    cells.push_back(search_cell(search_place(point)));
    ++search_begin_[cells.back() + 1];
  }
  std::partial_sum(search_begin_.begin(), search_begin_.end(), search_begin_.begin());
  std::vector<int> next(search_begin_.begin(), search_begin_.end() - 1);
  std::vector<Vector3f> sorted(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) sorted[next[cells[i]]++] = points_[i];
  points_ = std::move(sorted);
}

void Cluster::build_density(double dense_points) {
  // Two empty cells around, so that the neighbours of a cell that is asked for always exist.
  density_lowest_ = lowest_ - Vector3f::Constant(2.0F * kDensityCellM);
  density_size_ =
      ((highest_ - density_lowest_) / kDensityCellM).cast<int>() + Vector3i::Constant(3);
  density_.assign(density_size_.prod(), 0);
  const auto limit = static_cast<std::uint8_t>(std::clamp(dense_points, 1.0, 255.0));
  for (const Vector3f& point : points_) {
    const Vector3i cell = ((point - density_lowest_) / kDensityCellM).cast<int>();
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        std::uint8_t* row =
            &density_[((cell.z() + z) * density_size_.y() + cell.y() + y) * density_size_.x() +
                      cell.x() - 1];
        for (int x = 0; x < 3; ++x) row[x] += row[x] < limit ? 1 : 0;
      }
    }
  }
}

LinkDensity Cluster::density(const Vector3f& start, const Vector3f& end) const {
  const int steps = std::max(2, static_cast<int>((end - start).norm() / kDensityCellM));
  const Vector3f step = (end - start) / (kDensityCellM * static_cast<float>(steps));
  Vector3f place = (start - density_lowest_) / kDensityCellM;
  int sum = 0, min = 255;
  for (int k = 0; k < steps; ++k) {
    place += step;
    const Vector3i cell = place.cast<int>();
    const bool inside =
        (place.array() >= 0.0F).all() && (cell.array() < density_size_.array()).all();
    const int points =
        inside ? density_[(cell.z() * density_size_.y() + cell.y()) * density_size_.x() + cell.x()]
               : 0;
    sum += points;
    min = std::min(min, points);
  }
  return {static_cast<float>(sum) / static_cast<float>(steps), static_cast<float>(min)};
}

void Cluster::mark_near_line(const Vector3f& start, const Vector3f& end, float radius_m,
                             std::vector<std::uint64_t>& bits) const {
  const Vector3f line = end - start;
  const float per_length = 1.0F / std::max(line.squaredNorm(), 1e-9F);
  const float limit = radius_m * radius_m;
  bits.assign((points_.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector3f offset = points_[i] - start;
    const float along = std::clamp(offset.dot(line) * per_length, 0.0F, 1.0F);
    const bool near = (offset - along * line).squaredNorm() <= limit;
    bits[i / 64] |= static_cast<std::uint64_t>(near) << (i % 64);
  }
}

}  // namespace limbcast::pose_fitter
