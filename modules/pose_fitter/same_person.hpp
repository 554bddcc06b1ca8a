#pragma once

#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::pose_fitter {

/// Two bodies closer than this, trunk on trunk, are one person seen twice [m]: a trunk is about 20
/// cm deep and 30 wide, so those of two people cannot be nearer.
inline constexpr float kSameTrunkM = 0.20F;

/// Whether both poses stand in one place: the mean distance of the trunk's joints (neck, chest,
/// pelvis, shoulders, hips; any order of left and right) that both have, or of the heads where they
/// share none.
bool same_place(const BodyPose& a, const BodyPose& b);

/// Drops, of each two bodies in one place, the less confident one (of equal ones the later), and
/// keeps the order of the others.
void remove_double_reports(std::vector<BodyPose>& persons);

}  // namespace limbcast::pose_fitter
