#include "modules/segmenter/bodies/floating_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/segmenter/scene/drawn_scene.hpp"

namespace limbcast::segmenter {
namespace {

/// A level rectangle that faces the sensor.
struct Board {
  float left_m, right_m, bottom_m, top_m;
  float depth_m = kBody_m;

  bool covers(float right, float up) const {
    return right >= left_m && right < right_m && up >= bottom_m && up < top_m;
  }
};

constexpr Board kUpright{-0.2F, 0.2F, -0.6F, 0.85F};
constexpr Board kRaisedArm{0.4F, 0.7F, 0.45F, 0.53F};
constexpr float kHeadUp_m = 0.75F;

/// Somebody upright, whose label is 0, and an arm that hangs in the air beside.
class FloatingArm : public ::testing::Test {
 protected:
  void look() {
    boards_.insert(boards_.begin(), kUpright);
    lattice_ = look_at([&](float right, float up) {
      const auto board = std::find_if(boards_.begin(), boards_.end(),
                                      [&](const Board& b) { return b.covers(right, up); });
      return board == boards_.end() ? 0.0F : board->depth_m;
    });
    people_.heads = {head_at(lattice_, 0.0F, kHeadUp_m)};
    people_.labels.assign(lattice_.size(), kNobody);
    label(kUpright, 0);
  }
  void label(const Board& board, std::int16_t name) {
    visit(board, [&](std::size_t i) { people_.labels[i] = name; });
  }
  /// Label of all points of a board after arms were looked for; fails where they differ.
  std::int16_t label_of(const Board& board) {
    add_floating_arms(lattice_, params_, people_);
    std::vector<std::int16_t> labels;
    visit(board, [&](std::size_t i) { labels.push_back(people_.labels[i]); });
    EXPECT_EQ(std::count(labels.begin(), labels.end(), labels.at(0)),
              static_cast<std::ptrdiff_t>(labels.size()));
    return labels.at(0);
  }

  /// The same of a board that hangs there instead of the arm.
  std::int16_t label_alone(const Board& board) {
    boards_ = {board};
    look();
    return label_of(board);
  }

  std::vector<Board> boards_ = {kRaisedArm};
  Lattice lattice_;
  FoundPeople people_;
  FloatingArmParams params_;

 private:
  template <typename Visit>
  void visit(const Board& board, const Visit& each) {
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const Eigen::Vector3f& point_m = lattice_.level_m[i];
      // As drawn: measured at the body's depth.
      const float scale = kBody_m / std::max(lattice_.depth_m[i], 0.1F);
      if (lattice_.depth_m[i] == board.depth_m &&
          board.covers(point_m.x() * scale, point_m.z() * scale))
        each(i);
    }
  }
};

TEST_F(FloatingArm, IsThePersonsBesideWhomItHangs) {
  look();
  EXPECT_EQ(label_of(kRaisedArm), 0);
}

TEST_F(FloatingArm, IsTakenWhereTheDepthsLeftItUnsure) {
  look();
  label(kRaisedArm, kUnsure);
  EXPECT_EQ(label_of(kRaisedArm), 0);
}

TEST_F(FloatingArm, IsTheNearestPersons) {
  constexpr Board kNeighbor{0.85F, 0.9F, -0.6F, 0.85F};
  constexpr Board kArmOfTheFirst{0.3F, 0.55F, 0.2F, 0.28F},
      kArmOfTheOther{0.5F, 0.75F, 0.5F, 0.58F};
  boards_ = {kArmOfTheFirst, kArmOfTheOther, kNeighbor};
  look();
  people_.heads.push_back(head_at(lattice_, 0.87F, kHeadUp_m));
  label(kNeighbor, 1);
  EXPECT_EQ(label_of(kArmOfTheFirst), 0);
  EXPECT_EQ(label_of(kArmOfTheOther), 1);
}

TEST_F(FloatingArm, IsNoneNearOtherThings) {
  constexpr float kNear_m = FloatingArmParams{}.min_gap_m - 0.05F;
  boards_.push_back({0.4F, 0.7F, 0.53F + kNear_m, 0.6F + kNear_m});
  look();
  EXPECT_EQ(label_of(kRaisedArm), kNobody);
}

TEST_F(FloatingArm, IsThePersonsThoughStrayReturnsAreNear) {
  boards_.push_back({0.5F, 0.56F, 0.58F, 0.62F});
  look();
  EXPECT_EQ(label_of(kRaisedArm), 0);
}

TEST_F(FloatingArm, IsNobodysWhereASecondPersonIsTooNearToTell) {
  constexpr Board kNeighbor{0.85F, 0.9F, -0.6F, 0.85F};
  constexpr Board kBetween{0.3F, 0.55F, 0.2F, 0.28F};
  boards_ = {kBetween, kNeighbor};
  look();
  people_.heads.push_back(head_at(lattice_, 0.87F, kHeadUp_m));
  label(kNeighbor, 1);
  params_.max_from_rival_m = 0.6F;
  EXPECT_EQ(label_of(kBetween), kNobody);
}

TEST_F(FloatingArm, MayHangBeforeThingsThatStandFartherOff) {
  constexpr float kFar_m = FloatingArmParams{}.min_gap_m + 0.05F;
  boards_.push_back({0.4F, 0.7F, 0.53F + kFar_m, 0.6F + kFar_m});
  look();
  EXPECT_EQ(label_of(kRaisedArm), 0);
}

TEST_F(FloatingArm, IsNoneFarFromPeople) {
  constexpr float kFar_m = 0.2F + FloatingArmParams{}.max_from_person_m + 0.05F;
  EXPECT_EQ(label_alone({kFar_m, 0.9F, 0.45F, 0.53F}), kNobody);
}

TEST_F(FloatingArm, IsNoneFartherFromTheHeadThanAHandReaches) {
  constexpr Board kLongest{0.25F, 0.7F, 0.45F, 0.49F};
  ASSERT_EQ(label_alone(kLongest), 0);
  label(kLongest, kNobody);
  people_.heads[0].center_m.x() -= FloatingArmParams{}.max_head_distance_m - 0.6F;
  EXPECT_EQ(label_of(kLongest), kNobody);
}

TEST_F(FloatingArm, IsNoneFarBelowTheHead) {
  constexpr float kLow_m = kHeadUp_m - FloatingArmParams{}.max_below_head_m - 0.1F;
  EXPECT_EQ(label_alone({0.4F, 0.7F, kLow_m, kLow_m + 0.08F}), kNobody);
}

TEST_F(FloatingArm, IsNoLargerSurface) {
  EXPECT_EQ(label_alone({0.4F, 0.7F, 0.2F, 0.7F}), kNobody);
}

TEST_F(FloatingArm, IsNoStrayReturn) {
  EXPECT_EQ(label_alone({0.4F, 0.43F, 0.45F, 0.48F}), kNobody);
}

}  // namespace
}  // namespace limbcast::segmenter
