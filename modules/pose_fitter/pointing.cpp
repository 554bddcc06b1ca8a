#include "modules/pose_fitter/pointing.hpp"

#include <algorithm>
#include <optional>

#include "common/angle.hpp"

namespace limbcast::pose_fitter {
namespace {

using Eigen::Vector3f;

struct RatedPointing {
  Pointing pointing;
  double rating_deg;  ///< raised counts, bent counts half against it
};

std::optional<RatedPointing> rate_arm(const BodyPose& body, Side side, const Vector3f& trunk,
                                      const PointingParams& params) {
  const JointEstimate& shoulder = body[on_side(Joint::kShoulderLeft, side)];
  const JointEstimate& elbow = body[on_side(Joint::kElbowLeft, side)];
  const JointEstimate& wrist = body[on_side(Joint::kWristLeft, side)];
  if (!shoulder.valid || !elbow.valid || !wrist.valid) return std::nullopt;
  const Vector3f upper = elbow.position_m - shoulder.position_m;
  const Vector3f fore = wrist.position_m - elbow.position_m;
  const Vector3f arm = wrist.position_m - shoulder.position_m;
  const double bend_deg = angle_deg(upper, fore);
  const double raise_deg = angle_deg(arm, trunk);
  if (bend_deg > params.max_elbow_bend_deg || raise_deg < params.min_raise_deg) return std::nullopt;
  Pointing pointing;
  pointing.side = side;
  pointing.direction = arm.normalized();
  pointing.forearm = fore.normalized();
  if (body[Joint::kHead].valid) {
    pointing.head_hand = (wrist.position_m - body[Joint::kHead].position_m).normalized();
  }
  pointing.confidence = std::min({shoulder.confidence, elbow.confidence, wrist.confidence});
  return RatedPointing{pointing, raise_deg - 0.5 * bend_deg};
}

}  // namespace

std::vector<Pointing> find_pointing(const BodyPose& body, const Vector3f& down,
                                    const PointingParams& params) {
  const JointEstimate& neck = body[Joint::kNeck];
  const JointEstimate& pelvis = body[Joint::kPelvis];
  const Vector3f trunk =
      neck.valid && pelvis.valid ? Vector3f(pelvis.position_m - neck.position_m) : down;
  std::vector<RatedPointing> arms;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (const auto arm = rate_arm(body, side, trunk, params)) arms.push_back(*arm);
  }
  if (arms.size() == 2 && arms[1].rating_deg > arms[0].rating_deg) std::swap(arms[0], arms[1]);
  std::vector<Pointing> pointing;
  for (const RatedPointing& arm : arms) pointing.push_back(arm.pointing);
  return pointing;
}

}  // namespace limbcast::pose_fitter
