#include "modules/segmenter/seeds/seed_place.hpp"

#include "common/cloud/head_depth.hpp"

namespace limbcast::segmenter {
namespace {

constexpr auto kDepth_m = static_cast<float>(kHeadBehindSeed_m);

}  // namespace

Eigen::Vector3f behind_surface(const Eigen::Vector3f& seed_m) {
  return seed_m + kDepth_m * seed_m.normalized();
}

Eigen::Vector3f surface_before(const Eigen::Vector3f& center_m) {
  return center_m - kDepth_m * center_m.normalized();
}

}  // namespace limbcast::segmenter
