#include "modules/segmenter/people_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/classifiers/constant_classifier.hpp"
#include "tests/segmenter/scene/drawn_scene.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

/// A head and shoulders before a far wall; what the depths tell of them is up to the test.
class UnsureHeads : public ::testing::Test {
 protected:
  /// Log odds of the head after the opinion was asked, if it is among the likely ones.
  std::optional<float> odds_of_head(float by_depths, const HeadOpinion& opinion) {
    std::vector<RejectedHead> rejected;
    const auto heads =
        likely_heads(lattice_, {head_}, constant_classifier(by_depths), params_, rejected, opinion);
    EXPECT_EQ(heads.size() + rejected.size(), 1U);
    return heads.empty() ? std::nullopt : std::optional(heads[0].odds);
  }
  HeadOpinion always(std::optional<float> odds) {
    return [this, odds](const HeadCandidate&) {
      ++asked_;
      return odds;
    };
  }

  const ClassifierParams params_{};
  const Lattice lattice_ = look_at([](float right_m, float up_m) {
    return std::abs(right_m) < 0.2F && up_m < 0.9F ? kBody_m : 0.0F;
  });
  const HeadCandidate head_ = head_at(lattice_, 0.0F, 0.8F);
  int asked_ = 0;
};

TEST_F(UnsureHeads, AreTakenByTheImageWhereTheDepthsAreUnsure) {
  const float unlikely = params_.min_head_odds - 0.5F;
  EXPECT_FALSE(odds_of_head(unlikely, {}));
  EXPECT_EQ(odds_of_head(unlikely, always(2.0F)), 2.0F);
}

TEST_F(UnsureHeads, AreLeftOutWhereTheImageShowsNone) {
  const float likely = 0.5F * (params_.min_head_odds + params_.sure_head_odds);
  EXPECT_EQ(odds_of_head(likely, {}), likely);
  EXPECT_FALSE(odds_of_head(likely, always(-3.0F)));
}

TEST_F(UnsureHeads, KeepWhatTheDepthsTellWhereTheImageTellsNothing) {
  const float likely = 0.5F * (params_.min_head_odds + params_.sure_head_odds);
  EXPECT_EQ(odds_of_head(likely, always(std::nullopt)), likely);
}

TEST_F(UnsureHeads, AreNotAskedTheImageForWhereTheDepthsAreSure) {
  odds_of_head(params_.sure_head_odds + 0.1F, always(-3.0F));
  odds_of_head(params_.min_asked_odds - 0.1F, always(3.0F));
  EXPECT_EQ(asked_, 0);
}

TEST_F(UnsureHeads, AreAskedTheImageForOnceAPerson) {
  std::vector<RejectedHead> rejected;
  const HeadCandidate beside = head_at(lattice_, 0.5F * params_.separation_m, 0.8F);
  const auto heads = likely_heads(lattice_, {head_, beside}, constant_classifier(0.0F), params_,
                                  rejected, always(1.0F));
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(heads.size(), 1U);
}

/// How many people one body is with a sure head and another seed below it, with these log odds of
/// being a head, each of whose clusters looks like a person.
std::size_t people_with_seed_below_head(float odds) {
  constexpr float kSure = 3.0F;
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return std::abs(right_m) < 0.2F && up_m < 0.9F ? kBody_m : 0.0F;
  });
  HeadCandidate head = head_at(lattice, 0.0F, 0.8F), below = head_at(lattice, 0.0F, 0.4F);
  // The odds of such seeds are their own.
  head.told_by_body = below.told_by_body = true;
  head.odds = kSure + 0.1F;
  below.odds = odds;
  const BodyClassifier all_bodies(constant_network(kSure, kPointInputSize));
  return find_people(lattice, {head, below}, constant_classifier(kSure), all_bodies, {})
      .heads.size();
}

TEST(Rivals, AreNoLikelierPeopleThanTheyAreHeads) {
  const ClassifierParams params;
  EXPECT_EQ(people_with_seed_below_head(params.sure_head_odds + 0.1F), 1U);
  EXPECT_EQ(people_with_seed_below_head(params.rival_odds + 1.0F), 2U);
}

/// The person of the demo log's first frame, whose head is sought in the image however sure it is.
class DemoPerson : public ::testing::Test {
 protected:
  DemoPerson() {
    constexpr float kAll = 1e3F;
    params_.classifier.min_asked_odds = -kAll;
    params_.classifier.sure_head_odds = kAll;
    params_.classifier.max_asked = 100;
  }
  /// People who were found by their heads.
  long found() const {
    const Segments segments = segment(test::demo_frame().cloud, params_);
    return std::count_if(segments.segments.begin(), segments.segments.end(), [](const Segment& s) {
      return s.valid() && s.seed_kind == SeedKind::kHeadShape;
    });
  }

  Params params_;
};

TEST_F(DemoPerson, IsAHeadInTheImageToo) { EXPECT_EQ(found(), 1); }

TEST_F(DemoPerson, IsNoHeadWhereTheImageShowsNone) {
  constexpr float kNever = -100.0F;
  params_.pose_network.base_odds = kNever;
  EXPECT_EQ(found(), 0);
}

}  // namespace
}  // namespace limbcast::segmenter
