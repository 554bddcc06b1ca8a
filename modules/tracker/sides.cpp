#include "modules/tracker/sides.hpp"

#include <array>
#include <utility>

#include "common/human_model/mean_joint_distance.hpp"

namespace limbcast::tracker {
namespace {

constexpr std::array<Joint, 6> kLeftJoints = {Joint::kShoulderLeft, Joint::kElbowLeft,
                                              Joint::kWristLeft,    Joint::kHipLeft,
                                              Joint::kKneeLeft,     Joint::kAnkleLeft};

Side opposite(Side side) { return side == Side::kLeft ? Side::kRight : Side::kLeft; }

}  // namespace

BodyPose with_sides_exchanged(const BodyPose& pose) {
  BodyPose exchanged = pose;
  for (const Joint left : kLeftJoints) {
    const Joint right = on_side(left, Side::kRight);
    std::swap(exchanged[left], exchanged[right]);
    std::swap(exchanged.link_lengths_m[index(left)], exchanged.link_lengths_m[index(right)]);
  }
  for (Pointing& pointing : exchanged.pointing) pointing.side = opposite(pointing.side);
  exchanged.angles_rad = untold_angles();
  return exchanged;
}

float gain_of_exchange_m(const BodyPose& expected, const BodyPose& pose) {
  MeanJointDistance as_named, exchanged;
  for (const Joint left : kLeftJoints) {
    const Joint right = on_side(left, Side::kRight);
    as_named.add(expected[left], pose[left]);
    as_named.add(expected[right], pose[right]);
    exchanged.add(expected[left], pose[right]);
    exchanged.add(expected[right], pose[left]);
  }
  if (!as_named.mean_m() || !exchanged.mean_m()) return 0.0F;
  return *as_named.mean_m() - *exchanged.mean_m();
}

}  // namespace limbcast::tracker
