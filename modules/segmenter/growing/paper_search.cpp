#include "modules/segmenter/growing/paper_search.hpp"

#include <algorithm>
#include <utility>

#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/growing/paper_growing.hpp"

namespace limbcast::segmenter {
namespace {

ClusterFigures measure(const Cloud& cloud, const Lattice& lattice, const HeadCandidate& seed,
                       const std::vector<std::uint32_t>& points, const Params& params) {
  std::vector<std::uint8_t> member(cloud.points_m.size(), 0);
  for (const std::uint32_t i : points) member[i] = 1;
  std::vector<std::int16_t> labels(lattice.size(), kNobody);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (lattice.depth_m[i] > 0.0F && member[lattice.source[i]] != 0) labels[i] = 0;
  }
  ClusterFigures figures = measure_clusters(lattice, {seed}, labels, params.joint, params.reach)[0];
  figures.points = static_cast<int>(points.size());
  return figures;
}

/// A head stands upright over the centroid; of two seeds on one person it is the one that does so
/// better. A raised hand is higher, but beside.
float uprightness(const PaperCluster& cluster) {
  return cluster.figures.seed_over_centroid_m - cluster.figures.seed_beside_centroid_m;
}

float shared_part(const PaperCluster& a, const PaperCluster& b, std::vector<std::uint8_t>& member) {
  for (const std::uint32_t i : a.points) member[i] = 1;
  const auto shared = std::count_if(b.points.begin(), b.points.end(),
                                    [&](std::uint32_t i) { return member[i] != 0; });
  for (const std::uint32_t i : a.points) member[i] = 0;
  return static_cast<float>(shared) /
         static_cast<float>(std::min(a.points.size(), b.points.size()));
}

/// Leaves one cluster a person.
void reject_twins(std::size_t cloud_size, std::vector<PaperCluster>& clusters) {
  std::vector<std::uint8_t> member(cloud_size, 0);
  for (std::size_t a = 0; a < clusters.size(); ++a) {
    for (std::size_t b = a + 1; b < clusters.size() && !clusters[a].rejection; ++b) {
      if (clusters[b].rejection) continue;
      const float shared = shared_part(clusters[a], clusters[b], member);
      if (shared <= kSamePersonShare) continue;
      PaperCluster& worse =
          uprightness(clusters[a]) >= uprightness(clusters[b]) ? clusters[b] : clusters[a];
      worse.rejection = Rejection{SegmentFilter::kSamePerson, shared, kSamePersonShare};
    }
  }
}

}  // namespace

std::vector<PaperCluster> find_people_as_paper(const Cloud& cloud, const Lattice& lattice,
                                               const std::vector<HeadCandidate>& seeds,
                                               NeighborSearch& search, const Params& params) {
  const Eigen::Vector3f down = lattice.frame.down();
  std::vector<PaperCluster> clusters;
  for (const HeadCandidate& seed : seeds) {
    PaperCluster cluster;
    cluster.seed = seed;
    const std::uint32_t start = lattice.source[lattice.index(seed.u, seed.v)];
    cluster.points = grow_cluster(cloud, start, down, params.paper, params.reach, search);
    cluster.figures = measure(cloud, lattice, seed, cluster.points, params);
    cluster.rejection = check_validity(cluster.figures, params.paper_filters);
    clusters.push_back(std::move(cluster));
  }
  reject_twins(cloud.points_m.size(), clusters);
  std::stable_partition(clusters.begin(), clusters.end(),
                        [](const PaperCluster& c) { return !c.rejection; });
  return clusters;
}

}  // namespace limbcast::segmenter
