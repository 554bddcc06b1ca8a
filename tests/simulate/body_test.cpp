#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/units.hpp"
#include "modules/simulate/body_surface.hpp"
#include "modules/simulate/posture_parts.hpp"
#include "modules/simulate/postures.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;

double distance(const Skeleton& skeleton, Joint a, Joint b) {
  return (skeleton[a] - skeleton[b]).norm();
}

TEST(Body, IsTheSameForTheSameSeed) {
  Rng first(7);
  Rng second(7);

  EXPECT_EQ(draw_body(first).stature_m, draw_body(second).stature_m);
}

TEST(Body, WearsACoatOverTheSameBody) {
  BodyParams coats;
  coats.coat_share = 1.0;
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(seed), same(seed);
    const BodyShape without = draw_body(rng), with = draw_body(same, coats);

    EXPECT_EQ(with.stature_m, without.stature_m);
    EXPECT_GE(with.clothes.torso_m, 0.02 * without.stature_m / 1.75);
    EXPECT_EQ(with.clothes.sleeve, Sleeve::kLong);
  }
}

TEST(Body, StandsAsTallAsItsStature) {
  for (int seed = 0; seed < 30; ++seed) {
    Rng rng(seed);
    const BodyShape body = draw_body(rng);
    const Skeleton skeleton = make_skeleton(body, Posture{}, {});

    // The neck leans forward and the knees are not quite straight: up to 2 % is lost.
    EXPECT_NEAR(skeleton.head_top.y() / body.stature_m, 0.99, 0.02) << seed;
  }
}

TEST(Body, HasTheRatiosOfTheRenderedBodies) {
  double upper_arm = 0.0;
  double forearm = 0.0;
  double shoulders = 0.0;
  constexpr int kBodies = 200;
  BodyParams adults;
  adults.child_share = 0.0;
  for (int seed = 0; seed < kBodies; ++seed) {
    Rng rng(seed);
    const BodyShape body = draw_body(rng, adults);
    upper_arm += body.upper_arm_m / body.stature_m / kBodies;
    forearm += body.forearm_m / body.stature_m / kBodies;
    shoulders += body.shoulder_half_m / body.stature_m / kBodies;
  }
  // Bodies D1-D3 of data/stereo_dev: 0.147, 0.132 to 0.156, 0.096 to 0.105.
  EXPECT_NEAR(upper_arm, 0.150, 0.005);
  EXPECT_NEAR(forearm, 0.146, 0.006);
  EXPECT_NEAR(shoulders, 0.101, 0.004);
}

TEST(Body, ChildrenHaveLargeHeadsAndShortLegs) {
  BodyParams children;
  children.child_share = 1.0;
  BodyParams adults;
  adults.child_share = 0.0;
  Rng rng(1);
  Rng other(1);
  BodyShape child = draw_body(rng, children);
  while (child.stature_m > 1.15) child = draw_body(rng, children);
  const BodyShape adult = draw_body(other, adults);

  EXPECT_GT(child.head_scale, 1.15 * adult.head_scale);
  EXPECT_LT((child.thigh_m + child.shank_m) / child.stature_m,
            0.97 * (adult.thigh_m + adult.shank_m) / adult.stature_m);
}

TEST(Skeleton, KeepsTheBoneLengthsInEveryPosture) {
  Rng rng(3);
  const BodyShape body = draw_body(rng);
  for (const std::string& name : natural_posture_names()) {
    const Skeleton skeleton = make_skeleton(body, draw_posture(rng, body, name), {});

    EXPECT_NEAR(distance(skeleton, Joint::kShoulderLeft, Joint::kElbowLeft), body.upper_arm_m, 1e-9)
        << name;
    EXPECT_NEAR(distance(skeleton, Joint::kElbowRight, Joint::kWristRight), body.forearm_m, 1e-9)
        << name;
    EXPECT_NEAR(distance(skeleton, Joint::kHipLeft, Joint::kKneeLeft), body.thigh_m, 1e-9) << name;
    EXPECT_NEAR(distance(skeleton, Joint::kKneeRight, Joint::kAnkleRight), body.shank_m, 1e-9)
        << name;
  }
}

TEST(Skeleton, StandsOnTheGround) {
  Rng rng(4);
  const BodyShape body = draw_body(rng);
  for (const std::string& name : natural_posture_names()) {
    if (name == "kneel" || name == "floor") continue;
    const Skeleton skeleton = make_skeleton(body, draw_posture(rng, body, name), {});
    const double lower =
        std::min(skeleton[Joint::kAnkleLeft].y(), skeleton[Joint::kAnkleRight].y());

    EXPECT_GT(lower, 0.5 * body.ankle_height_m) << name;
    EXPECT_LT(lower, 1.0 * body.ankle_height_m + 0.3 * body.foot_m) << name;
  }
}

TEST(Skeleton, KneelsAndSitsOnTheGround) {
  Rng rng(8);
  const BodyShape body = draw_body(rng);
  for (int i = 0; i < 30; ++i) {
    const Skeleton kneeling = make_skeleton(body, draw_posture(rng, body, "kneel"), {});
    const double lower = std::min(kneeling[Joint::kKneeLeft].y(), kneeling[Joint::kKneeRight].y());
    EXPECT_GT(lower, 0.02);
    EXPECT_LT(lower, 0.15);

    const Skeleton sitting = make_skeleton(body, draw_posture(rng, body, "floor"), {});
    EXPECT_GT(sitting[Joint::kPelvis].y(), 0.05);
    EXPECT_LT(sitting[Joint::kPelvis].y(), 0.3);
    for (const Joint joint : {Joint::kKneeLeft, Joint::kAnkleLeft, Joint::kWristLeft}) {
      EXPECT_GT(sitting[joint].y(), 0.0);
    }
  }
}

TEST(Skeleton, BowsFromTheHipsWithItsLegsUpright) {
  Rng rng(7);
  const BodyShape body = draw_body(rng);
  for (int i = 0; i < 30; ++i) {
    const Skeleton skeleton = make_skeleton(body, draw_posture(rng, body, "bow"), {});
    const Vector3d back = (skeleton[Joint::kNeck] - skeleton[Joint::kPelvis]).normalized();
    const Vector3d leg = (skeleton[Joint::kHipLeft] - skeleton[Joint::kAnkleLeft]).normalized();

    EXPECT_LT(back.y(), std::cos(radians(20.0)));
    EXPECT_GT(back.dot(skeleton.foot_R[0].col(2)), 0.3);  // to where the toes point
    EXPECT_GT(leg.y(), std::cos(radians(30.0)));
  }
}

TEST(Skeleton, HoldsSomethingBeforeTheTrunkWithBothHands) {
  Rng rng(11);
  const BodyShape body = draw_body(rng);
  int near_hands = 0;
  for (int i = 0; i < 40; ++i) {
    const Posture posture = draw_posture(rng, body, "hold");
    ASSERT_TRUE(posture.held);
    const HeldThing& thing = *posture.held;
    const Skeleton skeleton = make_skeleton(body, posture, {});
    const Surface surface = make_body_surface(body, posture, skeleton, 1);
    const Vector3d its_back =
        skeleton[Joint::kNeck] +
        skeleton.chest_R * (thing.middle_m - Vector3d(0, 0, 0.5 * thing.size_m.z()));
    EXPECT_GT(thing.size_m.x() * thing.size_m.y(), 0.04);
    EXPECT_GT(surface.distance_m(its_back.cast<float>()), 0.0F);

    for (const Joint wrist : {Joint::kWristLeft, Joint::kWristRight}) {
      const Vector3d from_middle =
          skeleton.chest_R.transpose() * (skeleton[wrist] - skeleton[Joint::kNeck]) -
          thing.middle_m;
      const Vector3d outside = from_middle.cwiseAbs() - 0.5 * thing.size_m;
      if (outside.maxCoeff() < 0.1) ++near_hands;
    }
  }
  EXPECT_GT(near_hands, 70);  // of 80; short arms do not reach round the largest boards
}

TEST(Skeleton, HasItsLeftHandOnTheImagesRightWhenItFacesTheCamera) {
  Rng rng(5);
  const BodyShape body = draw_body(rng);

  const Skeleton skeleton = make_skeleton(body, Posture{}, {});

  // The world's x points to the image's left.
  EXPECT_LT(skeleton[Joint::kWristLeft].x(), skeleton[Joint::kWristRight].x());
  EXPECT_LT(skeleton.eye.z(), skeleton[Joint::kHead].z());
}

TEST(Reach, PutsTheWristWhereItIsAsked) {
  Rng rng(6);
  const BodyShape body = draw_body(rng);
  const Vector3d wrist = body.stature_m * Vector3d(0.08, -0.15, 0.20);

  const ArmPose arm = reach(body, wrist, {0.5, -1, 0});

  const Vector3d reached =
      shoulder_offset_m(body, arm.upper) + body.upper_arm_m * arm.upper + body.forearm_m * arm.fore;
  EXPECT_NEAR((reached - wrist).norm(), 0.0, 0.002);
}

TEST(Postures, NoArmGoesThroughTheBody) {
  int inside = 0;
  int arms = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    const BodyShape body = draw_body(rng);
    const Posture posture = draw_natural(rng, body);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      ++arms;
      if (arm_clearance_m(body, posture, side) < -0.01) ++inside;
    }
  }
  EXPECT_LE(inside, arms / 50);
}

TEST(Postures, PointingArmsAreNearlyStraightAndWithinTheirRange) {
  PointingParams params;
  for (int seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    const BodyShape body = draw_body(rng);
    const Posture posture = draw_pointing(rng, body, params);
    const auto side = static_cast<Side>(posture.pointing_side);
    const Skeleton skeleton = make_skeleton(body, posture, {});

    EXPECT_LE(elbow_bend_rad(skeleton, side), radians(params.max_bend_deg + 2.0));
    const double elevation =
        std::asin((skeleton.chest_R.transpose() * arm_axis(skeleton, side)).y());
    EXPECT_GE(elevation, radians(params.min_elevation_deg - 2.0));
    EXPECT_LE(elevation, radians(params.max_elevation_deg + 2.0));
  }
}

TEST(BodySurface, HoldsEveryJoint) {
  for (int seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    const BodyShape body = draw_body(rng);
    const Posture posture = draw_natural(rng, body);
    const Skeleton skeleton = make_skeleton(body, posture, {});
    const Surface surface = make_body_surface(body, posture, skeleton, 1);
    for (int j = 0; j < kJointCount; ++j) {
      EXPECT_LT(surface.distance_m(skeleton.joints[j].cast<float>()), -0.004F)
          << kJointNames[j] << " of " << seed;
    }
  }
}

TEST(BodySurface, IsTheSameOnBothSidesOfASymmetricPosture) {
  Rng rng(9);
  BodyShape body = draw_body(rng);
  body.clothes.wrinkle_m = 0.0;  // folds differ from side to side
  const Skeleton skeleton = make_skeleton(body, Posture{}, {0.0, 0.0, 0.0});
  const Surface surface = make_body_surface(body, Posture{}, skeleton, 1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f point(static_cast<float>(rng.uniform(0.0, 0.5)),
                                static_cast<float>(rng.uniform(0.0, 1.8)),
                                static_cast<float>(rng.uniform(-0.3, 0.3)));
    const Eigen::Vector3f mirrored(-point.x(), point.y(), point.z());
    EXPECT_NEAR(surface.distance_m(point), surface.distance_m(mirrored), 0.004F);
  }
}

}  // namespace
}  // namespace limbcast::simulate
