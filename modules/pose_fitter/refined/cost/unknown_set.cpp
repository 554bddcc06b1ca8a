#include "modules/pose_fitter/refined/cost/unknown_set.hpp"

#include <algorithm>
#include <functional>

namespace limbcast::pose_fitter::refined {
namespace {

UnknownSet make_set(unsigned parts) {
  UnknownSet set;
  const auto add_point = [&](int point) {
    for (int axis = 0; axis < 3; ++axis) set.unknowns[set.count++] = 3 * point + axis;
  };
  const bool trunk = (parts & bit(Part::kTrunk)) != 0;
  for (int side = 0; side < 2; ++side) {
    if ((parts & arm_bit(side)) == 0) continue;
    for (const int point : {kHand, kWrist, kElbow}) add_point(point + side);
    if (!trunk) add_point(kShoulder + side);
  }
  for (int side = 0; side < 2 && (parts & bit(Part::kLegs)) != 0; ++side) {
    for (const int point : {kToe, kAnkle, kKnee}) add_point(point + side);
  }
  if (trunk) {
    for (const int point :
         {static_cast<int>(kHead), kHip + 0, kHip + 1, static_cast<int>(kChest),
          static_cast<int>(kPelvis), kShoulder + 0, kShoulder + 1, static_cast<int>(kNeck)}) {
      add_point(point);
    }
    for (int i = kLogStature; i < kUnknownCount; ++i) set.unknowns[set.count++] = i;
  }
  for (int i = 0; i < set.count; ++i) set.contains[set.unknowns[i]] = true;
  return set;
}

void find_places(UnknownSet& set) {
  for (int j = 0; j < set.count; ++j) {
    for (int i = j; i < set.count; ++i) {
      const auto [row, column] = std::minmax(set.unknowns[i], set.unknowns[j], std::greater<>());
      set.hessian_places.push_back(static_cast<std::uint16_t>(column * kUnknownCount + row));
    }
  }
}

}  // namespace

const UnknownSet& unknowns_of(unsigned parts) {
  static const std::array<UnknownSet, kAllParts + 1> sets = [] {
    std::array<UnknownSet, kAllParts + 1> all;
    for (unsigned i = 0; i <= kAllParts; ++i) {
      all[i] = make_set(i);
      find_places(all[i]);
    }
    return all;
  }();
  return sets[parts];
}

}  // namespace limbcast::pose_fitter::refined
