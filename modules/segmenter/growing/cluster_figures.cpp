#include "modules/segmenter/growing/cluster_figures.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace limbcast::segmenter {
namespace {

constexpr float kEdge_m = 0.15F;
/// Cells of the outline: large against the spacing of points, small against a limb's length.
constexpr float kCell_m = 0.05F;

float quantile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0F;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

float spread(std::vector<float>& values) {
  constexpr std::size_t kFewest = 10;
  return values.size() < kFewest ? 0.0F : quantile(values, 0.95) - quantile(values, 0.05);
}

/// Points of one cluster relative to the head's centre, and the surface each stands for.
struct Cluster {
  std::vector<Eigen::Vector3f> from_head_m;
  double area_m2 = 0.0;
  int open = 0;  ///< points whose surface goes on beyond the cluster
};

/// How round the head is: away = a x + b z - relief / (10 cm)^2 (x^2 + z^2) + c by least squares.
void measure_head(const Cluster& cluster, ClusterFigures& figures) {
  constexpr float kRim_m = 0.10F, kHalfHeight_m = 0.11F, kHalfDepth_m = 0.25F;
  std::vector<Eigen::Vector3f> head;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const auto row_of = [](const Eigen::Vector3f& p) {
    return Eigen::Vector4d(p.x(), p.z(), (p.x() * p.x() + p.z() * p.z()) / (kRim_m * kRim_m), 1.0);
  };
  for (const Eigen::Vector3f& p : cluster.from_head_m) {
    if (std::abs(p.x()) > kRim_m || std::abs(p.z()) > kHalfHeight_m ||
        std::abs(p.y()) > kHalfDepth_m)
      continue;
    head.push_back(p);
    normal += row_of(p) * row_of(p).transpose();
    right += row_of(p) * p.y();
  }
  if (head.size() < 20) return;
  const Eigen::Vector4d fit = normal.ldlt().solve(right);
  std::vector<float> residuals;
  residuals.reserve(head.size());
  for (const Eigen::Vector3f& p : head)
    residuals.push_back(static_cast<float>(std::abs(row_of(p).dot(fit) - p.y())));
  figures.head_relief_m = std::clamp(static_cast<float>(fit.z()), -0.3F, 0.3F);
  figures.head_roughness_m = quantile(residuals, 0.5);
}

/// Whether the surface at point i goes on to a neighbour that belongs to nobody and is not ground.
bool is_open(const Lattice& lattice, const std::vector<std::int16_t>& labels, std::size_t i,
             const JointGrowingParams& growing) {
  const int u = static_cast<int>(i) % lattice.width, v = static_cast<int>(i) / lattice.width;
  const float step_m = 0.5F * growing.longest_step_m(lattice.depth_m[i]);
  for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const auto n = lattice.find(u + du, v + dv);
    if (!n || labels[*n] != kNobody) continue;
    if (lattice.frame.ground_known && lattice.level_m[*n].z() < growing.ground_cut_m) continue;
    if ((lattice.level_m[*n] - lattice.level_m[i]).norm() < step_m) return true;
  }
  return false;
}

/// Outline area: cells across and up that hold a point.
float outline_m2(const Cluster& cluster) {
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector3f& p : cluster.from_head_m) {
    cells.emplace(static_cast<int>(std::floor(p.x() / kCell_m)),
                  static_cast<int>(std::floor(p.z() / kCell_m)));
  }
  return static_cast<float>(cells.size()) * kCell_m * kCell_m;
}

ClusterFigures measure(const Cluster& cluster, const ReachParams& reach) {
  ClusterFigures figures;
  figures.points = static_cast<int>(cluster.from_head_m.size());
  if (figures.points == 0) return figures;
  std::vector<float> across, up, head, shoulders, torso, away;
  int edge = 0, over_head = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& p : cluster.from_head_m) {
    across.push_back(p.x());
    up.push_back(p.z());
    sum += p.cast<double>();
    if (std::abs(p.z()) < 0.07F) head.push_back(p.x());
    if (p.z() < -0.20F && p.z() > -0.42F) shoulders.push_back(p.x());
    if (p.z() < -0.20F && p.z() > -0.70F) away.push_back(p.y());
    if (p.z() < -0.45F && p.z() > -0.70F) torso.push_back(p.x());
    edge += p.head<2>().norm() > reach.radius_m - kEdge_m ? 1 : 0;
    over_head += p.z() > 0.14F && std::abs(p.x()) < 0.25F ? 1 : 0;
  }
  const auto count = static_cast<float>(figures.points);
  figures.area_m2 = static_cast<float>(cluster.area_m2);
  figures.head_width_m = spread(head);
  figures.shoulder_width_m = spread(shoulders);
  figures.torso_width_m = spread(torso);
  figures.torso_depth_m = spread(away);
  figures.open_share = static_cast<float>(cluster.open) / count;
  measure_head(cluster, figures);
  figures.drop_m = -quantile(up, 0.01);
  figures.rise_m = quantile(up, 0.995);
  figures.edge_share = static_cast<float>(edge) / count;
  figures.over_head_share = static_cast<float>(over_head) / count;
  figures.offset_m = std::abs(quantile(across, 0.5));
  figures.seed_over_centroid_m = static_cast<float>(-sum.z() / figures.points);
  figures.seed_beside_centroid_m = static_cast<float>(sum.head<2>().norm() / figures.points);
  figures.density = std::min(1.0F, figures.area_m2 / outline_m2(cluster));
  return figures;
}

}  // namespace

ClusterFigures measure_cluster(const Lattice& lattice, const HeadCandidate& head,
                               const std::vector<std::int16_t>& labels, std::int16_t label,
                               const JointGrowingParams& growing, const ReachParams& reach) {
  Cluster cluster;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != label) continue;
    const float size_m = lattice.depth_m[i] / lattice.focal_px;
    cluster.from_head_m.push_back(from_head(lattice, head, lattice.level_m[i]));
    cluster.area_m2 += size_m * size_m;
    cluster.open += is_open(lattice, labels, i, growing) ? 1 : 0;
  }
  return measure(cluster, reach);
}

std::vector<ClusterFigures> measure_clusters(const Lattice& lattice,
                                             const std::vector<HeadCandidate>& heads,
                                             const std::vector<std::int16_t>& labels,
                                             const JointGrowingParams& growing,
                                             const ReachParams& reach) {
  std::vector<ClusterFigures> figures;
  figures.reserve(heads.size());
  for (std::size_t k = 0; k < heads.size(); ++k) {
    figures.push_back(
        measure_cluster(lattice, heads[k], labels, static_cast<std::int16_t>(k), growing, reach));
  }
  return figures;
}

}  // namespace limbcast::segmenter
