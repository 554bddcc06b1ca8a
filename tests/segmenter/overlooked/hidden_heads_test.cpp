#include "modules/segmenter/overlooked/hidden_heads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "tests/segmenter/scene/drawn_scene.hpp"

namespace limbcast::segmenter {
namespace {

constexpr float kSensorHeight_m = 1.2F;
constexpr float kBackdrop_m = 5.0F;
constexpr float kEdge_m = 0.5F * kSceneWidth / kFocal_px * kBody_m;
/// Shoulders and soles against the sensor's height, and half the width of a trunk.
constexpr float kShoulder_m = 0.2F, kSole_m = -1.1F, kTrunk_m = 0.2F;

/// What a level camera over a known ground sees of a scene before a wall.
Lattice look_into_room(const DrawnScene& depth_at) {
  Lattice lattice = look_at([&](float right_m, float up_m) {
    const float z_m = depth_at(right_m, up_m);
    return z_m > 0.0F ? z_m : kBackdrop_m;
  });
  lattice.frame.ground_known = true;
  lattice.frame.sensor_height_m = kSensorHeight_m;
  for (Eigen::Vector3f& point : lattice.level_m) point.z() += kSensorHeight_m;
  return lattice;
}

/// A body without a head, its axis so far to the right.
bool on_body(float right_m, float up_m, float axis_m) {
  return std::abs(right_m - axis_m) < kTrunk_m && up_m < kShoulder_m && up_m > kSole_m;
}

FoundPeople nobody(const Lattice& lattice) {
  FoundPeople found;
  found.labels.assign(lattice.size(), kNobody);
  return found;
}

Surfaces surfaces_beside(const Lattice& lattice, const FoundPeople& found) {
  return find_surfaces(lattice, HiddenHeadParams{}.surface, &found.labels);
}

std::vector<HeadlessSurface> find(const Lattice& lattice, const FoundPeople& found) {
  return find_headless_surfaces(lattice, surfaces_beside(lattice, found), found, {});
}

std::vector<HeadlessSurface> find(const Lattice& lattice) { return find(lattice, nobody(lattice)); }

/// Half a body at the right edge of the image.
Lattice body_at_edge() {
  return look_into_room(
      [](float right_m, float up_m) { return on_body(right_m, up_m, kEdge_m) ? kBody_m : 0.0F; });
}

TEST(HiddenHeads, AreGuessedBeyondTheEdgeThatCutsABody) {
  const auto found = find(body_at_edge());
  ASSERT_EQ(found.size(), 1U);
  const Eigen::Vector3f& head_m = found[0].head.center_m;
  EXPECT_EQ(found[0].head.kind, SeedKind::kBody);
  EXPECT_GT(head_m.x(), kEdge_m - 0.05F);
  EXPECT_NEAR(head_m.y(), kBody_m, 0.2F);
  EXPECT_GT(head_m.z(), kSensorHeight_m + kShoulder_m);
}

TEST(HiddenHeads, AreNotGuessedWhereTheHeadWouldBeInSight) {
  const Lattice lattice = look_into_room(
      [](float right_m, float up_m) { return on_body(right_m, up_m, 0.0F) ? kBody_m : 0.0F; });
  EXPECT_TRUE(find(lattice).empty());
}

TEST(HiddenHeads, AreGuessedBehindWhoIsSurelyAPerson) {
  constexpr float kNearer_m = 2.0F;
  const Lattice lattice = look_into_room([](float right_m, float up_m) {
    if (std::abs(right_m) < 0.25F) return kNearer_m;
    return on_body(right_m, up_m, 0.2F) ? kBody_m : 0.0F;
  });
  FoundPeople found = nobody(lattice);
  HeadCandidate before;
  before.center_m = before.surface_m = {0.0F, kNearer_m, kSensorHeight_m + 0.4F};
  found.heads.push_back(before);
  found.person_odds.push_back(5.0F);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    if (lattice.depth_m[i] == kNearer_m) found.labels[i] = 0;
  }

  const auto behind = find(lattice, found);

  ASSERT_EQ(behind.size(), 1U);
  EXPECT_LT(behind[0].head.center_m.x(), 0.25F);
  EXPECT_NEAR(behind[0].head.center_m.y(), kBody_m, 0.2F);
  found.person_odds[0] = 0.0F;
  EXPECT_TRUE(find(lattice, found).empty());
}

TEST(HiddenHeads, AreNotGuessedOnThePlaceOfAnotherPerson) {
  const Lattice lattice = body_at_edge();
  FoundPeople found = nobody(lattice);
  found.heads.push_back(find(lattice).at(0).head);
  found.heads[0].center_m.z() -= 0.3F;
  found.person_odds.push_back(5.0F);
  EXPECT_TRUE(find(lattice, found).empty());
}

TEST(HiddenHeads, NeedTheGround) {
  Lattice lattice = body_at_edge();
  lattice.frame.ground_known = false;
  EXPECT_TRUE(find(lattice).empty());
}

TEST(HiddenHeads, LeaveOutWhatSomebodyHas) {
  const Lattice lattice = body_at_edge();
  FoundPeople found = nobody(lattice);
  const HeadlessSurface surface = find(lattice).at(0);
  for (const std::uint32_t i : surface.points) found.labels[i] = kUnsure;
  EXPECT_TRUE(find(lattice, found).empty());
}

TEST(BodyParts, OfAChildHaveItsHeadInSightAtTheirTop) {
  constexpr float kTop_m = 0.9F;
  const Lattice child = look_into_room([](float right_m, float up_m) {
    return std::abs(right_m) < 0.15F && up_m < kTop_m - kSensorHeight_m && up_m > kSole_m ? kBody_m
                                                                                          : 0.0F;
  });
  const FoundPeople found = nobody(child);
  const auto head_m = [&](const HiddenHeadParams& params) {
    return find_body_parts(child, surfaces_beside(child, found), found, params)
        .at(0)
        .head.center_m.z();
  };
  EXPECT_NEAR(head_m(kOverlookedBodies), kTop_m, 0.1F);
  EXPECT_FLOAT_EQ(head_m({}), 1.6F) << "of an adult's, out of sight";
}

/// Says the same of every point.
SurfaceClassifier always_surface(float odds) {
  Network network;
  network.hidden_weights = Network::Weights::Zero(1, kSurfaceInputSize);
  network.hidden_bias = Eigen::VectorXf::Zero(1);
  network.output_weights = Eigen::VectorXf::Zero(1);
  network.output_bias = odds;
  return SurfaceClassifier(network);
}

TEST(HeadlessPeople, AreThoseWhoseSurfaceIsABodys) {
  const Lattice lattice = body_at_edge();
  FoundPeople found = nobody(lattice);
  const HiddenHeadParams params;
  add_headless_people(lattice, surfaces_beside(lattice, found), always_surface(2.0F), params,
                      found);
  ASSERT_EQ(found.heads.size(), 1U);
  EXPECT_FLOAT_EQ(found.person_odds.at(0), 2.0F + params.place_odds);
  EXPECT_EQ(found.labels[index_at(lattice, kEdge_m - 0.1F, -0.2F)], 0);
  EXPECT_EQ(found.labels[index_at(lattice, 0.0F, -0.2F)], kNobody);
}

TEST(HeadlessPeople, AreRejectedWhereTheSurfaceIsNone) {
  const Lattice lattice = body_at_edge();
  FoundPeople found = nobody(lattice);
  const HiddenHeadParams params;
  const SurfaceClassifier wall = always_surface(params.min_body_odds - 0.5F);
  add_headless_people(lattice, surfaces_beside(lattice, found), wall, params, found);
  EXPECT_TRUE(found.heads.empty());
  ASSERT_EQ(found.rejected.size(), 1U);
  EXPECT_EQ(found.rejected[0].rejection.filter, SegmentFilter::kNotHeadShaped);
}

/// What is found of a surface whose depths tell nothing when the image shows this.
FoundPeople find_in_image(const Lattice& lattice, const BodyOpinion& opinion,
                          float depth_odds = 0.0F) {
  FoundPeople found = nobody(lattice);
  add_headless_people(lattice, surfaces_beside(lattice, found), always_surface(depth_odds), {},
                      found, opinion);
  return found;
}

/// Half of a body, whose head would be in sight.
Lattice part_in_sight() {
  return look_into_room([](float right_m, float up_m) {
    constexpr float kHangs_m = -0.3F;
    return std::abs(right_m) < kTrunk_m && up_m < kShoulder_m && up_m > kHangs_m ? kBody_m : 0.0F;
  });
}

TEST(HeadlessPeople, AreThoseWhomTheImageShowsWhetherTheirHeadIsInSightOrNot) {
  const Eigen::Vector3f head_m(0.1F, kBody_m + 0.05F, 1.65F);
  const auto somebody = [&](const HeadlessSurface&) {
    return SeenBody{head_m, /*score_odds=*/4.0F, /*visible_joints=*/10.0F};
  };
  EXPECT_TRUE(find(part_in_sight()).empty());
  const FoundPeople found = find_in_image(part_in_sight(), somebody);
  ASSERT_EQ(found.heads.size(), 1U);
  EXPECT_EQ(found.heads[0].kind, SeedKind::kBody);
  EXPECT_EQ(found.heads[0].center_m, head_m);
  EXPECT_EQ(found.labels[index_at(part_in_sight(), 0.0F, 0.0F)], 0);
}

TEST(HeadlessPeople, AreNoneWhereTheImageShowsNobody) {
  const auto nobody_there = [](const HeadlessSurface& surface) {
    return SeenBody{surface.head.center_m, /*score_odds=*/-4.0F, /*visible_joints=*/3.0F};
  };
  const FoundPeople found = find_in_image(body_at_edge(), nobody_there);
  EXPECT_TRUE(found.heads.empty());
  ASSERT_EQ(found.rejected.size(), 1U);
  EXPECT_EQ(found.rejected[0].rejection.filter, SegmentFilter::kNotHeadShaped);
}

TEST(HeadlessPeople, AreAskedForInTheImageWhereTheDepthsLeaveThemPossible) {
  int asked = 0;
  const auto count = [&](const HeadlessSurface&) -> std::optional<SeenBody> {
    ++asked;
    return std::nullopt;
  };
  find_in_image(part_in_sight(), count);
  EXPECT_EQ(asked, 1);
  find_in_image(part_in_sight(), count, HiddenHeadParams{}.min_part_odds - 0.1F);
  EXPECT_EQ(asked, 1);
  // Five posts in a row.
  const Lattice posts = look_into_room([](float right_m, float up_m) {
    const bool post = std::abs(std::remainder(right_m, 0.3F)) < 0.06F && std::abs(right_m) < 0.7F;
    return post && up_m < kShoulder_m && up_m > kSole_m ? kBody_m : 0.0F;
  });
  asked = 0;
  find_in_image(posts, count);
  EXPECT_EQ(asked, HiddenHeadParams{}.max_asked);
}

TEST(SurfaceClassifier, SeesAMirroredPointFromTheOtherSide) {
  const Lattice left =
      look_into_room([](float right_m, float) { return right_m < 0.3F ? kBody_m : 0.0F; });
  const Lattice right =
      look_into_room([](float right_m, float) { return right_m > -0.3F ? kBody_m : 0.0F; });
  // One pixel to the middle's left: the lattice has as many columns on both sides of it.
  const SurfaceInput seen = surface_input(left, index_at(left, 0.2F, 0.0F), false);
  const SurfaceInput mirrored = surface_input(right, index_at(right, -0.2F, 0.0F), true);
  for (Eigen::Index i = 0; i < seen.size(); ++i) EXPECT_NEAR(seen[i], mirrored[i], 1e-4F) << i;
}

}  // namespace
}  // namespace limbcast::segmenter
