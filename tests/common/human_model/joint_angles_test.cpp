#include "common/human_model/joint_angles.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/common/human_model/forward_kinematics.hpp"

namespace limbcast {
namespace {

constexpr float kRadPerDeg = 3.14159265F / 180.0F;
constexpr float kToleranceRad = 15.0F * kRadPerDeg;

class JointAnglesTest : public testing::Test {
 protected:
  JointAngles angles_of(const Skeleton& skeleton) const {
    return joint_angles(skeleton, body_, model_,
                        shoulder_pitch_rad(model_.typical_poses[0].directions[2]));
  }
  Skeleton skeleton_of(const Angles& angles) const {
    return skeleton_from_angles(angles, model_, body_, {0.1F, -0.5F, 3.0F});
  }
  int dof(const std::string& name) const { return dof_index(model_, name); }
  /// Makes the angles that are shared out by convention agree with it.
  void obey_conventions(Angles& angles) const {
    const float turn = angles[dof("pelvis_turn")];
    angles[dof("upper_back_twist")] = turn * 35.0F / 45.0F;
    angles[dof("lower_back_twist")] = turn * 5.0F / 45.0F;
    angles[dof("pelvis_pitch")] = pelvis_pitch_of(angles, model_);
  }
  /// All links in line with the body, elbows and knees bent by 40 degrees.
  Angles resting() const {
    Angles angles{};
    for (const char* hinge : {"elbow_left", "elbow_right", "knee_left", "knee_right"}) {
      angles[dof(std::string(hinge) + "_flexion")] = 40.0F * kRadPerDeg;
    }
    return angles;
  }

  HumanModel model_ = load_human_model();
  /// Some person that is turned and leans in the camera's frame.
  Eigen::Matrix3f body_ = (Eigen::AngleAxisf(2.5F, Eigen::Vector3f(0.2F, 1.0F, 0.1F).normalized()) *
                           Eigen::AngleAxisf(3.1F, Eigen::Vector3f::UnitX()))
                              .toRotationMatrix();
};

TEST_F(JointAnglesTest, GiveBackTheAnglesOfWhichABodyWasMade) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    Angles angles{};
    for (int i = 0; i < kDegreesOfFreedom; ++i) {
      const DegreeOfFreedom& limits = model_.degrees_of_freedom[i];
      // Short of straight sideways, straight elbows and overhead, where end points do not tell all.
      const double min = std::max(limits.min_rad, dof("elbow_left_flexion") == i ? 0.2 : -1.4);
      const double max = std::min(limits.max_rad, 1.4);
      angles[i] = static_cast<float>(std::uniform_real_distribution<>(min, max)(random));
    }
    for (const char* hinge : {"elbow_left", "elbow_right", "knee_left", "knee_right"}) {
      float& bend = angles[dof(std::string(hinge) + "_flexion")];
      bend = std::max(bend, 0.2F);
    }
    obey_conventions(angles);
    const JointAngles found = angles_of(skeleton_of(angles));
    for (int i = 0; i < kDegreesOfFreedom; ++i) {
      EXPECT_NEAR(found[i].rad, angles[i], 2e-3F) << model_.degrees_of_freedom[i].name;
    }
  }
}

TEST_F(JointAnglesTest, AreAllowedInEveryTypicalPose) {
  for (const TypicalPose& pose : model_.typical_poses) {
    Skeleton skeleton;
    skeleton.set(Joint::kHead, {0.0F, 0.0F, 3.0F});
    for (int number = 1; number < kLinkCount; ++number) {
      const Link& link = model_.links[number];
      skeleton.set(link.end,
                   skeleton[model_.links[link.connected_to].end] +
                       body_ * pose.directions[number] * static_cast<float>(link.length_m));
    }
    const auto broken = broken_joint_limit(angles_of(skeleton), model_, kToleranceRad);
    EXPECT_FALSE(broken) << pose.name << ": " << model_.degrees_of_freedom[broken.value_or(0)].name;
  }
}

TEST_F(JointAnglesTest, BreakTheLimitOfEachDegreeOfFreedomInTurn) {
  EXPECT_FALSE(broken_joint_limit(angles_of(skeleton_of(resting())), model_, kToleranceRad));
  const float beyond = 25.0F * kRadPerDeg;
  for (int i = 0; i < kDegreesOfFreedom; ++i) {
    const DegreeOfFreedom& limits = model_.degrees_of_freedom[i];
    JointAngles angles = angles_of(skeleton_of(resting()));
    angles[i] = {static_cast<float>(limits.min_rad) - beyond, 1.0F};
    EXPECT_EQ(broken_joint_limit(angles, model_, kToleranceRad), i) << limits.name;
    angles[i] = {static_cast<float>(limits.min_rad) - 0.5F * kToleranceRad, 1.0F};
    EXPECT_FALSE(broken_joint_limit(angles, model_, kToleranceRad)) << limits.name;
  }
}

TEST_F(JointAnglesTest, BreakLimitsOfBodiesThatBendTheWrongWay) {
  const std::pair<const char*, float> cases[] = {{"girdle_turn", 85.0F},
                                                 {"girdle_tilt", -70.0F},
                                                 {"upper_back_flexion", -100.0F},
                                                 {"lower_back_flexion", 85.0F},
                                                 {"lower_back_lateral", 45.0F},
                                                 {"shoulder_left_flexion", -85.0F},
                                                 {"shoulder_right_flexion", -85.0F},
                                                 {"shoulder_left_abduction", -70.0F},
                                                 {"elbow_left_flexion", 172.0F},
                                                 {"elbow_right_flexion", 172.0F},
                                                 {"hip_left_flexion", -60.0F},
                                                 {"hip_right_abduction", 70.0F},
                                                 {"knee_left_flexion", 160.0F},
                                                 {"knee_right_flexion", 160.0F}};
  for (const auto& [name, deg] : cases) {
    Angles angles = resting();
    angles[dof(name)] = deg * kRadPerDeg;
    angles[dof("pelvis_pitch")] = pelvis_pitch_of(angles, model_);
    const auto broken = broken_joint_limit(angles_of(skeleton_of(angles)), model_, kToleranceRad);
    ASSERT_TRUE(broken) << name;
    EXPECT_EQ(model_.degrees_of_freedom[*broken].name, name);
  }
}

TEST_F(JointAnglesTest, BreakLimitsOfAKneeThatBendsForward) {
  Angles angles = resting();
  angles[dof("hip_left_rotation")] = 180.0F * kRadPerDeg;
  angles[dof("knee_left_flexion")] = 90.0F * kRadPerDeg;
  EXPECT_EQ(broken_joint_limit(angles_of(skeleton_of(angles)), model_, kToleranceRad),
            dof("hip_left_rotation"));
}

TEST_F(JointAnglesTest, DoNotMindTheRotationOfAStraightArm) {
  Angles angles = resting();
  angles[dof("shoulder_left_rotation")] = 180.0F * kRadPerDeg;
  angles[dof("elbow_left_flexion")] = 5.0F * kRadPerDeg;
  EXPECT_FALSE(broken_joint_limit(angles_of(skeleton_of(angles)), model_, kToleranceRad));
}

TEST_F(JointAnglesTest, AreLeftOutWithTheLinksTheyNeed) {
  Skeleton skeleton = skeleton_of(resting());
  skeleton.valid[index(Joint::kWristLeft)] = false;
  skeleton.valid[index(Joint::kHipRight)] = false;
  const JointAngles angles = angles_of(skeleton);
  for (const char* name : {"shoulder_left_rotation", "elbow_left_flexion", "pelvis_turn",
                           "pelvis_tilt", "hip_right_flexion", "knee_right_flexion"}) {
    EXPECT_TRUE(std::isnan(angles[dof(name)].rad)) << name;
  }
  for (const char* name : {"shoulder_left_flexion", "elbow_right_flexion", "hip_left_flexion"}) {
    EXPECT_FALSE(std::isnan(angles[dof(name)].rad)) << name;
  }
}

}  // namespace
}  // namespace limbcast
