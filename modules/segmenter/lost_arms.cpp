#include "modules/segmenter/lost_arms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "modules/segmenter/surfaces.hpp"

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

}  // namespace

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
