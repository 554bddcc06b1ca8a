#include "common/lcm_io/decode.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"
#include "tests/common/codec/codec_values.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(Decode, RejectsForeignAndTruncatedBytes) {
  const point_cloud_t message = to_message(camera_cloud());
  const std::vector<std::uint8_t> bytes = encode(message);
  EXPECT_NO_THROW(decode<point_cloud_t>(bytes));
  EXPECT_THROW(decode<segments_t>(bytes), MessageError);
  for (const std::size_t size : {0U, 4U, 8U, 40U, 100U}) {
    std::vector<std::uint8_t> torn(bytes.begin(),
                                   bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(decode<point_cloud_t>(torn), MessageError) << size << " bytes";
  }
}

}  // namespace
}  // namespace limbcast::lcm_io
