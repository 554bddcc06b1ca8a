#include "modules/segmenter/growing/joint_growing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/segmenter/scene/drawn_scene.hpp"

namespace limbcast::segmenter {
namespace {

/// A board as wide as a trunk, from its head at 0.8 m down to -1 m, in front of nothing.
float board(float right_m, float up_m) {
  return std::abs(right_m) < 0.2F && up_m < 0.9F && up_m > -1.0F ? kBody_m : 0.0F;
}

/// The same, with a bar of 20 cm before its neck.
float board_behind_bar(float right_m, float up_m) {
  return up_m < 0.6F && up_m > 0.4F ? kBody_m - 0.4F : board(right_m, up_m);
}

std::vector<std::int16_t> labels_of(const Lattice& lattice,
                                    const std::vector<HeadCandidate>& heads) {
  return grow_together(lattice, heads, {}, {});
}

TEST(JointGrowth, TakesTheSurfaceOfItsHead) {
  const Lattice lattice = look_at(board);
  const auto labels = labels_of(lattice, {head_at(lattice, 0.0F, 0.8F)});
  EXPECT_EQ(labels[index_at(lattice, 0.1F, -0.9F)], 0);
}

TEST(JointGrowth, GoesOnBehindWhatHidesABody) {
  const Lattice lattice = look_at(board_behind_bar);
  const auto labels = labels_of(lattice, {head_at(lattice, 0.0F, 0.8F)});
  EXPECT_EQ(labels[index_at(lattice, 0.1F, -0.9F)], 0);
  EXPECT_EQ(labels[index_at(lattice, 0.1F, 0.5F)], kNobody) << "the bar is no part of the body";
}

TEST(JointGrowth, StopsBehindSomethingWiderThanABody) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return up_m < 0.6F && up_m > 0.0F ? kBody_m - 0.4F : board(right_m, up_m);
  });
  const auto labels = labels_of(lattice, {head_at(lattice, 0.0F, 0.8F)});
  EXPECT_EQ(labels[index_at(lattice, 0.1F, -0.9F)], kNobody);
}

TEST(JointGrowth, DoesNotGoOnToAWall) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return up_m < 0.4F ? kBody_m + 0.1F : board_behind_bar(right_m, up_m);
  });
  JointGrowingParams params;
  params.max_part_m2 = 1.0F;  // the view holds 1.8 m of the wall
  const auto labels = grow_together(lattice, {head_at(lattice, 0.0F, 0.8F)}, params, {});
  EXPECT_EQ(labels[index_at(lattice, 0.0F, 0.0F)], kNobody);
}

TEST(JointGrowth, PartsTwoWhoTouchBetweenTheirHeads) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return std::abs(right_m) < 0.6F ? board(0.0F, up_m) : 0.0F;
  });
  const auto labels =
      labels_of(lattice, {head_at(lattice, -0.3F, 0.8F), head_at(lattice, 0.3F, 0.8F)});
  EXPECT_EQ(labels[index_at(lattice, -0.1F, -0.5F)], 0);
  EXPECT_EQ(labels[index_at(lattice, 0.1F, -0.5F)], 1);
}

TEST(JointGrowth, DroppedHeadLeavesWhatGrowsWithoutIt) {
  const Lattice lattice = look_at(board_behind_bar);
  const std::vector<HeadCandidate> heads = {head_at(lattice, 0.0F, 0.8F),
                                            head_at(lattice, 0.1F, -0.2F)};
  JointGrowth growth(lattice, heads, {}, {});
  ASSERT_EQ(growth.labels()[index_at(lattice, 0.1F, -0.9F)], 1);

  EXPECT_EQ(growth.drop(1), std::vector<std::int16_t>{0});

  EXPECT_EQ(growth.labels(), labels_of(lattice, {heads[0]}));
}

TEST(JointGrowth, TakesADropBack) {
  const Lattice lattice = look_at(board_behind_bar);
  JointGrowth growth(lattice, {head_at(lattice, 0.0F, 0.8F), head_at(lattice, 0.1F, -0.2F)}, {},
                     {});
  const std::vector<std::int16_t> before = growth.labels();
  growth.drop(1);
  ASSERT_NE(growth.labels(), before);

  growth.undo_drop();

  EXPECT_EQ(growth.labels(), before);
  EXPECT_FALSE(growth.dropped(1));
  growth.drop(1);
  EXPECT_EQ(growth.labels(), labels_of(lattice, {head_at(lattice, 0.0F, 0.8F)}));
}

TEST(JointGrowth, RemembersEachWayBehindWhatHidesABodyOnce) {
  const Lattice lattice = look_at(board_behind_bar);
  std::vector<HeadCandidate> heads;
  for (const float up_m : {0.8F, 0.2F, 0.0F, -0.2F, -0.4F})
    heads.push_back(head_at(lattice, 0.0F, up_m));
  JointGrowth growth(lattice, heads, {}, {});

  for (std::int16_t head = 1; head < 5; ++head) growth.drop(head);

  // Were they told again with each drop, they would grow without bounds where many heads are none.
  EXPECT_EQ(growth.bridge_count(), JointGrowth(lattice, {heads[0]}, {}, {}).bridge_count());
}

TEST(JointGrowth, TellsThePointsThatADropFreed) {
  const Lattice lattice = look_at(board_behind_bar);
  JointGrowth growth(lattice, {head_at(lattice, 0.0F, 0.8F), head_at(lattice, 0.1F, -0.2F)}, {},
                     {});
  const auto had = std::count(growth.labels().begin(), growth.labels().end(), 1);

  growth.drop(1);

  EXPECT_EQ(static_cast<std::ptrdiff_t>(growth.freed().size()), had);
}

TEST(JointGrowth, DroppedHeadLeavesClustersOutOfItsReachAlone) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return right_m < -0.3F || right_m > 0.3F ? board(0.0F, up_m) : 0.0F;
  });
  JointGrowth growth(lattice, {head_at(lattice, -0.6F, 0.8F), head_at(lattice, 0.6F, 0.8F)}, {},
                     {});
  EXPECT_TRUE(growth.drop(0).empty());
  EXPECT_EQ(growth.labels()[index_at(lattice, -0.6F, 0.0F)], kNobody);
}

}  // namespace
}  // namespace limbcast::segmenter
