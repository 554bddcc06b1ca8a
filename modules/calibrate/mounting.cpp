#include "modules/calibrate/mounting.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/cloud/ground_plane.hpp"
#include "common/formatted.hpp"
#include "common/median.hpp"
#include "common/units.hpp"

namespace limbcast::calibrate {
namespace {

Eigen::Vector3d median_direction(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& direction : directions) values.push_back(direction[axis]);
    result[axis] = median(std::move(values));
  }
  return result.normalized();
}

}  // namespace

void MountingFinder::add(const Cloud& cloud) {
  ++frames_;
  const auto ground = find_ground_plane(cloud, Eigen::Vector3f::UnitY(), where_gravity_is_untold());
  if (!ground) return;
  downs_.push_back(ground->down.cast<double>());
  heights_m_.push_back(ground->height_m);
}

Mounting MountingFinder::mounting() const {
  if (frames_with_ground() < params_.min_frames)
    throw std::runtime_error(
        formatted("%d of %d frames show the ground; let the camera see the free "
                  "floor, level or tipped by less than 30 degrees",
                  frames_with_ground(), frames_));
  Mounting mounting;
  mounting.down = median_direction(downs_);
  mounting.sensor_height_m = median(heights_m_);
  std::vector<double> angles_deg;
  std::vector<double> differences_m;
  for (std::size_t i = 0; i < downs_.size(); ++i) {
    angles_deg.push_back(kDegreesPerRadian<double> *
                         std::acos(std::min(1.0, downs_[i].dot(*mounting.down))));
    differences_m.push_back(std::abs(heights_m_[i] - *mounting.sensor_height_m));
  }
  if (median(angles_deg) > params_.max_spread_deg || median(differences_m) > params_.max_spread_m)
    throw std::runtime_error(formatted(
        "the frames do not agree: gravity within %.1f degrees (limit %.0f), "
        "height within %.2f m (limit %.1f); did the camera move?",
        median(angles_deg), params_.max_spread_deg, median(differences_m), params_.max_spread_m));
  return mounting;
}

}  // namespace limbcast::calibrate
