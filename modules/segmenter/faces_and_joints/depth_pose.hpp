#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>

#include "common/cloud/segment.hpp"
#include "common/human_model/joints.hpp"
#include "modules/segmenter/faces_and_joints/depth_picture.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/networks/instance_pool.hpp"
#include "modules/segmenter/networks/tflite_network.hpp"

namespace limbcast::segmenter {

/// A person's joints as the network of depths sees them.
struct PoseInDepths {
  float person_score = 0.0F;  ///< 0 to 1, how sure the network is that somebody is there
  std::array<Eigen::Vector3f, kJointCount> places_m;  ///< in the cloud's frame
  std::array<float, kJointCount> visibilities;        ///< 0 to 1, in sight and there
  std::array<float, kJointCount> spreads_m;           ///< across the ray, standard deviations
};

/// The same in the pixels of the image that `view` is a part of; nothing where a joint is not
/// before it.
std::optional<ImagePose> in_pixels(const PoseInDepths& pose, const RangeImage& view);

/// limbcast's own networks of poses (../models/README.md), one for cameras and one for scans: they
/// see a person's joints in depths alone, left and right from how a body is built, and how far away
/// each is. Where they are not sure of a person a third one is asked, which knows people who bow,
/// kneel, sit on the ground or hold something large, and is believed where it is surer. Trained on
/// simulated people by tests/segmenter/train_depth_pose.sh. Several threads may use one object.
class DepthPose {
 public:
  explicit DepthPose(const DepthPoseParams& params);

  /// Nothing where the network is switched off.
  std::optional<PoseInDepths> look(const DepthPicture& picture) const;
  /// The same; nothing either where the log odds of a person are lower than that: for most things
  /// one look of the network tells it, instead of two.
  std::optional<PoseInDepths> see_person(const DepthPicture& picture, float min_person_odds) const;

 private:
  DepthPoseParams params_;
  std::unique_ptr<InstancePool<TfliteNetwork>> of_cameras_, of_scans_, of_bent_;
};

}  // namespace limbcast::segmenter
