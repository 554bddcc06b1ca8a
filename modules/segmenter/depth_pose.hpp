#pragma once

#include <memory>
#include <optional>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/instance_pool.hpp"
#include "modules/segmenter/tflite_network.hpp"

namespace limbcast::segmenter {

/// limbcast's own network of poses (models/README.md): sees a person's joints in depths alone, left
/// and right from how a body is built, and how far away each is. Trained on simulated people by
/// tests/segmenter/train_depth_pose.sh. Several threads may use one object.
class DepthPose {
 public:
  /// A file that is part of the program; the same at each call.
  static const TfliteFile& file();

  explicit DepthPose(const DepthPoseParams& params);

  /// Joints in the pixels of the image that `view` is a part of; see draw_depths().
  std::optional<ImagePose> look(const RangeImage& view, const Eigen::Vector3f& head_m,
                                const Eigen::Vector3f& down) const;
  /// Whether the log odds of a person are at least so high, as look() tells them. For most things
  /// one look of the network is enough.
  bool shows_person(const RangeImage& view, const Eigen::Vector3f& head_m,
                    const Eigen::Vector3f& down, float min_person_odds) const;

 private:
  DepthPoseParams params_;
  std::unique_ptr<InstancePool<TfliteNetwork>> networks_;
};

}  // namespace limbcast::segmenter
