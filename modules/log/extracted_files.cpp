#include "modules/log/extracted_files.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/camera/encoded_image.hpp"
#include "common/lcm_io/image_codec.hpp"
#include "common/whole_file.hpp"

namespace limbcast::logs {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3f& vector) {
  // To 0.1 mm, which no sensor resolves.
  constexpr double kSteps = 1e4;
  Json json = Json::array();
  for (int i = 0; i < 3; ++i) json.push_back(std::round(vector[i] * kSteps) / kSteps);
  return json;
}

Json direction_json(const Eigen::Vector3f& direction) {
  return {direction.x(), direction.y(), direction.z()};
}

Json pointing_json(const Pointing& pointing) {
  Json json = {{"side", pointing.side == Side::kLeft ? "left" : "right"},
               {"direction", direction_json(pointing.direction)},
               {"arm_visible", pointing.confidence > 0.5F}};
  if (!pointing.forearm.isZero()) json["direction_elbow_wrist"] = direction_json(pointing.forearm);
  if (!pointing.head_hand.isZero())
    json["direction_head_hand"] = direction_json(pointing.head_hand);
  return json;
}

Json person_json(const BodyPose& person) {
  Json json = {{"id", person.id},
               {"joints", Json::object()},
               {"visible", Json::object()},
               {"pointing", nullptr}};
  for (int i = 0; i < kJointCount; ++i) {
    const JointEstimate& joint = person.joints[i];
    if (!joint.valid) continue;
    const std::string name(kJointNames[i]);
    json["joints"][name] = vector_json(joint.position_m);
    json["visible"][name] = joint.confidence > 0.5F;
  }
  if (!person.pointing.empty()) json["pointing"] = pointing_json(person.pointing.front());
  return json;
}

/// A colour as PCD has it: 0x00RRGGBB.
std::uint32_t packed(const Bgr& color) {
  return static_cast<std::uint32_t>(color.r << 16 | color.g << 8 | color.b);
}

/// The lines of a PCD header that tell what each point holds.
std::string pcd_fields(const Cloud& cloud) {
  std::string fields = "FIELDS x y z", sizes = "SIZE 4 4 4", types = "TYPE F F F",
              counts = "COUNT 1 1 1";
  const auto add = [&](const char* field, const char* size, const char* type) {
    fields += field;
    sizes += size;
    types += type;
    counts += " 1";
  };
  if (!cloud.colors.empty()) add(" rgb", " 4", " U");
  if (!cloud.intensities.empty()) add(" intensity", " 4", " F");
  if (!cloud.rings.empty()) add(" ring", " 2", " U");
  return fields + '\n' + sizes + '\n' + types + '\n' + counts + '\n';
}

/// Who told gravity knew it, rather than found or supposed it.
bool tells_gravity(const Gravity& gravity) {
  return gravity.source == GravitySource::kRecording || gravity.source == GravitySource::kOption;
}

}  // namespace

void write_picture(const std::string& path, const image_t& image) {
  if (image.encoding == image_t::JPEG) return write_whole_file(path + ".jpg", image.data);
  if (image.encoding == image_t::PNG) return write_whole_file(path + ".png", image.data);
  write_whole_file(path + ".png", encode_png(lcm_io::from_message(image)).bytes);
}

void write_cloud(const std::string& path, const Cloud& cloud) {
  std::string records;
  std::size_t count = 0;
  const auto append = [&records](const auto& value) {
    records.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    if (cloud.is_hole(i)) continue;
    ++count;
    for (int axis = 0; axis < 3; ++axis) append(cloud.points_m[i][axis]);
    if (!cloud.colors.empty()) append(packed(cloud.colors[i]));
    if (!cloud.intensities.empty()) append(cloud.intensities[i]);
    if (!cloud.rings.empty()) append(cloud.rings[i]);
  }
  const std::string number = std::to_string(count);
  write_whole_file(path, "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" +
                             pcd_fields(cloud) + "WIDTH " + number +
                             "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + number +
                             "\nDATA binary\n" + records);
}

void write_truth(const std::string& path, const BodyPoses& truth) {
  Json json = {{"utime", truth.stamp.utime}};
  if (truth.stamp.gravity.source == GravitySource::kRecording)
    json["down"] = direction_json(truth.stamp.gravity.down);
  if (truth.stamp.gravity.sensor_height_m)
    json["camera_height"] = *truth.stamp.gravity.sensor_height_m;
  json["persons"] = Json::array();
  for (const BodyPose& person : truth.persons) json["persons"].push_back(person_json(person));
  write_whole_file(path, json.dump(1) + "\n");
}

void write_timestamps(const std::string& path, const std::vector<Stamp>& stamps) {
  bool all_tell_gravity = true;
  for (const Stamp& stamp : stamps)
    all_tell_gravity = all_tell_gravity && tells_gravity(stamp.gravity);
  std::string text = all_tell_gravity ? "name,utime,down_x,down_y,down_z\n" : "name,utime\n";
  for (const Stamp& stamp : stamps) {
    text += frame_name(stamp) + ',' + std::to_string(stamp.utime);
    const Eigen::Vector3f& down = stamp.gravity.down;
    char gravity[64];
    std::snprintf(gravity, sizeof(gravity), ",%.6f,%.6f,%.6f", down.x(), down.y(), down.z());
    text += (all_tell_gravity ? gravity : "") + std::string("\n");
  }
  write_whole_file(path, text);
}

std::string frame_name(const Stamp& stamp) {
  char name[32];
  std::snprintf(name, sizeof(name), "%016lld", static_cast<long long>(stamp.utime));
  return name;
}

}  // namespace limbcast::logs
