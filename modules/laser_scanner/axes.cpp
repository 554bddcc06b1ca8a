#include "modules/laser_scanner/axes.hpp"

#include <Eigen/LU>
#include <sstream>

#include "common/input_error.hpp"

namespace limbcast::laser_scanner {
namespace {

[[noreturn]] void fail(const std::string& text) {
  throw InputError(
      "'axes' is '" + text +
      "', must name the sensor's axes that point right, down and forward, like -y,-z,x");
}

/// Row that picks a signed axis, e.g. "-y".
Eigen::RowVector3f picked(const std::string& name, const std::string& text) {
  const bool is_negative = !name.empty() && name.front() == '-';
  const std::string axis = is_negative ? name.substr(1) : name;
  if (axis != "x" && axis != "y" && axis != "z") fail(text);
  return (is_negative ? -1.0F : 1.0F) * Eigen::RowVector3f::Unit(axis.front() - 'x');
}

}  // namespace

Axes::Axes(const std::string& text, double unit_m) {
  std::istringstream names(text);
  Eigen::Matrix3f rotation;
  std::string name;
  for (int row = 0; row < 3; ++row) {
    if (!std::getline(names, name, ',')) fail(text);
    rotation.row(row) = picked(name, text);
  }
  const bool is_right_handed = rotation.determinant() > 0.5F;
  if (std::getline(names, name) || !is_right_handed) fail(text);
  metres_from_sensor_ = static_cast<float>(unit_m) * rotation;
}

}  // namespace limbcast::laser_scanner
