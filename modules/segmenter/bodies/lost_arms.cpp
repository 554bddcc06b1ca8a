#include "modules/segmenter/bodies/lost_arms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "modules/segmenter/bodies/same_person.hpp"
#include "modules/segmenter/scene/surfaces.hpp"

namespace limbcast::segmenter {
namespace {

/// Places on a forearm from the elbow, 0, to the wrist, 1, and on to the fingers.
constexpr std::array<float, 6> kAlongForearm = {0.0F, 0.25F, 0.5F, 0.75F, 1.0F, 1.25F};

/// Null where it is not seen.
const ImageJoint* find_visible(const ImagePose& pose, Joint joint, float min_visibility) {
  const auto found =
      std::find_if(pose.joints.begin(), pose.joints.end(), [&](const ImageJoint& seen) {
        return seen.joint == joint && seen.visibility >= min_visibility;
      });
  return found == pose.joints.end() ? nullptr : &*found;
}

/// Looks for surfaces under forearms and gives each to whom it meets first.
class LostArms {
 public:
  LostArms(const Scene& scene, const std::vector<std::int16_t>& labels, const LostArmParams& params)
      : scene_(scene),
        params_(params),
        labels_(scene.lattice.size(), kNobody),
        added_(scene.lattice.size(), kNobody) {
    // What the depths leave unsure may be an arm.
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (scene.lattice.depth_m[i] > 0.0F)
        labels_[i] = std::max(kNobody, labels[scene.lattice.source[i]]);
    }
  }

  void look(const Segment& segment, std::int16_t label) {
    if (!segment.valid() || segment.image_poses.empty()) return;
    const ImagePose& pose = segment.image_poses.back();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const ImageJoint* elbow =
          find_visible(pose, on_side(Joint::kElbowLeft, side), params_.min_visibility);
      const ImageJoint* wrist =
          find_visible(pose, on_side(Joint::kWristLeft, side), params_.min_visibility);
      if (elbow == nullptr || wrist == nullptr) continue;
      for (const float along : kAlongForearm)
        take_surface_at(elbow->px + along * (wrist->px - elbow->px), segment.seed_m, label);
    }
  }

  /// Labels of the lattice's points that were taken.
  const std::vector<std::int16_t>& added() const { return added_; }
  bool any() const { return any_; }

 private:
  void take_surface_at(const Eigen::Vector2f& px, const Eigen::Vector3f& head_m,
                       std::int16_t label) {
    const Eigen::Vector2f lattice_px = px / static_cast<float>(scene_.step);
    const auto point = scene_.lattice.find(static_cast<int>(std::lround(lattice_px.x())),
                                           static_cast<int>(std::lround(lattice_px.y())));
    if (!point || labels_[*point] != kNobody) return;
    const Eigen::Vector3f& place_m = scene_.cloud.points_m[scene_.lattice.source[*point]];
    if ((place_m - head_m).norm() > params_.max_head_distance_m) return;
    // Most people's arms are whole: nobody's surfaces are parted where one is not.
    if (!surfaces_) surfaces_ = find_surfaces(scene_.lattice, params_.surface, &labels_);
    const std::int32_t name = surfaces_->of_point[*point];
    if (name < 0) return;
    const Surface& surface = surfaces_->all[static_cast<std::size_t>(name)];
    if (surface.area_m2 > params_.max_area_m2 || surface.extent_m > params_.max_extent_m) return;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (surfaces_->of_point[i] == name) labels_[i] = added_[i] = label;
    }
    any_ = true;
  }

  const Scene& scene_;
  const LostArmParams& params_;
  std::vector<std::int16_t> labels_, added_;
  std::optional<Surfaces> surfaces_;
  bool any_ = false;
};

/// Points of the cloud in each segment.
std::vector<int> count_points(const std::vector<std::int16_t>& labels, std::size_t segments) {
  std::vector<int> counts(segments, 0);
  for (const std::int16_t label : labels) {
    if (label >= 0) ++counts[static_cast<std::size_t>(label)];
  }
  return counts;
}

std::vector<std::int16_t> without(std::vector<std::int16_t> labels, std::int16_t label) {
  std::replace(labels.begin(), labels.end(), label, kNobody);
  return labels;
}

/// Whether the network sees the head where the person's segment began, and not the arm's.
bool marks_head(const ImagePose& pose, const PinholeCamera& camera, const Eigen::Vector3f& head_m,
                float max_error_m) {
  const ImageJoint* head = find_visible(pose, Joint::kHead, 0.0F);
  return head != nullptr &&
         (camera.back_project(head->px.x(), head->px.y(), head_m.z()) - head_m).norm() <=
             max_error_m;
}

bool marks_arm_in(const ImagePose& pose, const Cloud& cloud,
                  const std::vector<std::int16_t>& labels, std::int16_t label,
                  float min_visibility) {
  const std::array<Joint, 4> kArms = {Joint::kElbowLeft, Joint::kElbowRight, Joint::kWristLeft,
                                      Joint::kWristRight};
  return std::any_of(kArms.begin(), kArms.end(), [&](Joint joint) {
    const ImageJoint* seen = find_visible(pose, joint, min_visibility);
    if (seen == nullptr) return false;
    const auto u = static_cast<int>(std::lround(seen->px.x()));
    const auto v = static_cast<int>(std::lround(seen->px.y()));
    if (u < 0 || v < 0 || u >= cloud.width || v >= cloud.height) return false;
    return labels[static_cast<std::size_t>(v) * cloud.width + u] == label;
  });
}

}  // namespace

void join_arms_taken_for_heads(const Scene& scene, const PersonLook& look,
                               const LostArmParams& params, std::vector<Segment>& segments,
                               std::vector<std::int16_t>& labels) {
  const PinholeCamera& camera = *scene.cloud.camera;
  const std::vector<int> points = count_points(labels, segments.size());
  const auto area_m2 = [&](std::size_t k) {
    const auto side_m = segments[k].seed_m.z() / static_cast<float>(camera.fx);
    return static_cast<float>(points[k]) * side_m * side_m;
  };
  const auto is_arm_of = [&](std::size_t arm, std::size_t person) {
    const Eigen::Vector3f& head_m = segments[person].seed_m;
    if (arm == person || !segments[person].valid() ||
        area_m2(person) < params.min_person_areas * area_m2(arm) ||
        (head_m - segments[arm].seed_m).norm() > params.max_seeds_apart_m)
      return false;
    const auto label = static_cast<std::int16_t>(arm);
    const auto pose = look(without(labels, label), static_cast<std::int16_t>(person));
    return pose && marks_head(*pose, camera, head_m, params.max_head_error_m) &&
           marks_arm_in(*pose, scene.cloud, labels, label, params.min_visibility);
  };
  for (std::size_t arm = 0; arm < segments.size(); ++arm) {
    // A body whose head is out of sight was asked for by itself.
    if (!segments[arm].valid() || segments[arm].seed_kind == SeedKind::kBody ||
        area_m2(arm) > params.max_taken_area_m2)
      continue;
    for (std::size_t person = 0; person < segments.size(); ++person) {
      if (!is_arm_of(arm, person)) continue;
      give_to_same_person(arm, person, segments, labels);
      break;
    }
  }
}

std::vector<std::int16_t> add_lost_arms(const Scene& scene, const std::vector<Segment>& segments,
                                        std::vector<std::int16_t> labels, const Params& params) {
  LostArms arms(scene, labels, params.lost_arms);
  for (std::size_t k = 0; k < segments.size(); ++k)
    arms.look(segments[k], static_cast<std::int16_t>(k));
  if (!arms.any()) return labels;
  const std::vector<std::int16_t> added = labels_of_cloud(scene, arms.added(), params.joint);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0 && added[i] >= 0) labels[i] = added[i];
  }
  return labels;
}

}  // namespace limbcast::segmenter
