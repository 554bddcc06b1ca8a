#include "modules/segmenter/bodies/body_cut.hpp"

#include <gtest/gtest.h>

#include <set>

#include "modules/segmenter/people_search.hpp"
#include "tests/segmenter/classifiers/constant_classifier.hpp"
#include "tests/segmenter/scene/drawn_scene.hpp"

namespace limbcast::segmenter {
namespace {

constexpr std::int16_t kPerson = 0;

/// A column of a body under a head at 0.8 m, with a seat of some width at its right side.
Lattice body_with_seat(float seat_width_m) {
  return look_at([seat_width_m](float right_m, float up_m) {
    const bool body = std::abs(right_m) < 0.2F && up_m < 0.92F && up_m > -0.6F;
    const bool seat =
        right_m >= 0.2F && right_m < 0.2F + seat_width_m && up_m < 0.2F && up_m > -0.5F;
    return body || seat ? kBody_m : 0.0F;
  });
}

/// Number of the offset to the right among the inputs of a point: the first behind the grids.
constexpr Eigen::Index kOffsetInput = kPointInputSize - kPointPlaceSize;

/// Takes what lies farther to the right than `border_m` for another thing, the surer the farther:
/// log odds of -1 at 4 cm, -2 at 12 cm beyond.
BodyClassifier parted_at(float border_m) {
  constexpr float kOffsetScale_m = 0.5F, kRange_m = 0.2F, kMostOdds = 6.0F;
  Network network;
  network.hidden_weights = Network::Weights::Zero(1, kPointInputSize);
  network.hidden_weights(0, kOffsetInput) = kOffsetScale_m / kRange_m;
  network.hidden_bias = Eigen::VectorXf::Constant(1, -border_m / kRange_m);
  network.output_weights = Eigen::VectorXf::Constant(1, -kMostOdds);
  return BodyClassifier(network);
}

struct Cut {
  std::vector<std::int16_t> labels;
  std::set<std::uint32_t> unsure;
};

Cut cut(const Lattice& lattice, float border_m) {
  const HeadCandidate head = head_at(lattice, 0.0F, 0.8F);
  JointGrowth growth(lattice, {head}, {}, {});
  const auto unsure = cut_to_bodies(lattice, parted_at(border_m), {}, growth);
  return {growth.labels(), {unsure.begin(), unsure.end()}};
}

TEST(BodyCut, TakesTheSeatAwayAndLeavesTheBody) {
  const Lattice lattice = body_with_seat(0.6F);
  const Cut left = cut(lattice, 0.2F);
  EXPECT_EQ(left.labels[index_at(lattice, 0.6F, 0.0F)], kNobody);
  EXPECT_EQ(left.labels[index_at(lattice, 0.1F, 0.0F)], kPerson);
  EXPECT_EQ(left.labels[index_at(lattice, 0.0F, 0.8F)], kPerson);
}

TEST(BodyCut, LeavesABodyWholeThatTouchesLittle) {
  // 0.1 m x 0.7 m are less than 0.15 m^2.
  const Lattice lattice = body_with_seat(0.1F);
  const Cut left = cut(lattice, 0.2F);
  EXPECT_EQ(left.labels[index_at(lattice, 0.28F, 0.0F)], kPerson);
  EXPECT_TRUE(left.unsure.empty());
}

TEST(BodyCut, NamesWhatMayBeABodyAllTheSame) {
  const Lattice lattice = body_with_seat(0.6F);
  const Cut left = cut(lattice, 0.2F);
  EXPECT_EQ(left.unsure.count(index_at(lattice, 0.28F, 0.0F)), 1U);
  EXPECT_EQ(left.unsure.count(index_at(lattice, 0.6F, 0.0F)), 0U);
  EXPECT_EQ(left.unsure.count(index_at(lattice, 0.0F, 0.0F)), 0U);
}

TEST(BodyCut, NamesWhatHangsOnCutPointsAlone) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    const bool body = std::abs(right_m) < 0.2F && up_m < 0.92F && up_m > -0.6F;
    const bool seat = right_m <= -0.2F && right_m > -0.8F && up_m < 0.2F && up_m > -0.5F;
    return body || seat ? kBody_m : 0.0F;
  });
  // Right of the border everything is cut, head and trunk too; what lies left of it would be kept.
  const Cut left = cut(lattice, -0.35F);
  EXPECT_EQ(left.labels[index_at(lattice, -0.6F, 0.0F)], kNobody);
  EXPECT_EQ(left.unsure.count(index_at(lattice, -0.6F, 0.0F)), 1U);
}

TEST(FindPeople, LeavesOutAHeadWhoseClusterIsNearlyAllOtherThings) {
  const Lattice lattice = body_with_seat(0.6F);
  const HeadCandidate head = head_at(lattice, 0.0F, 0.8F);
  const HeadClassifier sure = constant_classifier(5.0F);
  const BodyClassifier a_body = parted_at(0.2F);
  const BodyClassifier a_wall = parted_at(-0.15F);
  EXPECT_EQ(find_people(lattice, {head}, sure, a_body, {}).heads.size(), 1U);
  const FoundPeople found = find_people(lattice, {head}, sure, a_wall, {});
  EXPECT_TRUE(found.heads.empty());
  ASSERT_EQ(found.rejected.size(), 1U);
  EXPECT_LT(found.rejected[0].rejection.figure, 0.2F);
}

TEST(FindPeople, KeepsABodyThatWasSeenWhateverIsCutOffWithIt) {
  const Lattice lattice = body_with_seat(0.6F);
  HeadCandidate head = head_at(lattice, 0.0F, 0.8F);
  head.odds = 5.0F;
  head.told_by_body = true;
  const BodyClassifier a_wall = parted_at(-0.15F);
  EXPECT_EQ(find_people(lattice, {head}, constant_classifier(5.0F), a_wall, {}).heads.size(), 1U);
}

TEST(BodyClassifier, SeesAMirroredPointFromTheOtherSide) {
  const Lattice left =
      look_at([](float right_m, float) { return right_m < 0.3F ? kBody_m : 0.0F; });
  const Lattice right =
      look_at([](float right_m, float) { return right_m > -0.3F ? kBody_m : 0.0F; });
  const HeadCandidate head = head_at(left, 0.0F, 0.8F);
  // One pixel to the middle's left: the lattice has as many columns on both sides of it.
  const auto at_left = index_at(left, 0.2F, 0.0F), at_right = index_at(right, -0.2F, 0.0F);
  const auto seen = point_input(left, head, at_left, false);
  const auto mirrored = point_input(right, head, at_right, true);
  ASSERT_EQ(seen.size(), mirrored.size());
  for (Eigen::Index i = 0; i < seen.size(); ++i) EXPECT_NEAR(seen[i], mirrored[i], 1e-4F) << i;
}

TEST(Network, TellsTheSameOfManyInputsAsOfEach) {
  Network network;
  network.hidden_weights.resize(2, 3);
  network.hidden_weights << 0.5F, -1.0F, 2.0F, 1.0F, 0.25F, -0.5F;
  network.hidden_bias = Eigen::VectorXf::LinSpaced(2, 0.1F, -0.2F);
  network.output_weights = Eigen::VectorXf::LinSpaced(2, 1.5F, -2.0F);
  network.output_bias = 0.3F;
  Network::Weights inputs(2, 3);
  inputs << 1.0F, 2.0F, 3.0F, -1.0F, 0.0F, 0.5F;
  const Eigen::VectorXf odds = network.log_odds(inputs);
  EXPECT_FLOAT_EQ(odds[0], network.log_odds(std::vector<float>{1.0F, 2.0F, 3.0F}));
  EXPECT_FLOAT_EQ(odds[1], network.log_odds(std::vector<float>{-1.0F, 0.0F, 0.5F}));
}

}  // namespace
}  // namespace limbcast::segmenter
