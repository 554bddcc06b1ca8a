#include "common/lcm_io/stamp_codec.hpp"

#include <gtest/gtest.h>

#include "common/lcm_io/message_error.hpp"
#include "tests/common/codec/codec_values.hpp"
#include "tests/common/infinite_numbers.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(StampCodec, CarriesEveryField) {
  const Stamp stamp = test_stamp();
  const Stamp back = from_message(to_message(stamp));
  EXPECT_EQ(back.utime, stamp.utime);
  EXPECT_EQ(back.sequence, stamp.sequence);
  EXPECT_EQ(back.sensor, stamp.sensor);
  EXPECT_EQ(back.frame, stamp.frame);
  EXPECT_EQ(back.gravity.down, stamp.gravity.down);
  EXPECT_EQ(back.gravity.source, stamp.gravity.source);
  EXPECT_EQ(back.gravity.sensor_height_m, stamp.gravity.sensor_height_m);
  EXPECT_EQ(back.depth_noise.quadratic_per_m, stamp.depth_noise.quadratic_per_m);
}

TEST(StampCodec, CarriesAnUnknownHeight) {
  Stamp stamp = test_stamp();
  stamp.gravity.sensor_height_m.reset();
  EXPECT_FALSE(from_message(to_message(stamp)).gravity.sensor_height_m.has_value());
}

TEST(StampCodec, RejectsWhatIsNotFinite) {
  const stamp_t good = to_message(test_stamp());
  stamp_t bad = good;
  bad.down[1] = kNaN;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.sensor_height_m = kInfinity;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.noise_quadratic_per_m = -1.0F;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.gravity_source = 77;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.sensor.clear();
  EXPECT_THROW(from_message(bad), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
