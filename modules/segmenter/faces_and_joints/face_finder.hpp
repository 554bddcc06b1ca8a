#pragma once

#include <Eigen/Core>
#include <memory>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/faces_and_joints/blaze_face.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/networks/instance_pool.hpp"

namespace limbcast::segmenter {

/// Looks for faces where heads are known: they tell who faces the sensor. Several threads may use
/// one object.
class FaceFinder {
 public:
  explicit FaceFinder(const FaceParams& params);

  /// What is seen of a face tells. The head's centre is in the cloud's frame, `up_px` its "up" in
  /// the image. Nothing is told without colour and camera, and of a head too small to see.
  FaceEvidence look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                    const Eigen::Vector2f& up_px) const;

 private:
  FaceParams params_;
  std::unique_ptr<InstancePool<BlazeFace>> networks_;
};

}  // namespace limbcast::segmenter
