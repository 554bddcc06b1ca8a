#include "common/lcm_io/compression.hpp"

#include <gtest/gtest.h>

#include <random>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {
namespace {

TEST(Compression, GivesLatticesBackBitForBit) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(0, 65535);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 1}, {1, 9}, {64, 48}, {5, 7}, {2, 6}}) {
    std::vector<std::uint16_t> values(static_cast<std::size_t>(width) * height);
    for (auto& value : values) value = static_cast<std::uint16_t>(any(random));
    EXPECT_EQ(decode_lattice(encode_lattice(values, width, height), width, height), values);
  }
}

TEST(Compression, CodesResidualsToTheMedianPredictor) {
  // 33 is expected to be the median of 30, 20 and 30 + 20 - 10, which is 30. Zigzag doubles.
  const std::vector<std::uint8_t> planes = {20, 20, 40, 6, 0, 0, 0, 0};
  EXPECT_EQ(decompress(encode_lattice({10, 20, 30, 33}, 2, 2), planes.size()), planes);
}

TEST(Compression, GivesSequencesBackAtTheirExtremes) {
  const std::vector<std::int16_t> values = {0, 32767, -32768, 5, -5, 32767, -32768};
  EXPECT_EQ(decode_sequence(encode_sequence(values), values.size()), values);
  EXPECT_TRUE(decode_sequence(encode_sequence({}), 0).empty());
}

TEST(Compression, CodesASmoothNoisyLatticeInAboutItsEntropy) {
  // A slope with +-2 steps of noise: about 3 bits a value, so well under half a byte more than
  // that.
  constexpr int kSide = 200;
  std::mt19937 random(2);
  std::uniform_int_distribution<int> noise(-2, 2);
  std::vector<std::uint16_t> values(kSide * kSide);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::uint16_t>(2000 + i / kSide * 3 + noise(random));
  EXPECT_LT(encode_lattice(values, kSide, kSide).size(), values.size() / 2 + values.size() / 16);
}

TEST(Compression, RejectsDamagedAndMislabelledData) {
  std::vector<std::uint8_t> frame = encode_lattice(std::vector<std::uint16_t>(100, 7), 10, 10);
  EXPECT_THROW(decode_lattice(frame, 10, 11), MessageError);
  EXPECT_THROW(decode_lattice({}, 10, 10), MessageError);
  frame.resize(frame.size() / 2);
  EXPECT_THROW(decode_lattice(frame, 10, 10), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
