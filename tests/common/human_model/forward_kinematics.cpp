#include "tests/common/human_model/forward_kinematics.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "common/shortest_turn.hpp"

namespace limbcast {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

Matrix3f rotation_x(float rad) {
  return Eigen::AngleAxisf(rad, Vector3f::UnitX()).toRotationMatrix();
}
Matrix3f rotation_y(float rad) {
  return Eigen::AngleAxisf(rad, Vector3f::UnitY()).toRotationMatrix();
}
Matrix3f rotation_z(float rad) {
  return Eigen::AngleAxisf(rad, Vector3f::UnitZ()).toRotationMatrix();
}

/// Rx(-flexion) * Rz(abduction) * down, abduction to the left.
Vector3f swing(float flexion, float abduction) {
  return rotation_x(-flexion) * rotation_z(abduction) * -Vector3f::UnitY();
}

class Builder {
 public:
  Builder(const Angles& angles, const HumanModel& model) : angles_(angles), model_(model) {}

  float angle(const std::string& name) const { return angles_[dof_index(model_, name)]; }
  float length(int link) const { return static_cast<float>(model_.links[link].length_m); }
  void add(int link, const Vector3f& offset) {
    const Link& row = model_.links[link];
    const Joint from = model_.links[row.connected_to].end;
    skeleton.set(row.end, skeleton[from] + offset * length(link));
  }
  void add_limb(const Matrix3f& frame, int upper_link, const std::string& root,
                const std::string& hinge, float side, float bends) {
    Vector3f upper = swing(angle(root + "_flexion"), side * angle(root + "_abduction"));
    upper = frame * upper;
    add(upper_link, upper);
    const Matrix3f moved = shortest_turn<float>(-frame.col(1), upper).toRotationMatrix() * frame;
    const float rotation = angle(root + "_rotation"), bend = angle(hinge + "_flexion");
    add(upper_link + 1,
        moved * Vector3f(-side * bends * std::sin(bend) * std::sin(rotation), -std::cos(bend),
                         bends * std::sin(bend) * std::cos(rotation)));
  }

  Skeleton skeleton;

 private:
  const Angles& angles_;
  const HumanModel& model_;
};

}  // namespace

int dof_index(const HumanModel& model, const std::string& name) {
  for (int i = 0; i < kDegreesOfFreedom; ++i) {
    if (model.degrees_of_freedom[i].name == name) return i;
  }
  throw std::out_of_range("no degree of freedom '" + name + "'");
}

float pelvis_pitch_of(const Angles& angles, const HumanModel& model) {
  // pitch = 0.18 * (mean of the hips' flexions against the pelvis + pitch)
  const float mean = 0.5F * (angles[dof_index(model, "hip_left_flexion")] +
                             angles[dof_index(model, "hip_right_flexion")]);
  return 0.18F / (1.0F - 0.18F) * mean;
}

Skeleton skeleton_from_angles(const Angles& angles, const HumanModel& model, const Matrix3f& body,
                              const Vector3f& head_m) {
  Builder b(angles, model);
  const auto& directions = model.typical_poses[0].directions;
  b.skeleton.set(Joint::kHead, head_m);
  b.add(1, body * directions[1]);
  const Matrix3f girdle =
      body * rotation_y(b.angle("girdle_turn")) * rotation_z(b.angle("girdle_tilt"));
  const Matrix3f pitched = girdle * rotation_x(-b.angle("girdle_pitch"));
  b.add(2, pitched * directions[2]);
  b.add(3, pitched * directions[3]);
  b.add_limb(girdle, 4, "shoulder_left", "elbow_left", 1.0F, 1.0F);
  b.add_limb(girdle, 6, "shoulder_right", "elbow_right", -1.0F, 1.0F);
  Matrix3f back = body;
  for (const int link : {8, 9}) {
    const std::string name = link == 8 ? "upper_back" : "lower_back";
    const Vector3f direction =
        back * swing(-b.angle(name + "_flexion"), b.angle(name + "_lateral"));
    b.add(link, direction);
    back = shortest_turn<float>(-back.col(1), direction).toRotationMatrix() * back;
  }
  const float turn =
      b.angle("upper_back_twist") + b.angle("lower_back_twist") + b.angle("pelvis_turn");
  const Matrix3f level = back * rotation_y(turn) * rotation_z(b.angle("pelvis_tilt"));
  b.add(10, level * Vector3f::UnitX());
  b.add(11, -(level * Vector3f::UnitX()));
  const Matrix3f pelvis = level * rotation_x(-b.angle("pelvis_pitch"));
  b.add_limb(pelvis, 12, "hip_left", "knee_left", 1.0F, -1.0F);
  b.add_limb(pelvis, 14, "hip_right", "knee_right", -1.0F, -1.0F);
  return b.skeleton;
}

}  // namespace limbcast
