#include "common/human_model/joints.hpp"

#include <algorithm>

namespace limbcast {

std::optional<Joint> joint_from_name(std::string_view name) {
  const auto found = std::find(kJointNames.begin(), kJointNames.end(), name);
  if (found == kJointNames.end()) return std::nullopt;
  return static_cast<Joint>(found - kJointNames.begin());
}

}  // namespace limbcast
