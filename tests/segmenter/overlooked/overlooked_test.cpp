#include "modules/segmenter/overlooked/overlooked.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/segmenter/seeds/seed_place.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/scene/drawn_scene.hpp"
#include "tests/segmenter/simulated_person.hpp"

namespace limbcast::segmenter {
namespace {

/// A figure that was found and two that were not, side by side before the sensor.
class RefusedHeads : public ::testing::Test {
 protected:
  RefusedHeads() {
    found_.labels.assign(lattice_.size(), kNobody);
    for (std::uint32_t i = 0; i < lattice_.size(); ++i) {
      if (lattice_.depth_m[i] > 0.0F && lattice_.level_m[i].x() < -0.3F) found_.labels[i] = 0;
    }
    found_.heads.push_back(head_at(lattice_, kFound_m, kHead_m));
  }

  static HeadCandidate as_likely(HeadCandidate head, float odds) {
    head.odds = odds;
    head.score = 2.0F;
    return head;
  }
  void refuse(const HeadCandidate& head, SegmentFilter filter = SegmentFilter::kNotHeadShaped) {
    found_.rejected.push_back({head, {filter, 0.1F, 0.3F}});
  }
  std::vector<HeadCandidate> overlooked() const { return find_overlooked(lattice_, found_, {}); }

  static constexpr float kFound_m = -0.7F, kFirst_m = 0.1F, kSecond_m = 0.7F, kHead_m = 0.8F;
  const Lattice lattice_ = look_at([](float right_m, float up_m) {
    const bool figure = std::abs(right_m - kFound_m) < 0.2F ||
                        std::abs(right_m - kFirst_m) < 0.2F || std::abs(right_m - kSecond_m) < 0.2F;
    return figure && up_m < 0.9F ? kBody_m : 0.0F;
  });
  const HeadCandidate first_ = as_likely(head_at(lattice_, kFirst_m, kHead_m), -3.0F);
  const HeadCandidate second_ = as_likely(head_at(lattice_, kSecond_m, kHead_m), -2.0F);
  FoundPeople found_;
};

TEST_F(RefusedHeads, AreAskedAboutTheLikeliestFirst) {
  refuse(first_);
  refuse(second_);
  const auto asked = overlooked();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0].u, second_.u);
  EXPECT_EQ(asked[1].u, first_.u);
}

TEST_F(RefusedHeads, AreNotAskedAboutOnSomebodyWhoWasFound) {
  refuse(as_likely(head_at(lattice_, kFound_m, kHead_m - 1.0F), -2.0F));
  EXPECT_TRUE(overlooked().empty());
}

TEST_F(RefusedHeads, AreNotAskedAboutBesideAHeadThatWasFound) {
  found_.heads.push_back(head_at(lattice_, kFirst_m, kHead_m - 0.4F));
  refuse(first_);
  EXPECT_TRUE(overlooked().empty());
}

TEST_F(RefusedHeads, AreAskedAboutWhereSomebodyWasFoundShoulderToShoulder) {
  found_.heads.push_back(head_at(lattice_, kFirst_m + 0.48F, kHead_m));
  refuse(first_);
  EXPECT_EQ(overlooked().size(), 1U);
}

TEST_F(RefusedHeads, AreAskedAboutOnceWhereTwoAreOneFigures) {
  refuse(first_);
  refuse(as_likely(head_at(lattice_, kFirst_m, kHead_m - 0.2F), -4.0F));
  EXPECT_EQ(overlooked().size(), 1U);
}

TEST_F(RefusedHeads, AreNotAskedAboutWhereNothingSpeaksForThem) {
  refuse(as_likely(first_, -8.5F));
  HeadCandidate shapeless = second_;
  shapeless.score = 1.0F;
  refuse(shapeless);
  EXPECT_TRUE(overlooked().empty());
}

TEST_F(RefusedHeads, AreAskedAboutWhereTheirClusterWentOnIntoAWall) {
  refuse(first_, SegmentFilter::kTooManyPoints);
  refuse(second_, SegmentFilter::kSeedNotHead);
  EXPECT_EQ(overlooked().size(), 2U);
}

TEST_F(RefusedHeads, AreNotAskedAboutWhereAnotherFilterEndedThem) {
  refuse(first_, SegmentFilter::kSamePerson);
  EXPECT_TRUE(overlooked().empty());
}

/// Candidates that were refused as parts of the figure that was found.
class MergedHeads : public RefusedHeads {
 protected:
  void merge(HeadCandidate head, float odds = 0.0F) {
    head.odds = odds;
    refuse(head, SegmentFilter::kSamePerson);
  }
  std::vector<HeadCandidate> merged() const { return find_merged(lattice_, found_, {}); }
};

TEST_F(MergedHeads, AreAskedAbout) {
  merge(first_);
  const auto asked = merged();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].u, first_.u);
}

TEST_F(MergedHeads, AreNotAskedAboutBehindAHeadThatHidesThem) {
  HeadCandidate behind = found_.heads[0];
  behind.center_m.y() += 0.5F;
  merge(behind);
  EXPECT_TRUE(merged().empty());
}

TEST_F(MergedHeads, AreNotAskedAboutWhereNothingSpeaksForThem) {
  merge(first_, -2.0F);
  refuse(second_, SegmentFilter::kNotHeadShaped);
  EXPECT_TRUE(merged().empty());
}

/// What a segmenter finds that takes no head for one by the depths around it.
class HeadsThatLookLikeNone : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  static Params strict() {
    Params params;
    params.classifier.min_head_odds = 100.0F;
    params.overlooked.min_head_odds = -100.0F;
    // Of all candidates only the likeliest: the limit of their log odds, too, keeps the others out.
    params.overlooked.max_asked = 3;
    params.overlooked.head_odds = 101.0F;
    // The other ways to people whose heads are not told.
    params.overlooked_bodies.max_asked = 0;
    params.hidden_heads.min_body_odds = 100.0F;
    return params;
  }
  /// Somebody so near that the image ends below the head.
  static simulate::SimulatorParams near_person_without_head() {
    auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
    scene.scenario.head_above_share = 1.0;
    scene.scenario.min_distance_m = 0.9;
    scene.scenario.max_distance_m = 2.0;
    scene.scenario.min_camera_height_m = scene.scenario.max_camera_height_m = 0.8;
    return scene;
  }
  static std::size_t count_people(const simulate::SimulatorParams& scene, std::uint64_t seed,
                                  const Params& params) {
    const Segments found =
        segment(depth_cloud(scene, simulate::simulate_frame(scene, seed, 0)), params);
    return static_cast<std::size_t>(
        std::count_if(found.segments.begin(), found.segments.end(),
                      [](const Segment& segment) { return segment.valid(); }));
  }
};

TEST_P(HeadsThatLookLikeNone, AreToldByTheWholeBodyInDepths) {
  const auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
  EXPECT_EQ(count_people(scene, GetParam(), strict()), 1U);
  Params nobody_asked = strict();
  nobody_asked.overlooked.max_asked = 0;
  EXPECT_EQ(count_people(scene, GetParam(), nobody_asked), 0U);
}

TEST_P(HeadsThatLookLikeNone, NeedLessOfABodyWhereTheDepthsAroundThemNearlyTellThem) {
  const auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
  Params nearly = strict();
  nearly.overlooked.min_person_odds = 100.0F;
  nearly.overlooked.min_likely_head_odds = -100.0F;
  EXPECT_EQ(count_people(scene, GetParam(), nearly), 1U);
  Params not_at_the_mark = nearly;
  not_at_the_mark.overlooked.max_likely_error_m = 0.0F;
  EXPECT_EQ(count_people(scene, GetParam(), not_at_the_mark), 0U);
  Params unlikely = nearly;
  unlikely.overlooked.min_likely_head_odds = 100.0F;
  EXPECT_EQ(count_people(scene, GetParam(), unlikely), 0U);
}

TEST_P(HeadsThatLookLikeNone, AreToldByASurfaceThatNobodyHas) {
  const auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
  Params no_heads_asked = strict();
  no_heads_asked.overlooked.max_asked = 0;
  no_heads_asked.overlooked_bodies = kOverlookedBodies;
  EXPECT_EQ(count_people(scene, GetParam(), no_heads_asked), 1U);
}

TEST_P(HeadsThatLookLikeNone, AreToldByTheBodyWhereTheyAreAboveTheImage) {
  const auto scene = near_person_without_head();
  Params no_heads_asked = strict();
  no_heads_asked.overlooked.max_asked = 0;
  EXPECT_EQ(count_people(scene, GetParam(), no_heads_asked), 0U);
  no_heads_asked.overlooked_bodies = kOverlookedBodies;
  EXPECT_EQ(count_people(scene, GetParam(), no_heads_asked), 1U);
}

TEST_P(HeadsThatLookLikeNone, AreNotMadeOfFurniture) {
  simulate::SimulatorParams room = person_in_sight(simulate::SensorKind::kDepth, "hang");
  room.scenario.set = simulate::SetKind::kNoHuman;
  Params all_asked = strict();
  all_asked.overlooked_bodies = kOverlookedBodies;
  EXPECT_EQ(count_people(room, GetParam(), all_asked), 0U);
}

class HeadsOutOfSight : public HeadsThatLookLikeNone {};

TEST_P(HeadsOutOfSight, AreNotToldByCandidatesThatNothingElseSpeaksFor) {
  const auto scene = near_person_without_head();
  Params unlikely = strict();
  unlikely.overlooked.min_unseen_head_odds = 100.0F;
  EXPECT_EQ(count_people(scene, GetParam(), unlikely), 0U);
  unlikely.overlooked.min_head_visibility = 0.0F;
  EXPECT_EQ(count_people(scene, GetParam(), unlikely), 1U);
}

/// How many of the true people in sight have a segment that began at their heads.
std::ptrdiff_t count_found(const Cloud& cloud, const simulate::SimulatedFrame& frame,
                           const Params& params) {
  constexpr float kSameHead_m = 0.2F;
  const Segments found = segment(cloud, params);
  return std::count_if(
      frame.scenario.persons.begin(), frame.scenario.persons.end(),
      [&](const simulate::Person& person) {
        const Eigen::Vector3f head_m = person.skeleton[Joint::kHead].cast<float>();
        return std::any_of(found.segments.begin(), found.segments.end(),
                           [&](const Segment& segment) {
                             return segment.valid() &&
                                    (behind_surface(segment.seed_m) - head_m).norm() < kSameHead_m;
                           });
      });
}

/// Groups of five, two of whom touch.
class PeopleWhoTouch : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(PeopleWhoTouch, AreFoundWhereOneWasTakenForAPartOfTheOther) {
  auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
  scene.scenario.set = simulate::SetKind::kMulti;
  const simulate::SimulatedFrame frame = simulate::simulate_frame(scene, GetParam(), 0);
  const Cloud cloud = depth_cloud(scene, frame);
  Params nobody_asked;
  nobody_asked.overlooked.min_merged_odds = 100.0F;
  // The other way asks about people who stand shoulder to shoulder.
  nobody_asked.overlooked.min_distance_m = 0.6F;
  EXPECT_EQ(count_found(cloud, frame, {}), count_found(cloud, frame, nobody_asked) + 1);
}

class PeopleWhoTouchInFullSight : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(PeopleWhoTouchInFullSight, AreAllFound) {
  auto scene = person_in_sight(simulate::SensorKind::kDepth, "hang");
  scene.scenario.set = simulate::SetKind::kMulti;
  const simulate::SimulatedFrame frame = simulate::simulate_frame(scene, GetParam(), 0);
  EXPECT_EQ(count_found(depth_cloud(scene, frame), frame, {}), 5);
}

/// How many who bow, of eight seeds from this one on, have a segment that began at their heads.
std::ptrdiff_t count_found_who_bow(std::uint64_t first_seed, const Params& params) {
  const auto scene = person_in_sight(simulate::SensorKind::kDepth, "bow");
  constexpr std::uint64_t kPeople = 8;
  std::ptrdiff_t found = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + kPeople; ++seed) {
    const simulate::SimulatedFrame frame = simulate::simulate_frame(scene, seed, 0);
    found += count_found(depth_cloud(scene, frame), frame, params);
  }
  return found;
}

TEST(PeopleWhoBend, AreFoundWhereTheirHeadsStandBeforeTheirTrunks) {
  EXPECT_GE(count_found_who_bow(1, {}), 7);  // the network of upright people alone tells of two
}

TEST(PeopleWhoBend, AreFoundByTheirHeadsWhereTheirBacksAreAskedAbout) {
  constexpr std::uint64_t kFirstSeed = 10;
  Params seeds_stay;
  seeds_stay.split_bodies.min_moved_m = std::numeric_limits<float>::infinity();
  EXPECT_EQ(count_found_who_bow(kFirstSeed, seeds_stay), 8);
  seeds_stay.overlooked.min_moved_m = std::numeric_limits<float>::infinity();
  EXPECT_LE(count_found_who_bow(kFirstSeed, seeds_stay), 4);
}

INSTANTIATE_TEST_SUITE_P(Simulated, PeopleWhoTouch, ::testing::Values(13, 62));
INSTANTIATE_TEST_SUITE_P(Simulated, PeopleWhoTouchInFullSight, ::testing::Values(13, 41));
INSTANTIATE_TEST_SUITE_P(Simulated, HeadsOutOfSight, ::testing::Values(2, 10, 23));
INSTANTIATE_TEST_SUITE_P(Simulated, HeadsThatLookLikeNone, ::testing::Values(1, 3, 6));

}  // namespace
}  // namespace limbcast::segmenter
