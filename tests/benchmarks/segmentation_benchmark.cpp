// Segmentation of a VGA cloud of the demo log, beside PCL's growing and clustering, and the skin
// mask of its image beside OpenCV's. The counter "points" is the size of what came out.

#include <benchmark/benchmark.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "modules/segmenter/faces_and_joints/face_finder.hpp"
#include "modules/segmenter/faces_and_joints/pose_network.hpp"
#include "modules/segmenter/growing/neighbor_search.hpp"
#include "modules/segmenter/growing/paper_growing.hpp"
#include "modules/segmenter/seeds/skin_color.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

const Cloud& cloud() { return test::demo_frame().cloud; }

/// The first person's head, as the segmenter finds it.
const Eigen::Vector3f& seed_m() {
  static const Eigen::Vector3f seed = segment(cloud()).segments.at(0).seed_m;
  return seed;
}

std::uint32_t seed_index() {
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < cloud().points_m.size(); ++i) {
    const auto distance = [](std::uint32_t k) { return (cloud().points_m[k] - seed_m()).norm(); };
    if (!cloud().is_hole(i) && distance(i) < distance(nearest)) nearest = i;
  }
  return nearest;
}

void set_points(benchmark::State& state, std::size_t points) {
  state.counters["points"] = static_cast<double>(points);
}

void segment_a_cloud(benchmark::State& state) {
  const Segmenter segmenter;
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.segment(cloud()));
}
BENCHMARK(segment_a_cloud)->Unit(benchmark::kMillisecond);

void cut_out_a_person(benchmark::State& state) {
  const Segmenter segmenter;
  std::size_t points = 0;
  for (auto _ : state)
    points = segmenter.cut_out_people(cloud(), {seed_m()}).segments.at(0).points_m.size();
  set_points(state, points);
}
BENCHMARK(cut_out_a_person)->Unit(benchmark::kMillisecond);

/// At a head that looks at the sensor.
void look_for_a_face(benchmark::State& state) {
  const FaceFinder finder({});
  for (auto _ : state)
    benchmark::DoNotOptimize(finder.look(cloud(), seed_m(), Eigen::Vector2f(0.0F, -1.0F)));
}
BENCHMARK(look_for_a_face)->Unit(benchmark::kMillisecond);

/// A network of poses at the first person.
void see_joints(benchmark::State& state, const PoseNetworkParams& params, PictureNetworkKind kind) {
  const PoseNetwork network(params, kind);
  const std::vector<std::int16_t> labels(cloud().points_m.size(), kNobody);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        network.look(cloud(), {labels, 0, seed_m()}, cloud().stamp.gravity.down));
}
BENCHMARK_CAPTURE(see_joints, blaze_pose, PoseNetworkParams{}, PictureNetworkKind::kBlazePose)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(see_joints, move_net, kSecondPoseNetwork, PictureNetworkKind::kMoveNet)
    ->Unit(benchmark::kMillisecond);

/// The network of depths at the first person.
void see_joints_in_depths(benchmark::State& state, NetworkLibrary library) {
  DepthPoseParams params;
  params.library = library;
  const DepthPose network(params);
  const Scene scene = look_at(cloud(), {});
  const std::vector<std::int16_t> labels(cloud().points_m.size(), 0);
  for (auto _ : state) {
    const auto picture = draw_depths(scene, {labels, 0, seed_m()}, params.picture);
    benchmark::DoNotOptimize(network.look(picture.value()));
  }
}
BENCHMARK_CAPTURE(see_joints_in_depths, quickest, network_libraries().front())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(see_joints_in_depths, portable, NetworkLibrary::kXnnpack)
    ->Unit(benchmark::kMillisecond);

using MakeSearch = std::unique_ptr<NeighborSearch> (*)(const Cloud&);

/// Algorithm 1 from one seed, with what it needs for a new cloud.
void algorithm1(benchmark::State& state, MakeSearch make_search) {
  const std::uint32_t seed = seed_index();
  std::size_t points = 0;
  for (auto _ : state) {
    const auto search = make_search(cloud());
    points = grow_cluster(cloud(), seed, cloud().stamp.gravity.down, {}, {}, *search).size();
  }
  set_points(state, points);
}
BENCHMARK_CAPTURE(algorithm1, kd_tree, make_kd_tree_search)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(algorithm1, lattice, make_lattice_search)->Unit(benchmark::kMillisecond);

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// The points without holes; `seed` becomes its index there.
PclCloud::Ptr to_pcl(std::uint32_t& seed) {
  const auto points = std::make_shared<PclCloud>();
  std::uint32_t index = 0;
  for (std::uint32_t i = 0; i < cloud().points_m.size(); ++i) {
    if (cloud().is_hole(i)) continue;
    if (i == seed) index = static_cast<std::uint32_t>(points->size());
    const Eigen::Vector3f& p = cloud().points_m[i];
    points->emplace_back(p.x(), p.y(), p.z());
  }
  seed = index;
  return points;
}

/// Algorithm 1 with PCL's kd-tree.
void pcl_radius_growing(benchmark::State& state) {
  std::uint32_t seed = seed_index();
  const PclCloud::Ptr points = to_pcl(seed);
  const PaperGrowingParams params;
  const ReachCylinder cylinder(points->at(seed).getVector3fMap(), cloud().stamp.gravity.down, {});
  std::size_t size = 0;
  for (auto _ : state) {
    pcl::search::KdTree<pcl::PointXYZ> tree(false);
    tree.setInputCloud(points);
    std::vector<bool> named(points->size(), false);
    std::vector<int> cluster = {static_cast<int>(seed)}, neighbors;
    std::vector<float> squared_distances;
    named[seed] = true;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      tree.radiusSearch(cluster[i], params.max_distance_m, neighbors, squared_distances);
      for (const int n : neighbors) {
        const auto k = static_cast<std::size_t>(n);
        if (named[k]) continue;
        named[k] = true;
        if (cylinder.contains(points->at(k).getVector3fMap())) cluster.push_back(n);
      }
    }
    size = cluster.size();
  }
  set_points(state, size);
}
BENCHMARK(pcl_radius_growing)->Unit(benchmark::kMillisecond);

/// All clusters of the scene: PCL's class knows neither seed nor cylinder.
void pcl_euclidean_clusters(benchmark::State& state) {
  std::uint32_t seed = seed_index();
  const PclCloud::Ptr points = to_pcl(seed);
  std::size_t clusters = 0;
  for (auto _ : state) {
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setClusterTolerance(PaperGrowingParams().max_distance_m);
    extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
    extraction.setInputCloud(points);
    std::vector<pcl::PointIndices> found;
    extraction.extract(found);
    clusters = found.size();
  }
  state.counters["clusters"] = static_cast<double>(clusters);
}
BENCHMARK(pcl_euclidean_clusters)->Unit(benchmark::kMillisecond);

void skin_mask(benchmark::State& state) {
  const SkinColor skin;
  const std::vector<Bgr>& colors = cloud().colors;
  std::vector<std::uint8_t> mask(colors.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < colors.size(); ++i) mask[i] = skin.log_ratio(colors[i]) > 0.0F;
    benchmark::DoNotOptimize(mask.data());
  }
}
BENCHMARK(skin_mask)->Unit(benchmark::kMillisecond);

/// Box in YCrCb (Chai and Ngan, "Face segmentation using skin-color map", IEEE CSVT 9(4), 1999).
void opencv_skin_mask(benchmark::State& state) {
  cv::Mat3b image(cloud().height, cloud().width);
  for (std::size_t i = 0; i < cloud().colors.size(); ++i) {
    const Bgr& color = cloud().colors[i];
    image(static_cast<int>(i)) = {color.b, color.g, color.r};
  }
  cv::setNumThreads(1);
  cv::Mat ycrcb, mask;
  for (auto _ : state) {
    cv::cvtColor(image, ycrcb, cv::COLOR_BGR2YCrCb);
    cv::inRange(ycrcb, cv::Scalar(0, 133, 77), cv::Scalar(255, 173, 127), mask);
    benchmark::DoNotOptimize(mask.data);
  }
}
BENCHMARK(opencv_skin_mask)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace limbcast::segmenter

BENCHMARK_MAIN();
