#include "common/pose_json/pose_lines.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/input_file.hpp"
#include "common/joined.hpp"
#include "common/pose_json/json_fields.hpp"
#include "common/units.hpp"

namespace limbcast::pose_json {
namespace {

using OrderedJson = nlohmann::ordered_json;

double rounded(float value, double steps_per_unit) {
  // Adding 0 turns -0 into 0, so that equal poses give equal lines.
  return std::round(static_cast<double>(value) * steps_per_unit) / steps_per_unit + 0.0;
}

OrderedJson vector_json(const Eigen::Vector3f& vector, double steps_per_unit) {
  return {rounded(vector.x(), steps_per_unit), rounded(vector.y(), steps_per_unit),
          rounded(vector.z(), steps_per_unit)};
}

/// null where it is not known (zero), as that of head and hand where the head was left out.
OrderedJson direction_json(const Eigen::Vector3f& direction, double steps_per_unit) {
  if (direction.isZero()) return nullptr;
  return vector_json(direction, steps_per_unit);
}

const std::string kRemedy =
    "give a file that limbcast-export-poses wrote (with --format json, its default)";

constexpr double kPositionSteps = 1e4;   // 0.1 mm
constexpr double kDirectionSteps = 1e5;  // 0.0006 degrees
constexpr double kShareSteps = 1e4;

OrderedJson pointing_json(const std::vector<Pointing>& arms) {
  if (arms.empty()) return nullptr;
  const Pointing& arm = arms.front();
  return {{"side", arm.side == Side::kLeft ? "left" : "right"},
          {"direction", vector_json(arm.direction, kDirectionSteps)},
          {"forearm", direction_json(arm.forearm, kDirectionSteps)},
          {"head_hand", direction_json(arm.head_hand, kDirectionSteps)},
          {"sigma_deg", rounded(arm.sigma_rad * kDegreesPerRadian<float>, kShareSteps)},
          {"confidence", rounded(arm.confidence, kShareSteps)}};
}

OrderedJson person_json(const BodyPose& person) {
  OrderedJson joints, confidences, sigmas;
  for (int i = 0; i < kJointCount; ++i) {
    const JointEstimate& joint = person.joints[i];
    const std::string name(kJointNames[i]);
    if (!joint.valid) {
      joints[name] = nullptr;
      continue;
    }
    joints[name] = vector_json(joint.position_m, kPositionSteps);
    confidences[name] = rounded(joint.confidence, kShareSteps);
    sigmas[name] = rounded(joint.sigma_m, kPositionSteps);
  }
  return {{"id", person.id},
          {"error", rounded(person.error, 1e6)},
          {"confidence", rounded(person.confidence, kShareSteps)},
          {"joints", joints},
          {"joint_confidence", confidences.is_null() ? OrderedJson::object() : confidences},
          {"joint_sigma", sigmas.is_null() ? OrderedJson::object() : sigmas},
          {"pointing", pointing_json(person.pointing)}};
}

Pointing read_pointing(const nlohmann::json& object, const std::string& where) {
  Pointing arm;
  arm.side = side(object, where);
  arm.direction = direction(required(object, "direction", where), "direction", where);
  if (const auto found = object.find("forearm"); found != object.end() && !found->is_null())
    arm.forearm = direction(*found, "forearm", where);
  if (const auto found = object.find("head_hand"); found != object.end() && !found->is_null())
    arm.head_hand = direction(*found, "head_hand", where);
  arm.sigma_rad = number_or(object, "sigma_deg", 0.0F, where) / kDegreesPerRadian<float>;
  arm.confidence = number_or(object, "confidence", 0.0F, where);
  return arm;
}

/// A name that is mistyped would be a joint that was left out.
void check_joint_names(const nlohmann::json& joints, const std::string& where) {
  for (const auto& [name, value] : joints.items()) {
    if (!joint_from_name(name))
      throw InputError(where + ": '" + name + "' is no joint, must be one of " +
                       joined(std::vector<std::string>(kJointNames.begin(), kJointNames.end())));
  }
}

void read_joints(const nlohmann::json& object, const std::string& where, BodyPose& person) {
  const nlohmann::json& joints = required(object, "joints", where);
  if (!joints.is_object()) throw InputError(where + ": 'joints' must be a JSON object");
  const nlohmann::json confidences = object.value("joint_confidence", nlohmann::json::object());
  const nlohmann::json sigmas = object.value("joint_sigma", nlohmann::json::object());
  if (!confidences.is_object() || !sigmas.is_object())
    throw InputError(where + ": 'joint_confidence' and 'joint_sigma' must be JSON objects");
  for (const nlohmann::json* named : {&joints, &confidences, &sigmas})
    check_joint_names(*named, where);
  for (int i = 0; i < kJointCount; ++i) {
    const std::string name(kJointNames[i]);
    const auto found = joints.find(name);
    if (found == joints.end() || found->is_null()) continue;
    JointEstimate& joint = person.joints[i];
    joint.valid = true;
    joint.position_m = vector3(*found, name, where);
    joint.confidence = number_or(confidences, name, 0.0F, where);
    joint.sigma_m = number_or(sigmas, name, 0.0F, where);
  }
}

BodyPose read_person(const nlohmann::json& object, const std::string& where) {
  BodyPose person;
  read_joints(object, where, person);
  person.id = integer_or(object, "id", 0, where);
  person.error = number_or(object, "error", 0.0F, where);
  person.confidence = number_or(object, "confidence", 0.0F, where);
  const auto pointing = object.find("pointing");
  if (pointing != object.end() && !pointing->is_null())
    person.pointing.push_back(read_pointing(*pointing, where));
  return person;
}

}  // namespace

std::string to_line(const BodyPoses& poses) {
  OrderedJson persons = OrderedJson::array();
  for (const BodyPose& person : poses.persons) persons.push_back(person_json(person));
  const OrderedJson line = {
      {"utime", poses.stamp.utime}, {"sensor", poses.stamp.sensor}, {"persons", persons}};
  // A sensor's name may come from a foreign message: replace what is no UTF-8 instead of throwing.
  return line.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

BodyPoses from_line(const std::string& line, const std::string& where) {
  const nlohmann::json object = nlohmann::json::parse(line, nullptr, false);
  if (object.is_discarded()) throw InputError(where + ": is no JSON");
  BodyPoses poses;
  poses.stamp.utime = integer(object, "utime", where);
  const nlohmann::json& persons = required(object, "persons", where);
  if (!persons.is_array()) throw InputError(where + ": 'persons' must be a list");
  const auto sensor = object.find("sensor");
  if (sensor != object.end() && sensor->is_string())
    poses.stamp.sensor = sensor->get<std::string>();
  for (const nlohmann::json& person : persons) poses.persons.push_back(read_person(person, where));
  return poses;
}

std::vector<BodyPoses> read_lines(std::istream& in, const std::string& name) {
  std::vector<BodyPoses> frames;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      frames.push_back(from_line(line, name + ": line " + std::to_string(number)));
    } catch (const InputError& error) {
      throw InputError(std::string(error.what()) + "; " + kRemedy);
    }
  }
  return frames;
}

std::vector<BodyPoses> read_file(const std::string& path) {
  check_is_file(path, kRemedy);
  std::ifstream file(path);
  const bool is_open = file.is_open();
  std::vector<BodyPoses> frames = read_lines(file, path);
  if (!is_open || file.bad()) throw InputError(path + ": cannot be read; " + kRemedy);
  if (frames.empty()) throw InputError(path + ": holds no frame; " + kRemedy);
  return frames;
}

}  // namespace limbcast::pose_json
