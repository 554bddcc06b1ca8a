#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "modules/segmenter/growing/neighbor_search.hpp"
#include "modules/segmenter/growing/paper_growing.hpp"
#include "modules/segmenter/growing/paper_search.hpp"
#include "modules/segmenter/segmenter.hpp"

namespace limbcast::segmenter {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using Indices = std::vector<std::uint32_t>;

const Eigen::Vector3f kDown(0.0F, 1.0F, 0.0F);

Cloud scan(const std::vector<Eigen::Vector3f>& points) {
  Cloud cloud;
  cloud.points_m = points;
  cloud.width = static_cast<int>(points.size());
  cloud.height = 1;
  return cloud;
}

/// `count` points in a row along x, `spacing_m` apart, 2 m before the sensor.
Cloud row(int count, float spacing_m) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(static_cast<float>(i) * spacing_m, 0.0F, 2.0F);
  return scan(points);
}

Indices grown(const Cloud& cloud, std::uint32_t seed, const PaperGrowingParams& params = {},
              const ReachParams& reach = {}) {
  return grow_cluster(cloud, seed, kDown, params, reach, *make_kd_tree_search(cloud));
}

PaperGrowingParams with_max_distance(float max_distance_m) {
  PaperGrowingParams params;
  params.max_distance_m = max_distance_m;
  return params;
}

TEST(Algorithm1, CrossesAGapBelowMaxDistance) {
  EXPECT_THAT(grown(row(3, 0.49F), 0, with_max_distance(0.5F)), ElementsAre(0, 1, 2));
}

TEST(Algorithm1, TakesANeighborAtMaxDistance) {
  EXPECT_THAT(grown(row(2, 0.5F), 0, with_max_distance(0.5F)), ElementsAre(0, 1));
}

TEST(Algorithm1, StopsAtAGapAboveMaxDistance) {
  const Cloud cloud = scan({{0.0F, 0.0F, 2.0F}, {0.4F, 0.0F, 2.0F}, {0.91F, 0.0F, 2.0F}});
  EXPECT_THAT(grown(cloud, 0, with_max_distance(0.5F)), ElementsAre(0, 1));
  EXPECT_THAT(grown(cloud, 2, with_max_distance(0.5F)), ElementsAre(2));
}

TEST(Algorithm1, LooksAtTheClustersPointsInTheOrderTheyWereAdded) {
  EXPECT_THAT(grown(row(5, 0.05F), 2, with_max_distance(0.06F)), ElementsAre(2, 1, 3, 0, 4));
}

TEST(Algorithm1, LooksUpTheNeighborsOfNoMoreThanMaxIterationsPoints) {
  PaperGrowingParams params = with_max_distance(0.06F);
  for (const int iterations : {1, 2, 5}) {
    params.max_iterations = iterations;
    // From the end of a row each look adds one point.
    EXPECT_THAT(grown(row(10, 0.05F), 0, params), SizeIs(static_cast<std::size_t>(iterations) + 1));
  }
}

TEST(Algorithm1, AddsOnlyWhatAHumanCanReach) {
  ReachParams reach;
  reach.radius_m = 0.32F;
  reach.above_m = 0.22F;
  reach.below_m = 0.42F;
  // A cross through the seed (index 0), arms of 20 points 5 cm apart: to the right, up, down.
  std::vector<Eigen::Vector3f> points = {{0.0F, 0.0F, 2.0F}};
  for (const Eigen::Vector3f& arm :
       {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, -1, 0), Eigen::Vector3f(0, 1, 0)}) {
    for (int i = 1; i <= 20; ++i)
      points.emplace_back(points[0] + 0.05F * static_cast<float>(i) * arm);
  }
  Indices cluster = grown(scan(points), 0, {}, reach);
  std::sort(cluster.begin(), cluster.end());
  // 0.32 / 0.05 = 6 to the right, 0.22 / 0.05 = 4 up, 0.42 / 0.05 = 8 down.
  EXPECT_THAT(cluster,
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 21, 22, 23, 24, 41, 42, 43, 44, 45, 46, 47, 48));
}

TEST(Algorithm1, KeepsTheCylinderAlongGravity) {
  const ReachCylinder upright(Eigen::Vector3f::Zero(), kDown, {});
  EXPECT_TRUE(upright.contains({0.0F, 1.9F, 0.0F}));
  EXPECT_FALSE(upright.contains({0.0F, 0.0F, 1.9F}));
  const ReachCylinder lying(Eigen::Vector3f::Zero(), Eigen::Vector3f(0.0F, 0.0F, 1.0F), {});
  EXPECT_FALSE(lying.contains({0.0F, 1.9F, 0.0F}));
  EXPECT_TRUE(lying.contains({0.0F, 0.0F, 1.9F}));
}

TEST(Algorithm1, LeavesASinglePointAlone) { EXPECT_THAT(grown(row(1, 0.05F), 0), ElementsAre(0)); }

TEST(Algorithm1, ForgetsTheClusterBeforeIt) {
  const Cloud cloud = row(6, 0.05F);
  const auto search = make_kd_tree_search(cloud);
  EXPECT_THAT(grow_cluster(cloud, 0, kDown, {}, {}, *search), SizeIs(6));
  EXPECT_THAT(grow_cluster(cloud, 5, kDown, {}, {}, *search), SizeIs(6));
}

constexpr int kCloudWidth = 64, kCloudHeight = 48;

/// A camera's cloud; depth_of(u, v) tells the depth, 0 for a hole.
template <class DepthOf>
Cloud camera_cloud(DepthOf depth_of) {
  Cloud cloud;
  cloud.camera = PinholeCamera{kCloudWidth, kCloudHeight, 50.0, 52.0, 31.5, 23.5};
  cloud.width = kCloudWidth;
  cloud.height = kCloudHeight;
  for (int v = 0; v < kCloudHeight; ++v) {
    for (int u = 0; u < kCloudWidth; ++u) {
      cloud.points_m.push_back(
          cloud.camera->back_project(static_cast<float>(u), static_cast<float>(v), depth_of(u, v)));
    }
  }
  return cloud;
}

/// Slopes, steps, holes and noise, from nearer than d_max to 5 m.
Cloud rough_cloud(unsigned seed) {
  std::mt19937 random(seed);
  return camera_cloud([&](int u, int v) {
    const float noise = static_cast<float>(random() % 1000) / 1000.0F;
    if (random() % 10 == 0) return 0.0F;
    if (u < 6 && v < 6) return 0.03F + 0.1F * noise;
    return (u < 30 ? 1.0F + 0.03F * static_cast<float>(v) : 4.0F) + 0.1F * noise;
  });
}

TEST(NeighborSearch, NamesTheSamePointsByTreeAndByLattice) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Cloud cloud = rough_cloud(seed);
    for (const float radius_m : {0.02F, 0.06F, 0.3F}) {
      const auto tree = make_kd_tree_search(cloud), lattice = make_lattice_search(cloud);
      for (std::uint32_t i = 0; i < cloud.points_m.size(); ++i) {
        if (cloud.is_hole(i)) continue;
        tree->reset();
        lattice->reset();
        Indices by_tree, by_lattice;
        tree->take_neighbors(i, radius_m, by_tree);
        lattice->take_neighbors(i, radius_m, by_lattice);
        ASSERT_EQ(by_tree, by_lattice) << "point " << i << " within " << radius_m << " m";
      }
    }
  }
}

// Depths that jump at each pixel put points at the very rim of the window that a ball can cover.
TEST(NeighborSearch, NamesTheSamePointsByTreeAndByLatticeWhereDepthsJump) {
  std::mt19937 random(6);
  const Cloud cloud =
      camera_cloud([&](int, int) { return 0.5F + static_cast<float>(random() % 1000) / 1000.0F; });
  const auto tree = make_kd_tree_search(cloud), lattice = make_lattice_search(cloud);
  for (std::uint32_t i = 0; i < cloud.points_m.size(); ++i) {
    tree->reset();
    lattice->reset();
    Indices by_tree, by_lattice;
    tree->take_neighbors(i, 0.4F, by_tree);
    lattice->take_neighbors(i, 0.4F, by_lattice);
    ASSERT_EQ(by_tree, by_lattice) << "point " << i;
  }
}

TEST(NeighborSearch, GrowsTheSameClusterByTreeAndByLattice) {
  const Cloud cloud = rough_cloud(4);
  const auto tree = make_kd_tree_search(cloud), lattice = make_lattice_search(cloud);
  for (std::uint32_t seed = 0; seed < cloud.points_m.size(); seed += 97) {
    if (cloud.is_hole(seed)) continue;
    const PaperGrowingParams params = with_max_distance(0.15F);
    EXPECT_EQ(grow_cluster(cloud, seed, kDown, params, {}, *tree),
              grow_cluster(cloud, seed, kDown, params, {}, *lattice));
  }
}

TEST(NeighborSearch, NamesThePointsThatCountingFinds) {
  const Cloud cloud = rough_cloud(5);
  const auto tree = make_kd_tree_search(cloud);
  constexpr float kRadius_m = 0.2F;
  for (std::uint32_t i = 0; i < cloud.points_m.size(); i += 61) {
    if (cloud.is_hole(i)) continue;
    Indices expected, found;
    for (std::uint32_t k = 0; k < cloud.points_m.size(); ++k) {
      if (!cloud.is_hole(k) && (cloud.points_m[k] - cloud.points_m[i]).norm() <= kRadius_m)
        expected.push_back(k);
    }
    tree->reset();
    tree->take_neighbors(i, kRadius_m, found);
    EXPECT_EQ(found, expected);
  }
}

TEST(NeighborSearch, NamesEachPointOnce) {
  const Cloud cloud = row(3, 0.05F);
  const auto search = make_kd_tree_search(cloud);
  Indices first, second;
  search->name(0);
  search->take_neighbors(0, 0.06F, first);
  search->take_neighbors(1, 0.06F, second);
  EXPECT_THAT(first, ElementsAre(1));
  EXPECT_THAT(second, ElementsAre(2));
}

TEST(NeighborSearch, LeavesOutPointsThatAreNotFinite) {
  Cloud cloud = row(3, 0.05F);
  cloud.points_m[1].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(grown(cloud, 0, with_max_distance(0.2F)), ElementsAre(0, 2));
}

/// An upright plate, 32 pixels wide and 28 high, 2 m before a level camera and 4 m before a wall.
Cloud plate_cloud() {
  return camera_cloud(
      [](int u, int v) { return u >= 16 && u < 48 && v >= 8 && v < 36 ? 2.0F : 6.0F; });
}

HeadCandidate seed_at(const Lattice& lattice, int u, int v) {
  HeadCandidate seed;
  seed.u = u;
  seed.v = v;
  seed.surface_m = lattice.level_m[lattice.index(u, v)];
  seed.center_m = seed.surface_m;
  return seed;
}

std::vector<PaperCluster> clusters_from(const std::vector<Eigen::Vector2i>& pixels) {
  const Cloud cloud = plate_cloud();
  const Lattice lattice = thin(cloud, make_level_frame(cloud.stamp.gravity, std::nullopt), 1);
  std::vector<HeadCandidate> seeds;
  for (const Eigen::Vector2i& px : pixels) seeds.push_back(seed_at(lattice, px.x(), px.y()));
  Params params;
  params.reach.radius_m = 2.0F;
  return find_people_as_paper(cloud, lattice, seeds, *make_kd_tree_search(cloud), params);
}

TEST(PaperSearch, GrowsTheWholeSurfaceFromItsSeedAndNothingElse) {
  const auto clusters = clusters_from({{32, 10}});
  ASSERT_THAT(clusters, SizeIs(1));
  EXPECT_FALSE(clusters[0].rejection.has_value());
  EXPECT_THAT(clusters[0].points, SizeIs(32 * 28));
  // Rows 8 to 35 have their middle at 21.5; row 10 is 11.5 * 2 m / 52 px over it.
  EXPECT_NEAR(clusters[0].figures.seed_over_centroid_m, 11.5F * 2.0F / 52.0F, 1e-4F);
}

TEST(PaperSearch, MeasuresHowManyRaysThroughTheOutlineHit) {
  const Cloud full = plate_cloud();
  const Cloud half = camera_cloud([](int u, int v) {
    return u >= 16 && u < 48 && v >= 8 && v < 36 && (u + v) % 2 == 0 ? 2.0F : 0.0F;
  });
  const auto density = [](const Cloud& cloud) {
    const Lattice lattice = thin(cloud, make_level_frame(cloud.stamp.gravity, std::nullopt), 1);
    return find_people_as_paper(cloud, lattice, {seed_at(lattice, 32, 10)},
                                *make_kd_tree_search(cloud), {})[0]
        .figures.density;
  };
  EXPECT_GT(density(full), 0.9F);
  EXPECT_LT(density(half), 0.8F * density(full));
}

TEST(PaperSearch, RejectsASeedAtTheLowerEnd) {
  const auto clusters = clusters_from({{32, 34}});
  ASSERT_THAT(clusters, SizeIs(1));
  ASSERT_TRUE(clusters[0].rejection.has_value());
  EXPECT_EQ(clusters[0].rejection->filter, SegmentFilter::kSeedNotHead);
}

TEST(PaperSearch, LeavesOneClusterToTwoSeedsOfOnePerson) {
  const auto clusters = clusters_from({{26, 13}, {32, 10}});
  ASSERT_THAT(clusters, SizeIs(2));
  EXPECT_FALSE(clusters[0].rejection.has_value());
  EXPECT_EQ(clusters[0].seed.u, 32);  // higher, and nearer to the centroid's axis
  ASSERT_TRUE(clusters[1].rejection.has_value());
  EXPECT_EQ(clusters[1].rejection->filter, SegmentFilter::kSamePerson);
  EXPECT_FLOAT_EQ(clusters[1].rejection->figure, 1.0F);
}

class AnyMethod : public ::testing::TestWithParam<Growing> {
 protected:
  Segments segments_of(const Cloud& cloud) const {
    Params params;
    params.growing = GetParam();
    return segment(cloud, params);
  }
};

TEST_P(AnyMethod, FindsNobodyInAnEmptyCloud) {
  EXPECT_THAT(segments_of(Cloud{}).segments, SizeIs(0));
}

TEST_P(AnyMethod, FindsNobodyInACloudOfOnePoint) {
  Cloud cloud = scan({{0.0F, 0.0F, 2.0F}});
  cloud.colors = {Bgr{120, 150, 200}};
  for (const Segment& segment : segments_of(cloud).segments) EXPECT_FALSE(segment.valid());
}

TEST_P(AnyMethod, FindsNobodyInACameraCloudOfOnePoint) {
  const Cloud cloud = camera_cloud([](int u, int v) { return u == 32 && v == 20 ? 2.0F : 0.0F; });
  for (const Segment& segment : segments_of(cloud).segments) EXPECT_FALSE(segment.valid());
}

TEST_P(AnyMethod, FindsNobodyInACameraCloudOfHoles) {
  EXPECT_THAT(segments_of(camera_cloud([](int, int) { return 0.0F; })).segments, SizeIs(0));
}

INSTANTIATE_TEST_SUITE_P(Growing, AnyMethod, ::testing::Values(Growing::kRefined, Growing::kPaper),
                         [](const auto& method) {
                           return method.param == Growing::kPaper ? "Paper" : "Refined";
                         });

}  // namespace
}  // namespace limbcast::segmenter
