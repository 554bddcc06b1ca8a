#include "modules/segmenter/overlooked/image_opinion.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

/// Of the demo log's first frame and the person in it.
class OpinionOfTheDemo : public ::testing::Test {
 protected:
  /// A surface with its head at a place of the cloud's frame.
  HeadlessSurface surface_under(const Eigen::Vector3f& head_m) const {
    HeadlessSurface surface;
    surface.head.center_m = scene_.lattice.frame.to_level(head_m);
    return surface;
  }

  /// Labels of the lattice where all that is within reach of the person has this one.
  std::vector<std::int16_t> labels_of_persons_place(std::int16_t label) const {
    constexpr float kReach_m = 1.0F;
    std::vector<std::int16_t> labels(scene_.lattice.size(), kNobody);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Eigen::Vector3f from_head_m = scene_.lattice.level_m[i] - person_.head.center_m;
      if (from_head_m.head<2>().norm() < kReach_m) labels[i] = label;
    }
    return labels;
  }

  const Params params_{};
  const ImageOpinion image_{params_};
  const test::DemoFrame& frame_ = test::demo_frame();
  const Scene scene_ = look_at(frame_.cloud, params_);
  const Eigen::Vector3f head_m_ = frame_.truth.persons.at(0)[Joint::kHead].position_m;
  const HeadlessSurface person_ = surface_under(head_m_);
};

TEST_F(OpinionOfTheDemo, MarksTheHeadOfABody) {
  constexpr float kNear_m = 0.10F;
  const FoundPeople nobody{{}, {}, labels_of_persons_place(kNobody), {}};
  const SeenBody seen = image_.body_opinion(scene_, nobody)(person_).value();
  EXPECT_LT((scene_.lattice.frame.to_sensor(seen.head_m) - head_m_).norm(), kNear_m);
  EXPECT_GT(seen.score_odds, 2.0F);
  EXPECT_GT(seen.visible_joints, 10.0F) << "of 13, all in sight";
}

TEST_F(OpinionOfTheDemo, IsOfPeopleAsTheyAreWhenItIsAsked) {
  FoundPeople people{{}, {}, labels_of_persons_place(kNobody), {}};
  const BodyOpinion opinion = image_.body_opinion(scene_, people);
  const float free_odds = opinion(person_)->score_odds;
  people.labels = labels_of_persons_place(0);
  EXPECT_LT(opinion(person_)->score_odds, free_odds - 2.0F)
      << "somebody else's: painted over, but for what is not measured";
  people.labels = labels_of_persons_place(kNobody);
  EXPECT_EQ(opinion(person_)->score_odds, free_odds);
}

TEST_F(OpinionOfTheDemo, IsNoneWithoutColors) {
  Cloud colorless = frame_.cloud;
  colorless.colors.clear();
  const Scene scene = look_at(colorless, params_);
  EXPECT_FALSE(image_.head_opinion(scene));
  EXPECT_FALSE(image_.body_opinion(scene, {}));
}

TEST_F(OpinionOfTheDemo, IsNoneWhereTheNetworkIsOff) {
  Params params;
  params.pose_network.enabled = false;
  const ImageOpinion image(params);
  EXPECT_FALSE(image.head_opinion(scene_));
  EXPECT_FALSE(image.body_opinion(scene_, {}));
}

}  // namespace
}  // namespace limbcast::segmenter
