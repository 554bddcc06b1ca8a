#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/image_params.hpp"
#include "modules/segmenter/instance_pool.hpp"

namespace limbcast::segmenter {

/// Looks for faces where heads are known, with the boosted cascades that OpenCV ships (P. Viola, M.
/// Jones, "Robust real-time face detection", IJCV 57(2), 2004): their hits tell who faces the
/// sensor. Several threads may use one object.
class FaceFinder {
 public:
  explicit FaceFinder(const FaceParams& params);
  ~FaceFinder();

  /// Why no faces are looked for, and what to do; empty where they are, or nobody wants them.
  const std::string& problem() const { return problem_; }
  /// What the hits around a head tell. The head's centre is in the cloud's frame, `up_px` its "up"
  /// in the image. Nothing is told without colour and camera, and of a head too small to see.
  FaceEvidence look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                    const Eigen::Vector2f& up_px) const;

 private:
  class Cascades;

  FaceParams params_;
  std::unique_ptr<InstancePool<Cascades>> cascades_;
  std::string problem_;
};

}  // namespace limbcast::segmenter
