#include "modules/tracker/sides.hpp"

#include <array>
#include <limits>
#include <utility>

namespace limbcast::tracker {
namespace {

constexpr std::array<Joint, 6> kLeftJoints = {Joint::kShoulderLeft, Joint::kElbowLeft,
                                              Joint::kWristLeft,    Joint::kHipLeft,
                                              Joint::kKneeLeft,     Joint::kAnkleLeft};

struct MeanDistance {
  float sum_m = 0.0F;
  int count = 0;
  void add(const JointEstimate& a, const JointEstimate& b) {
    if (!a.valid || !b.valid) return;
    sum_m += (a.position_m - b.position_m).norm();
    ++count;
  }
  float value_m() const { return count == 0 ? 0.0F : sum_m / static_cast<float>(count); }
};

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
  exchanged.angles_rad.fill(std::numeric_limits<float>::quiet_NaN());
  return exchanged;
}

float gain_of_exchange_m(const BodyPose& expected, const BodyPose& pose) {
  MeanDistance as_named, exchanged;
  for (const Joint left : kLeftJoints) {
    const Joint right = on_side(left, Side::kRight);
    as_named.add(expected[left], pose[left]);
    as_named.add(expected[right], pose[right]);
    exchanged.add(expected[left], pose[right]);
    exchanged.add(expected[right], pose[left]);
  }
  if (as_named.count == 0 || exchanged.count == 0) return 0.0F;
  return as_named.value_m() - exchanged.value_m();
}

}  // namespace limbcast::tracker
