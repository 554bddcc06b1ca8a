#include "common/lcm_io/stamp_codec.hpp"

#include <cmath>
#include <limits>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {

stamp_t to_message(const Stamp& stamp) {
  stamp_t message{};
  message.utime = stamp.utime;
  message.sequence = stamp.sequence;
  message.sensor = stamp.sensor;
  message.frame = stamp.frame;
  for (int i = 0; i < 3; ++i) message.down[i] = stamp.gravity.down[i];
  message.gravity_source = static_cast<std::int8_t>(stamp.gravity.source);
  message.sensor_height_m =
      stamp.gravity.sensor_height_m.value_or(std::numeric_limits<float>::quiet_NaN());
  message.noise_constant_m = stamp.depth_noise.constant_m;
  message.noise_quadratic_per_m = stamp.depth_noise.quadratic_per_m;
  return message;
}

Stamp from_message(const stamp_t& message) {
  constexpr float kUnitTolerance = 0.01F;
  Stamp stamp;
  stamp.utime = message.utime;
  stamp.sequence = message.sequence;
  stamp.sensor = message.sensor;
  stamp.frame = message.frame;
  require(!stamp.sensor.empty(), "stamp: 'sensor' is empty");
  stamp.gravity.down = {message.down[0], message.down[1], message.down[2]};
  require(std::abs(stamp.gravity.down.norm() - 1.0F) < kUnitTolerance,
          "stamp: 'down' is no unit vector");
  require(message.gravity_source >= stamp_t::GRAVITY_RECORDING &&
              message.gravity_source <= stamp_t::GRAVITY_LEVEL,
          "stamp: unknown 'gravity_source'");
  stamp.gravity.source = static_cast<GravitySource>(message.gravity_source);
  require(!std::isinf(message.sensor_height_m), "stamp: 'sensor_height_m' is infinite");
  if (!std::isnan(message.sensor_height_m)) stamp.gravity.sensor_height_m = message.sensor_height_m;
  stamp.depth_noise = {message.noise_constant_m, message.noise_quadratic_per_m};
  require(std::isfinite(message.noise_constant_m) && message.noise_constant_m >= 0.0F &&
              std::isfinite(message.noise_quadratic_per_m) && message.noise_quadratic_per_m >= 0.0F,
          "stamp: noise is negative or not finite");
  return stamp;
}

}  // namespace limbcast::lcm_io
