#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/color_patch.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/instance_pool.hpp"
#include "modules/segmenter/labelled_person.hpp"
#include "modules/segmenter/picture_network.hpp"

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

  /// In a picture of the person's surface (shaded_surface.hpp), for clouds without colour or
  /// camera. The joints' pixels are those of the image that `view` is a part of. The network takes
  /// front for back as often as not, since nothing has a face.
  std::optional<ImagePose> look_at_surface(const Cloud& cloud, const LabelledPerson& person,
                                           const Eigen::Vector3f& down,
                                           const RangeImage& view) const;

 private:
  std::optional<UprightSquare> square_around(const PinholeCamera& camera,
                                             const Eigen::Vector3f& head_m,
                                             const Eigen::Vector3f& down) const;

  PoseNetworkParams params_;
  std::unique_ptr<InstancePool<PictureNetwork>> networks_;
};

}  // namespace limbcast::segmenter
