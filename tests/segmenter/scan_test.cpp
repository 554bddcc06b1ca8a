// People in the clouds of laser range finders: unorganised, all around the sensor.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "modules/segmenter/growing/cluster_figures.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/range_image.hpp"
#include "modules/segmenter/scene/panorama.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/simulated_person.hpp"

namespace limbcast::segmenter {
namespace {

Cloud scan_of(std::vector<Eigen::Vector3f> points_m) {
  Cloud cloud;
  cloud.points_m = std::move(points_m);
  cloud.width = static_cast<int>(cloud.points_m.size());
  cloud.height = 1;
  return cloud;
}

LevelFrame level_frame() { return make_level_frame(Gravity{}, std::nullopt); }

TEST(Panorama, LabelsAllPointsOfALimbThatReachesAwayFromTheSensor) {
  // An even number of columns, so that one begins straight ahead.
  const PanoramaParams params{150.0F, 4};
  // Two or three points share a pixel, whose nearest and farthest are up to 10 cm apart: more than
  // a step of growing. The next is 5 cm behind the last.
  std::vector<Eigen::Vector3f> points_m;
  for (int k = 0; k < 7; ++k) {
    const float azimuth_rad = (0.1F + 0.4F * static_cast<float>(k)) / params.focal_px,
                distance_m = 2.0F + 0.05F * static_cast<float>(k);
    points_m.emplace_back(distance_m * std::sin(azimuth_rad), 0.0F,
                          distance_m * std::cos(azimuth_rad));
  }
  const Cloud cloud = scan_of(points_m);
  const Lattice panorama = render_panorama(cloud, level_frame(), params);
  const std::vector<std::int16_t> labels(panorama.size(), 0);

  const auto of_points = labels_of_points(cloud, panorama, labels, JointGrowingParams{});

  EXPECT_EQ(std::count(of_points.begin(), of_points.end(), 0), 7);
}

/// A flat head and trunk 3 m from the sensor, turned about it.
Cloud figure_at(float azimuth_rad) {
  constexpr float kStep_m = 0.01F, kDistance_m = 3.0F;
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(azimuth_rad, Eigen::Vector3f::UnitY()).toRotationMatrix();
  std::vector<Eigen::Vector3f> points_m;
  for (float down_m = -0.12F; down_m < 0.8F; down_m += kStep_m) {
    const float half_width_m = down_m < 0.17F ? 0.08F : 0.22F;
    for (float right_m = -half_width_m; right_m < half_width_m; right_m += kStep_m)
      points_m.push_back(turn * Eigen::Vector3f(right_m, down_m, kDistance_m));
  }
  return scan_of(points_m);
}

/// Of the figure's points up to that far to its right.
ClusterFigures figures_at(float azimuth_rad, float right_end_m = 1.0F) {
  const Params params;
  const Lattice panorama = render_panorama(figure_at(azimuth_rad), level_frame(), params.panorama);
  std::vector<std::int16_t> labels(panorama.size(), kNobody);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Eigen::Vector3f& point = panorama.level_m[i];
    const float right_m = point.x() * std::cos(azimuth_rad) - point.y() * std::sin(azimuth_rad);
    if (panorama.depth_m[i] > 0.0F && right_m < right_end_m) labels[i] = 0;
  }
  HeadCandidate head;
  head.surface_m = {3.0F * std::sin(azimuth_rad), 3.0F * std::cos(azimuth_rad), 0.0F};
  head.center_m = head_center(panorama, head.surface_m);
  return measure_cluster(panorama, head, labels, 0, params.joint, params.reach);
}

TEST(ClusterFigures, AreTheSameOnAllSidesOfAScanner) {
  const ClusterFigures ahead = figures_at(0.0F);
  for (const float azimuth_rad : {-0.5F * kPi<float>, 0.25F * kPi<float>, 0.8F * kPi<float>}) {
    const ClusterFigures turned = figures_at(azimuth_rad);
    // A pixel of the panorama is 1.3 cm wide there, and each side may lose one.
    EXPECT_NEAR(turned.shoulder_width_m, ahead.shoulder_width_m, 0.04F);
    EXPECT_NEAR(turned.head_width_m, ahead.head_width_m, 0.04F);
    EXPECT_NEAR(turned.torso_depth_m, ahead.torso_depth_m, 0.04F);
  }
}

TEST(ClusterFigures, SeeWhatGoesOnBeyondAPanoramasFirstColumn) {
  // Half of it is another's, and the seam of the panorama is between the two.
  const float ahead = figures_at(0.0F, 0.0F).open_share;
  EXPECT_GT(ahead, 0.02F);
  EXPECT_NEAR(figures_at(kPi<float>, 0.0F).open_share, ahead, 0.01F);
}

TEST(LikelyHeads, AreRarerAmongTheManyPlacesOfAPanorama) {
  const Params params;
  const Lattice panorama = render_panorama(figure_at(0.0F), level_frame(), params.panorama);
  const std::vector<HeadCandidate> candidates = find_heads(panorama, params.head);
  ASSERT_FALSE(candidates.empty());
  const HeadClassifier classifier;
  ClassifierParams any;
  any.min_panorama_head_odds = -100.0F;
  std::vector<RejectedHead> rejected;
  const auto heads = likely_heads(panorama, {candidates[0]}, classifier, any, rejected);
  ASSERT_EQ(heads.size(), 1U);
  EXPECT_LT(any.panorama_odds, 0.0F);
  EXPECT_FLOAT_EQ(heads[0].odds, classifier.head_odds(panorama, candidates[0]) + any.panorama_odds);
}

TEST(LikelyHeads, NeedLessOddsInAPanoramaThanBeforeACamera) {
  const Params params;
  Lattice panorama = render_panorama(figure_at(0.0F), level_frame(), params.panorama);
  const std::vector<HeadCandidate> candidates = find_heads(panorama, params.head);
  ASSERT_FALSE(candidates.empty());
  const HeadClassifier classifier;
  const float odds = classifier.head_odds(panorama, candidates[0]);
  ClassifierParams limits;
  limits.panorama_odds = 0.0F;
  limits.min_panorama_head_odds = odds - 0.1F;
  limits.min_head_odds = odds + 0.1F;
  std::vector<RejectedHead> rejected;
  EXPECT_EQ(likely_heads(panorama, {candidates[0]}, classifier, limits, rejected).size(), 1U);
  panorama.wraps_around = false;
  EXPECT_TRUE(likely_heads(panorama, {candidates[0]}, classifier, limits, rejected).empty());
}

TEST(RangeImageOfAScan, LeavesOutWhatMayBeABody) {
  const Params params;
  const Cloud cloud = figure_at(0.0F);
  // What is lower than 40 cm under the sensor was cut off without being sure.
  std::vector<std::int16_t> labels;
  for (const Eigen::Vector3f& point : cloud.points_m)
    labels.push_back(point.y() < 0.4F ? std::int16_t{0} : kUnsure);
  const SkinColor skin;
  Segment segment;
  fill_from_scan({cloud, labels, skin, 0.0F, /*margin_m=*/0.4F}, 0, {0.0F, 1.0F, 0.0F},
                 params.scan_range_image.focal_px, params.scan_range_image.gap_px, segment);

  const RangeImage& image = segment.range_image.value();
  ASSERT_EQ(image.labels.size(), image.depth_m.size());
  const Eigen::Vector2f below = image.camera.project({0.0F, 0.6F, 3.0F});
  const auto pixel = static_cast<std::size_t>(std::lround(below.y()) * image.camera.width +
                                              std::lround(below.x()));
  EXPECT_EQ(image.labels.at(pixel), PixelLabel::kUnknown);
  EXPECT_EQ(image.depth_m.at(pixel), 0.0F);
  EXPECT_EQ(std::count(image.labels.begin(), image.labels.end(), PixelLabel::kOther), 0);
}

/// What a dense tilting scanner sees of somebody.
struct ScannedPerson {
  Cloud cloud;
  std::vector<int> person_of_point;
  std::array<Eigen::Vector3f, kJointCount> joints_m;

  const Eigen::Vector3f& head_m() const { return joints_m[index(Joint::kHead)]; }
};

ScannedPerson scanned_person(const std::string& posture, std::uint64_t seed) {
  simulate::SimulatorParams params = person_in_sight(simulate::SensorKind::kLaser, posture);
  params.laser.rings = 269;
  params.laser.azimuth_step_deg = 0.25;
  params.laser.min_elevation_deg = -33.5;
  params.laser.max_elevation_deg = 33.5;
  const simulate::SimulatedFrame frame = simulate::simulate_frame(params, seed, 0);
  ScannedPerson person{scan_of(frame.laser.points_m), frame.laser.persons, {}};
  const auto& joints_m = frame.scenario.persons.at(0).skeleton.joints;
  std::transform(joints_m.begin(), joints_m.end(), person.joints_m.begin(),
                 [](const auto& joint_m) { return joint_m.template cast<float>(); });
  person.cloud.stamp.depth_noise = {0.01F, 0.0F};
  set_gravity(frame, person.cloud);
  return person;
}

/// Whole sofas, which reach under the head and are as wide as a trunk, grow along with their
/// sitters.
class SitterOnASofa : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SitterOnASofa, IsCutOutOfAScanWithoutIt) {
  const ScannedPerson seated = scanned_person("sit", GetParam());
  const Segments cut = Segmenter().cut_out_people(seated.cloud, {seated.head_m()});
  ASSERT_EQ(cut.segments.size(), 1U);
  const std::vector<Eigen::Vector3f>& points_m = cut.segments[0].points_m;
  std::ptrdiff_t of_person = 0;
  // The segment keeps the cloud's order.
  auto at = seated.cloud.points_m.begin();
  for (const Eigen::Vector3f& point : points_m) {
    at = std::find(at, seated.cloud.points_m.end(), point);
    of_person +=
        seated.person_of_point[static_cast<std::size_t>(at - seated.cloud.points_m.begin())];
  }
  const auto kept = static_cast<std::ptrdiff_t>(points_m.size());
  const auto all = std::count(seated.person_of_point.begin(), seated.person_of_point.end(), 1);
  // Without the network a quarter to two fifths of the points are the sitter's.
  EXPECT_GT(of_person, kept * 7 / 10);
  // Shins and hands before the sofa go with it.
  EXPECT_GT(of_person, all * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Simulated, SitterOnASofa, ::testing::Values(14, 21, 24, 25));

class StandingPerson : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(StandingPerson, HasJointsThatTheNetworkSeesInTheDepths) {
  constexpr float kNear_m = 0.10F;
  const ScannedPerson person = scanned_person("stand", GetParam());
  const Segments cut = Segmenter().cut_out_people(person.cloud, {person.head_m()});
  ASSERT_EQ(cut.segments.size(), 1U);
  const ImagePose& pose =
      cut.segments[0].image_poses.at(static_cast<std::size_t>(ImageNetwork::kDepthPose));
  const RangeImage& view = cut.segments[0].range_image.value();
  for (const Joint left : {Joint::kShoulderLeft, Joint::kHipLeft}) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Joint joint = on_side(left, side);
      const Eigen::Vector2f& px = pose.joints.at(static_cast<std::size_t>(index(joint))).px;
      const Eigen::Vector3f ray =
          view.frame_from_image * view.camera.back_project(px.x(), px.y(), 1.0F).normalized();
      EXPECT_LT(person.joints_m[index(joint)].cross(ray).norm(), kNear_m)
          << kJointNames[index(joint)];
    }
  }
}

/// The same with a hand before the face, as of who points at the sensor.
Cloud with_hand_before_face(const ScannedPerson& person) {
  constexpr float kBefore_m = 0.5F, kHalfHand_m = 0.07F;
  const float distance_m = person.head_m().norm();
  const Eigen::Vector3f ray = person.head_m() / distance_m;
  Cloud cloud = person.cloud;
  for (Eigen::Vector3f& point_m : cloud.points_m) {
    const float along_m = point_m.dot(ray);
    const Eigen::Vector3f hand_m = (distance_m - kBefore_m) / along_m * point_m;
    if (along_m > distance_m - kBefore_m && hand_m.cross(ray).norm() < kHalfHand_m)
      point_m = hand_m;
  }
  return cloud;
}

TEST(StandingPeople, AreMostlyFoundBehindTheirOwnHands) {
  int found = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const ScannedPerson person = scanned_person("stand", seed);
    const std::vector<Segment> segments = segment(with_hand_before_face(person)).segments;
    found += std::any_of(segments.begin(), segments.end(),
                         [&](const Segment& s) {
                           return s.valid() && (s.seed_m - person.head_m()).norm() < 0.3F;
                         })
                 ? 1
                 : 0;
  }
  // By heads' shapes alone none is.
  EXPECT_GE(found, 4);
}

INSTANTIATE_TEST_SUITE_P(Simulated, StandingPerson, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace limbcast::segmenter
