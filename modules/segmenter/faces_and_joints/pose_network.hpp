#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/faces_and_joints/color_patch.hpp"
#include "modules/segmenter/faces_and_joints/labelled_person.hpp"
#include "modules/segmenter/faces_and_joints/picture_network.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/networks/instance_pool.hpp"

namespace limbcast::segmenter {

/// Sees a person's joints with a network for pictures. Several threads may use one object.
class PoseNetwork {
 public:
  explicit PoseNetwork(const PoseNetworkParams& params,
                       PictureNetworkKind kind = PictureNetworkKind::kBlazePose);
  ~PoseNetwork();

  /// In the colour image. `down` is gravity's direction in the cloud's frame. Other people are
  /// painted over, since the network tells of one. Nothing without colour and camera, and of a
  /// person too small to see.
  std::optional<ImagePose> look(const Cloud& cloud, const LabelledPerson& person,
                                const Eigen::Vector3f& down) const;

 private:
  std::optional<UprightSquare> square_around(const PinholeCamera& camera,
                                             const Eigen::Vector3f& head_m,
                                             const Eigen::Vector3f& down) const;

  PoseNetworkParams params_;
  std::unique_ptr<InstancePool<PictureNetwork>> networks_;
};

}  // namespace limbcast::segmenter
