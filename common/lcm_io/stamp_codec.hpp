#pragma once

#include <limbcast/stamp_t.hpp>

#include "common/cloud/cloud.hpp"

namespace limbcast::lcm_io {

stamp_t to_message(const Stamp& stamp);
/// Throws MessageError unless all numbers are finite, `down` is a unit vector and the sensor has a
/// name.
Stamp from_message(const stamp_t& message);

}  // namespace limbcast::lcm_io
