#include "common/human_model/ground_truth_json.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/input_file.hpp"
#include "common/whole_number.hpp"

namespace limbcast {
namespace {

using nlohmann::json;

/// A JSON value and where it stands, for errors.
struct Located {
  const json& value;
  std::string where;

  [[noreturn]] void fail(const std::string& found) const {
    throw InputError(where + ": " + found + "; correct the truth file or remove it");
  }
  bool has(const char* key) const { return value.contains(key) && !value.at(key).is_null(); }
  Located at(const char* key) const {
    if (!value.is_object() || !has(key)) fail(std::string("'") + key + "' is missing");
    return {value.at(key), where + ": '" + key + "'"};
  }
};

float read_number(const Located& located) {
  if (!located.value.is_number()) located.fail("is not a number");
  const float number = located.value.get<float>();
  if (!std::isfinite(number)) located.fail("is not finite");
  return number;
}

Eigen::Vector3f read_vector(const Located& located) {
  if (!located.value.is_array() || located.value.size() != 3)
    located.fail("is no list of 3 numbers");
  Eigen::Vector3f vector;
  for (int axis = 0; axis < 3; ++axis) {
    vector[axis] = read_number({located.value.at(static_cast<std::size_t>(axis)), located.where});
  }
  return vector;
}

Eigen::Vector3f read_direction(const Located& located) {
  const Eigen::Vector3f direction = read_vector(located);
  // Written with 3 digits a unit vector still has about this length.
  if (std::abs(direction.norm() - 1.0F) > 0.01F) located.fail("is no unit vector");
  return direction.normalized();
}

bool read_flag(const Located& located) {
  if (!located.value.is_boolean()) located.fail("is not true or false");
  return located.value.get<bool>();
}

bool is_visible(const Located& person, const std::string& joint) {
  const Located visible = person.at("visible");
  return visible.has(joint.c_str()) && read_flag(visible.at(joint.c_str()));
}

void read_joints(const Located& person, BodyPose& pose) {
  const Located joints = person.at("joints");
  if (!joints.value.is_object()) joints.fail("is no list of joints");
  for (int i = 0; i < kJointCount; ++i) {
    const std::string name(kJointNames[static_cast<std::size_t>(i)]);
    if (!joints.has(name.c_str())) continue;
    JointEstimate& joint = pose.joints[static_cast<std::size_t>(i)];
    joint.valid = true;
    joint.position_m = read_vector(joints.at(name.c_str()));
    joint.confidence = is_visible(person, name) ? 1.0F : 0.0F;
  }
}

Side read_side(const Located& pointing) {
  const Located side = pointing.at("side");
  if (side.value == "left") return Side::kLeft;
  if (side.value == "right") return Side::kRight;
  side.fail("is neither \"left\" nor \"right\"");
}

Pointing read_pointing(const Located& file) {
  Pointing pointing;
  pointing.side = read_side(file);
  const bool consistent = !file.has("depth_consistent") || read_flag(file.at("depth_consistent"));
  const bool arm_visible = !file.has("arm_visible") || read_flag(file.at("arm_visible"));
  const bool use_straight_arm = !consistent && file.has("direction_straight_arm");
  pointing.direction =
      read_direction(file.at(use_straight_arm ? "direction_straight_arm" : "direction"));
  if (file.has("direction_elbow_wrist")) {
    pointing.forearm = read_direction(file.at("direction_elbow_wrist"));
  }
  if (file.has("direction_head_hand")) {
    pointing.head_hand = read_direction(file.at("direction_head_hand"));
  }
  pointing.confidence = consistent && arm_visible ? 1.0F : 0.0F;
  return pointing;
}

template <class Integer>
Integer read_integer(const Located& located) {
  const auto number = whole_number<Integer>(located.value);
  if (!number)
    located.fail("is not " + whole_number_text<Integer>() + " but " + located.value.dump());
  return *number;
}

BodyPose read_person(const Located& person, int place) {
  BodyPose pose;
  const bool has_number = person.has("id") && person.value.at("id").is_number();
  pose.id = has_number ? read_integer<std::int32_t>(person.at("id")) : place;
  pose.confidence = 1.0F;
  read_joints(person, pose);
  if (person.has("pointing")) pose.pointing.push_back(read_pointing(person.at("pointing")));
  return pose;
}

Gravity read_gravity(const Located& file) {
  Gravity gravity;
  if (!file.has("down")) return gravity;
  gravity.down = read_direction(file.at("down"));
  gravity.source = GravitySource::kRecording;
  if (file.has("camera_height")) gravity.sensor_height_m = read_number(file.at("camera_height"));
  return gravity;
}

json parse(const std::string& path) {
  check_is_file(path, "remove or rename it");
  std::ifstream stream(path);
  if (!stream) throw InputError(path + ": cannot be read; check that it exists and may be read");
  try {
    return json::parse(stream);
  } catch (const json::exception& error) {
    throw InputError(path + ": is no valid JSON (" + error.what() +
                     "); copy it again or remove it");
  }
}

}  // namespace

BodyPoses read_ground_truth(const std::string& path) {
  const json content = parse(path);
  const Located file{content, path};
  BodyPoses truth;
  truth.stamp.utime = read_integer<std::int64_t>(file.at("utime"));
  truth.stamp.gravity = read_gravity(file);
  const Located persons = file.at("persons");
  if (!persons.value.is_array()) persons.fail("is no list");
  for (const json& person : persons.value) {
    const int place = static_cast<int>(truth.persons.size()) + 1;
    truth.persons.push_back(
        read_person({person, path + ": person " + std::to_string(place)}, place));
  }
  return truth;
}

BodyPoses read_truth_of(const Stamp& frame, const std::string& path) {
  BodyPoses truth = read_ground_truth(path);
  const Gravity exact = truth.stamp.gravity;
  truth.stamp = frame;
  if (exact.source == GravitySource::kRecording) truth.stamp.gravity = exact;
  return truth;
}

}  // namespace limbcast
