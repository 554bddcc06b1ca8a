#pragma once

#include "common/human_model/body_pose.hpp"

namespace limbcast::tracker {

/// The same pose with left and right exchanged. Its angles are left out, as they would be others.
BodyPose with_sides_exchanged(const BodyPose& pose);

/// How much nearer to the expected joints those of the pose are with left and right exchanged: mean
/// over the joints that both know [m]; 0 where there are none, negative where the sides fit.
float gain_of_exchange_m(const BodyPose& expected, const BodyPose& pose);

}  // namespace limbcast::tracker
