#include "common/human_model/human_model.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "common/human_model/json_node.hpp"
#include "common/human_model/shipped_models.hpp"
#include "common/input_file.hpp"

namespace limbcast {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kLongestLinkM = 2.0;

/// A file that was read, or that ships inside the library.
struct ModelText {
  std::string file, text;
};

ModelText find_text(const std::string& name_or_path) {
  if (const auto shipped = shipped_model(name_or_path)) {
    return {name_or_path + ".json", std::string(*shipped)};
  }
  const std::string remedy =
      "name a model that ships (" + shipped_model_names() + ") or the path of a model file";
  check_is_file(name_or_path, remedy);
  std::ifstream stream(name_or_path);
  if (!stream) throw InputError(name_or_path + ": cannot be read; " + remedy);
  std::ostringstream text;
  text << stream.rdbuf();
  return {name_or_path, text.str()};
}

/// What is told about the end of every link, the head included.
void read_end(const JsonNode& node, Link& link) {
  link.depth_offset_m = node.at("depth_offset_m").number(0.0, 0.5);
  link.confidence = static_cast<float>(node.at("confidence").number(0.0, 1.0));
}

Link read_link(const JsonNode& node, int number) {
  Link link;
  if (node.at("number").whole(0, kLinkCount) != number) {
    node.at("number").fail("must be " + std::to_string(number) + ", in the order of Table I");
  }
  link.name = node.at("name").text();
  const auto end = joint_from_name(node.at("end").text());
  if (!end) node.at("end").fail("is no joint's name");
  link.end = *end;
  // A link starts where one before it ended, so that one pass fits them all.
  link.connected_to = node.at("connected_to").whole(0, number - 1);
  if (node.has("coupled_to")) link.coupled_to = node.at("coupled_to").whole(1, number - 1);
  link.min_length_m = node.at("min_length_m").number(0.01, kLongestLinkM);
  link.max_length_m = node.at("max_length_m").number(link.min_length_m, kLongestLinkM);
  link.length_m = node.at("length_m").number(link.min_length_m, link.max_length_m);
  link.radius_m = node.at("radius_m").number(0.01, 0.5);
  read_end(node, link);
  return link;
}

void read_links(const ModelText& source, HumanModel& model) {
  const auto json = JsonNode::parse(source.file, source.text);
  const JsonNode root(source.file, json);
  model.name = root.at("name").text();
  model.start_scale = root.at("start_scale").number(0.1, 10.0);
  model.length_limits_source = root.at("length_limits_source").text();
  const JsonNode links = root.at("links");
  if (links.size() != kLinkCount - 1) links.fail("must have 15 entries, links 1 to 15 of Table I");
  model.links[0] = Link{};
  model.links[0].name = "Start (Head)";
  read_end(root.at("head"), model.links[0]);
  for (int number = 1; number < kLinkCount; ++number) {
    Link link = read_link(links.element(static_cast<std::size_t>(number - 1)), number);
    model.links[static_cast<std::size_t>(link.connected_to)].has_children = true;
    model.links[static_cast<std::size_t>(number)] = std::move(link);
  }
}

void read_joint_limits(const ModelText& source, HumanModel& model) {
  const auto json = JsonNode::parse(source.file, source.text);
  const JsonNode angles = JsonNode(source.file, json).at("angles");
  if (angles.size() != kDegreesOfFreedom) angles.fail("must have 28 entries");
  for (std::size_t i = 0; i < kDegreesOfFreedom; ++i) {
    const JsonNode node = angles.element(i);
    DegreeOfFreedom& dof = model.degrees_of_freedom[i];
    dof.name = node.at("name").text();
    dof.link = node.at("link").whole(1, kLinkCount - 1);
    const double min_deg = node.at("min_deg").number(-360.0, 360.0);
    dof.min_rad = min_deg * kRadPerDeg;
    dof.max_rad = node.at("max_deg").number(min_deg, 360.0) * kRadPerDeg;
    dof.source = node.at("source").text();
  }
}

Eigen::Vector3f mirrored(const Eigen::Vector3f& left) { return {-left.x(), left.y(), left.z()}; }

/// Upper and lower link of the arms (4 to 7) or legs (12 to 15).
struct Limb {
  Eigen::Vector3f upper, lower;
};

Limb read_limb(const JsonNode& limbs, const JsonNode& name) {
  if (!limbs.has(name.text())) name.fail("is '" + name.text() + "', which the file does not list");
  const JsonNode limb = limbs.at(name.text());
  return {limb.at("upper").direction(), limb.at("lower").direction()};
}

TypicalPose read_pose(const JsonNode& root, const JsonNode& node) {
  const JsonNode trunk = root.at("trunk");
  const Limb left = read_limb(root.at("arms"), node.at("arm_left"));
  const Limb right = read_limb(root.at("arms"), node.at("arm_right"));
  const Limb leg = read_limb(root.at("legs"), node.at("legs"));
  TypicalPose pose;
  pose.name =
      node.at("arm_left").text() + "/" + node.at("arm_right").text() + "/" + node.at("legs").text();
  auto& d = pose.directions;
  d[0] = Eigen::Vector3f::Zero();
  d[1] = trunk.at("neck").direction();
  d[2] = trunk.at("shoulder").direction();
  d[3] = mirrored(d[2]);
  d[4] = left.upper;
  d[5] = left.lower;
  d[6] = mirrored(right.upper);
  d[7] = mirrored(right.lower);
  d[8] = trunk.at("upper_back").direction();
  d[9] = trunk.at("lower_back").direction();
  d[10] = trunk.at("hip").direction();
  d[11] = mirrored(d[10]);
  d[12] = leg.upper;
  d[13] = leg.lower;
  d[14] = mirrored(leg.upper);
  d[15] = mirrored(leg.lower);
  return pose;
}

void read_typical_poses(const ModelText& source, HumanModel& model) {
  const auto json = JsonNode::parse(source.file, source.text);
  const JsonNode root(source.file, json);
  model.rotation_step_rad = root.at("rotation").at("step_deg").number(1.0, 360.0) * kRadPerDeg;
  model.rotation_count = root.at("rotation").at("count").whole(1, 360);
  const JsonNode poses = root.at("poses");
  if (poses.size() != kTypicalPoseCount) poses.fail("must have 27 entries");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    model.typical_poses.push_back(read_pose(root, poses.element(i)));
  }
}

}  // namespace

HumanModel scaled(HumanModel model, double scale) {
  for (Link& link : model.links) {
    link.length_m *= scale;
    link.min_length_m *= scale;
    link.max_length_m *= scale;
  }
  return model;
}

HumanModel load_human_model(const HumanModelFiles& files) {
  HumanModel model;
  read_links(find_text(files.links), model);
  read_joint_limits(find_text(files.joint_limits), model);
  read_typical_poses(find_text(files.typical_poses), model);
  return model;
}

}  // namespace limbcast
