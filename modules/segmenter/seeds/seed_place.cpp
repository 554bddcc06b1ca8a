#include "modules/segmenter/seeds/seed_place.hpp"

namespace limbcast::segmenter {
namespace {

constexpr float kCenterBehindSurface_m = 0.09F;

}  // namespace

Eigen::Vector3f behind_surface(const Eigen::Vector3f& seed_m) {
  return seed_m + kCenterBehindSurface_m * seed_m.normalized();
}

Eigen::Vector3f surface_before(const Eigen::Vector3f& center_m) {
  return center_m - kCenterBehindSurface_m * center_m.normalized();
}

}  // namespace limbcast::segmenter
