#include "common/pose_json/pose_text.hpp"

#include <algorithm>

#include "common/formatted.hpp"
#include "common/units.hpp"

namespace limbcast::pose_json {
namespace {

std::string vector_text(const Eigen::Vector3f& vector) {
  return formatted("(%.2f, %.2f, %.2f)", vector.x(), vector.y(), vector.z());
}

/// Where a person is: the head, else the first joint that was found.
std::string place_text(const BodyPose& person) {
  for (const JointEstimate& joint : person.joints) {
    if (joint.valid) return "at " + vector_text(joint.position_m) + " m";
  }
  return "without joints";
}

std::string pointing_text(const BodyPose& person) {
  if (person.pointing.empty()) return "does not point";
  const Pointing& arm = person.pointing.front();
  std::string text = std::string(arm.side == Side::kLeft ? "left" : "right") + " arm points to " +
                     vector_text(arm.direction);
  if (arm.sigma_rad > 0.0F)
    text += formatted(", sigma %.1f degrees", arm.sigma_rad * kDegreesPerRadian<float>);
  return text;
}

std::string person_text(const BodyPose& person) {
  const auto joints = std::count_if(person.joints.begin(), person.joints.end(),
                                    [](const JointEstimate& joint) { return joint.valid; });
  return formatted("person %d %s, %d of %d joints, error %.3f, %s", person.id,
                   place_text(person).c_str(), static_cast<int>(joints), kJointCount,
                   static_cast<double>(person.error), pointing_text(person).c_str());
}

}  // namespace

std::string to_text(const BodyPoses& poses) {
  const std::string time = formatted("%.3f s  ", static_cast<double>(poses.stamp.utime) * 1e-6);
  if (poses.persons.empty()) return time + "nobody\n";
  std::string text;
  for (const BodyPose& person : poses.persons) text += time + person_text(person) + "\n";
  return text;
}

}  // namespace limbcast::pose_json
