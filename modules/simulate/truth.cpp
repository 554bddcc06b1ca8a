#include "modules/simulate/truth.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace limbcast::simulate {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Share of forearm and hand that must be seen, as in data/stereo_dev.
constexpr double kVisibleArmShare = 0.5;

/// What may lie over a joint, and how thick it may be along the ray as a share of the stature: 1.5
/// times the median depths in data/README.md, for people seen from the side and in coats.
struct Cover {
  std::vector<Part> parts;
  double thickness;
};

Cover cover_of(Joint joint, int side) {
  const Part upper = on_side(Part::kUpperArmLeft, side);
  const Part fore = on_side(Part::kForearmLeft, side);
  const Part hand = on_side(Part::kHandLeft, side);
  const Part thigh = on_side(Part::kThighLeft, side);
  const Part shank = on_side(Part::kShankLeft, side);
  const Part foot = on_side(Part::kFootLeft, side);
  switch (joint) {
    case Joint::kHead:
      return {{Part::kFace, Part::kHair}, 0.085};
    case Joint::kNeck:
      return {{Part::kNeck, Part::kTrunk, Part::kFace, Part::kHair}, 0.065};
    case Joint::kChest:
    case Joint::kPelvis:
      return {{Part::kTrunk, Part::kSkirt}, 0.125};
    case Joint::kShoulderLeft:
    case Joint::kShoulderRight:
      return {{upper, Part::kTrunk, Part::kNeck}, 0.055};
    case Joint::kElbowLeft:
    case Joint::kElbowRight:
      return {{upper, fore}, 0.045};
    case Joint::kWristLeft:
    case Joint::kWristRight:
      return {{fore, hand}, 0.035};
    case Joint::kHipLeft:
    case Joint::kHipRight:
      return {{Part::kTrunk, thigh, Part::kSkirt}, 0.100};
    case Joint::kKneeLeft:
    case Joint::kKneeRight:
      return {{thigh, shank, Part::kSkirt}, 0.060};
    case Joint::kAnkleLeft:
    case Joint::kAnkleRight:
      return {{shank, foot}, 0.055};
  }
  return {};
}

bool in_image(const FieldOfView& view, const Vector3d& point) {
  if (view.width == 0) return true;
  if (point.z() <= 0.0) return false;
  const Eigen::Vector2f pixel = view.project(point.cast<float>());
  return pixel.x() > -0.5F && pixel.y() > -0.5F && pixel.x() < view.width - 0.5F &&
         pixel.y() < view.height - 0.5F;
}

bool visible(const Scenario& scenario, const Person& person, const FieldOfView& view,
             const Vector3d& point, const Cover& cover) {
  if (!in_image(view, point)) return false;
  RayGrid ray;
  ray.width = ray.height = 1;
  Eigen::Vector3f towards = point.normalized().cast<float>();
  ray.direction = [towards](int, int) { return towards; };
  const Hit hit = raycast(scenario.world, ray).at(0, 0);
  if (hit.surface != person.surface) return false;
  const Part part = part_of(scenario.world, hit);
  const bool own = std::find(cover.parts.begin(), cover.parts.end(), part) != cover.parts.end();
  return own && point.norm() - hit.range_m <
                    cover.thickness * person.body.stature_m + person.body.clothes.torso_m;
}

double arm_fraction(const Scenario& scenario, const Person& person, const FieldOfView& view,
                    int side) {
  const Vector3d& elbow = person.skeleton[on_side(Joint::kElbowLeft, Side(side))];
  const Vector3d& wrist = person.skeleton[on_side(Joint::kWristLeft, Side(side))];
  const Cover cover{{on_side(Part::kUpperArmLeft, side), on_side(Part::kForearmLeft, side),
                     on_side(Part::kHandLeft, side)},
                    0.06};
  // An arm aimed at the sensor hides itself behind its hand: the cover is then as long as the arm.
  int seen = 0;
  for (int i = 0; i < 6; ++i) {
    const double share = i / 4.0;
    const Vector3d point =
        i < 5 ? Vector3d((1.0 - share) * elbow + share * wrist) : person.skeleton.hand[side];
    Cover along = cover;
    const double end_on = std::abs(point.normalized().dot(arm_axis(person.skeleton, Side(side))));
    along.thickness += 0.35 * std::pow(end_on, 4);
    seen += visible(scenario, person, view, point, along) ? 1 : 0;
  }
  return seen / 6.0;
}

json rounded(const Vector3d& v, double unit) {
  json result = json::array();
  for (int axis = 0; axis < 3; ++axis) result.push_back(std::round(v[axis] / unit) * unit);
  return result;
}
json metres(const Vector3d& v) { return rounded(v, 1e-4); }
json direction(const Vector3d& v) { return rounded(v.normalized(), 1e-5); }

/// What the line from eye to fingertip meets: there the person points, if it is a thing.
json target_json(const Scenario& scenario, const Person& person) {
  const Vector3d& fingertip = person.skeleton.fingertip[person.posture.pointing_side];
  Eigen::Vector3f towards = (fingertip - person.skeleton.eye).normalized().cast<float>();
  RayGrid ray;
  ray.width = ray.height = 1;
  ray.origin = fingertip.cast<float>() + 0.03F * towards;  // out of the finger
  ray.direction = [towards](int, int) { return towards; };
  const Hit hit = raycast(scenario.world, ray).at(0, 0);
  if (hit.solid < 0) return nullptr;
  return metres((ray.origin + hit.range_m * towards).cast<double>());
}

json pointing_json(const Scenario& scenario, const Person& person, const Visibility& seen) {
  const int side = person.posture.pointing_side;
  if (side < 0) return nullptr;
  const Skeleton& skeleton = person.skeleton;
  const Vector3d& wrist = skeleton[on_side(Joint::kWristLeft, Side(side))];
  return {{"side", side == 0 ? "left" : "right"},
          {"direction", direction(arm_axis(skeleton, Side(side)))},
          {"direction_elbow_wrist",
           direction(wrist - skeleton[on_side(Joint::kElbowLeft, Side(side))])},
          {"direction_head_hand", direction(skeleton.hand[side] - skeleton[Joint::kHead])},
          {"direction_eye_fingertip", direction(skeleton.fingertip[side] - skeleton.eye)},
          {"eye", metres(skeleton.eye)},
          {"fingertip", metres(skeleton.fingertip[side])},
          {"target", target_json(scenario, person)},
          {"arm_visible", seen.arm_fraction >= kVisibleArmShare},
          {"arm_visible_fraction", std::round(seen.arm_fraction * 100.0) / 100.0}};
}

/// What the person wears, to sort errors by.
json clothes_json(const Clothes& clothes) {
  static const char* const kSleeves[] = {"none", "short", "long"};
  static const char* const kLegwear[] = {"trousers", "shorts", "skirt", "long_skirt"};
  static const char* const kHair[] = {"bald", "short", "long", "bun", "afro", "headscarf"};
  static const char* const kHat[] = {"none", "cap", "beanie", "brim"};
  return {{"sleeves", kSleeves[static_cast<int>(clothes.sleeve)]},
          {"legwear", kLegwear[static_cast<int>(clothes.legwear)]},
          {"hair", kHair[static_cast<int>(clothes.hair)]},
          {"hat", kHat[static_cast<int>(clothes.hat)]},
          {"jacket", clothes.jacket},
          {"backpack", clothes.backpack}};
}

json person_json(const Scenario& scenario, std::size_t i, const FieldOfView& view, int pixels) {
  const Person& person = scenario.persons[i];
  const Visibility seen = visibility_of(scenario, person, view);
  json joints;
  json visible_joints;
  for (int j = 0; j < kJointCount; ++j) {
    const std::string name(kJointNames[j]);
    joints[name] = metres(person.skeleton.joints[j]);
    visible_joints[name] = seen.joints[j];
  }
  joints["head_top"] = metres(person.skeleton.head_top);
  visible_joints["head_top"] = seen.head_top;
  for (int side = 0; side < 2; ++side) {
    const char* name = side == 0 ? "hand_left" : "hand_right";
    joints[name] = metres(person.skeleton.hand[side]);
    visible_joints[name] = seen.hands[side];
  }
  return {{"id", "S" + std::to_string(i + 1)},
          {"body", "simulated_" + person.body.name},
          {"height_m", std::round(person.body.stature_m * 1000.0) / 1000.0},
          {"seated", person.posture.seated},
          {"clothes", clothes_json(person.body.clothes)},
          {"joints", joints},
          {"visible", visible_joints},
          {"mask_index", i + 1},
          {"pixels", pixels},
          {"pose", person.posture.name},
          {"body_yaw_deg", std::round(person.place.yaw_rad * 1800.0 / 3.14159265358979) / 10.0},
          {"pointing", pointing_json(scenario, person, seen)}};
}

}  // namespace

Visibility visibility_of(const Scenario& scenario, const Person& person, const FieldOfView& view) {
  Visibility seen;
  for (int j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<Joint>(j);
    const int side = j < index(Joint::kShoulderLeft) ? 0 : (j - index(Joint::kShoulderLeft)) % 2;
    seen.joints[j] =
        visible(scenario, person, view, person.skeleton.joints[j], cover_of(joint, side));
  }
  seen.head_top =
      visible(scenario, person, view, person.skeleton.head_top, {{Part::kFace, Part::kHair}, 0.06});
  for (int side = 0; side < 2; ++side) {
    seen.hands[side] =
        visible(scenario, person, view, person.skeleton.hand[side],
                {{on_side(Part::kForearmLeft, side), on_side(Part::kHandLeft, side)}, 0.04});
  }
  if (person.posture.pointing_side >= 0) {
    seen.arm_fraction = arm_fraction(scenario, person, view, person.posture.pointing_side);
  }
  return seen;
}

json truth_json(const Scenario& scenario, const FieldOfView& view, const std::vector<int>& pixels) {
  json persons = json::array();
  for (std::size_t i = 0; i < scenario.persons.size(); ++i) {
    persons.push_back(person_json(scenario, i, view, pixels[i]));
  }
  json truth = {{"frame", scenario.name},
                {"utime", scenario.utime},
                {"camera", nullptr},
                {"down", rounded(scenario.down, 1e-6)},
                {"camera_height", std::round(scenario.sensor_height_m * 1e4) / 1e4},
                {"persons", persons},
                {"scene", "simulated"},
                {"camera_pitch_down_deg", std::round(scenario.pitch_down_deg * 100.0) / 100.0}};
  if (view.width > 0) {
    truth["camera"] = {{"width", view.width}, {"height", view.height}, {"fx", view.fx},
                       {"fy", view.fy},       {"cx", view.cx},         {"cy", view.cy}};
  }
  return truth;
}

BodyPoses truth_poses(const Scenario& scenario, const FieldOfView& view, const Stamp& stamp) {
  BodyPoses truth;
  truth.stamp = stamp;
  truth.stamp.gravity.down = scenario.down.cast<float>();
  truth.stamp.gravity.source = GravitySource::kRecording;
  truth.stamp.gravity.sensor_height_m = static_cast<float>(scenario.sensor_height_m);
  for (const Person& person : scenario.persons) {
    const Visibility seen = visibility_of(scenario, person, view);
    BodyPose pose;
    pose.id = static_cast<std::int32_t>(truth.persons.size()) + 1;
    pose.confidence = 1.0F;
    for (int j = 0; j < kJointCount; ++j) {
      JointEstimate& joint = pose.joints[j];
      joint.valid = true;
      joint.position_m = person.skeleton.joints[j].cast<float>();
      joint.confidence = seen.joints[j] ? 1.0F : 0.0F;
    }
    if (person.posture.pointing_side >= 0) {
      const auto side = static_cast<Side>(person.posture.pointing_side);
      const Vector3d& wrist = person.skeleton[on_side(Joint::kWristLeft, side)];
      const Vector3d& elbow = person.skeleton[on_side(Joint::kElbowLeft, side)];
      const Vector3d& hand = person.skeleton.hand[person.posture.pointing_side];
      Pointing pointing;
      pointing.side = side;
      pointing.direction = arm_axis(person.skeleton, side).cast<float>();
      pointing.forearm = (wrist - elbow).normalized().cast<float>();
      pointing.head_hand = (hand - person.skeleton[Joint::kHead]).normalized().cast<float>();
      pointing.confidence = seen.arm_fraction >= kVisibleArmShare ? 1.0F : 0.0F;
      pose.pointing.push_back(pointing);
    }
    truth.persons.push_back(pose);
  }
  return truth;
}

}  // namespace limbcast::simulate
