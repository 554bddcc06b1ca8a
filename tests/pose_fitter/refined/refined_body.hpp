#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/pose_fitter/refined/body_state.hpp"

namespace limbcast::pose_fitter::testing {

inline constexpr double kDegree = M_PI / 180.0;

/// The camera of the synthetic views: VGA, 520 px, 1.2 m over the floor, level.
PinholeCamera camera();
Stamp stamp();

/// A body of 1.75 m that stands `distance_m` away, turned by `yaw_rad` from facing the camera, arms
/// hanging.
refined::BodyState standing_body(double distance_m, double yaw_rad);
/// Puts the straight arm of `side` (0 left) along `direction` (camera frame), the shoulder with it.
void point_with(refined::BodyState& body, int side, const Eigen::Vector3d& direction);

/// What a sensor without noise sees of the body before a wall 2 m behind it. `occluder_u`: columns
/// from there on are hidden by a board 0.6 m before the body.
Segment seen(const refined::BodyState& body, int occluder_u = 1 << 20,
             const PinholeCamera& image_camera = camera());
/// The same person, seen by a camera with colours: none of it is skin.
Segment colored(Segment segment);
/// A body as a perfect network for poses would see it.
ImagePose in_image(const refined::BodyState& body, ImageNetwork network = ImageNetwork::kBlazePose);
/// What a segment tells where the network of depths alone looked.
std::vector<ImagePose> in_depths(const refined::BodyState& body);

}  // namespace limbcast::pose_fitter::testing
