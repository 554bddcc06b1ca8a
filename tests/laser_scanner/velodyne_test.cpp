#include "modules/laser_scanner/velodyne.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/laser_scanner/velodyne_packets.hpp"

namespace limbcast::laser_scanner {
namespace {

std::vector<Sweep> sweeps_of(const std::vector<std::vector<std::uint8_t>>& packets) {
  VelodyneDecoder decoder(VelodyneModel::kVlp16);
  std::vector<Sweep> sweeps;
  std::int64_t utime = 0;
  for (const auto& packet : packets) {
    if (auto sweep = decoder.add(packet, utime += 1000)) sweeps.push_back(std::move(*sweep));
  }
  return sweeps;
}

TEST(Velodyne, CutsTurnsBehindItself) {
  const std::vector<Sweep> sweeps = sweeps_of(vlp16_turns(3, 4.0));

  // From the front: half a turn that is left out, two whole ones, half a turn that did not end.
  ASSERT_EQ(sweeps.size(), 2U);
  for (const Sweep& sweep : sweeps) {
    EXPECT_EQ(sweep.points_m.size(), kReturnsOfATurn);
    // The cut is behind: the first and the last point lie at negative y, within a block of x = 0.
    EXPECT_LT(sweep.points_m.front().y(), -3.8F);
    EXPECT_LT(sweep.points_m.back().y(), -3.8F);
  }
  EXPECT_NEAR(static_cast<double>(sweeps[1].utime - sweeps[0].utime), 75'000.0, 1'000.0);
}

/// Turns of a scanner whose packets stop for so long, in the middle of the second whole turn.
std::vector<Sweep> sweeps_around_a_pause(std::int64_t pause_us) {
  VelodyneDecoder decoder(VelodyneModel::kVlp16);
  std::vector<Sweep> sweeps;
  const auto packets = vlp16_turns(5, 4.0);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const std::int64_t utime = 1000 * static_cast<std::int64_t>(i) + (i < 130 ? 0 : pause_us);
    if (auto sweep = decoder.add(packets[i], utime)) sweeps.push_back(std::move(*sweep));
  }
  return sweeps;
}

TEST(Velodyne, LeavesOutTheTurnDuringWhichItWasUnplugged) {
  const std::vector<Sweep> sweeps = sweeps_around_a_pause(4'000'000);
  ASSERT_EQ(sweeps.size(), 3U);
  for (const Sweep& sweep : sweeps) EXPECT_EQ(sweep.points_m.size(), kReturnsOfATurn);
  // One turn before and two after it, of which none is an average of both times.
  EXPECT_NEAR(static_cast<double>(sweeps[0].utime), 75'000.0, 1'000.0);
  EXPECT_NEAR(static_cast<double>(sweeps[1].utime), 4'225'000.0, 1'000.0);
}

TEST(Velodyne, KeepsATurnThatANetworkDelays) {
  EXPECT_EQ(sweeps_around_a_pause(10'000).size(), 4U);
}

TEST(Velodyne, PutsPacketsThatOthersOvertookWhereTheyBelong) {
  auto packets = vlp16_turns(4, 4.0);
  // Within the first whole turn, packets 37 to 112: one late by a packet, two late by three.
  std::swap(packets[50], packets[51]);
  std::rotate(packets.begin() + 80, packets.begin() + 82, packets.begin() + 85);
  // The one in whose middle the second whole turn ends.
  std::swap(packets[187], packets[188]);

  const std::vector<Sweep> sweeps = sweeps_of(packets);

  ASSERT_EQ(sweeps.size(), 3U);
  EXPECT_EQ(sweeps[0].points_m.size(), kReturnsOfATurn);
  // Six blocks came when their turn was given out.
  EXPECT_EQ(sweeps[1].points_m.size(), kReturnsOfATurn - 6 * 32);
  EXPECT_EQ(sweeps[2].points_m.size(), kReturnsOfATurn);
}

TEST(Velodyne, CutsTurnsOfANarrowFieldOfView) {
  // Packets 60 to 74 and 0 to 14 look up to 72 degrees aside; the scanner sends no others.
  const auto all_around = vlp16_turns(4, 4.0);
  std::vector<std::vector<std::uint8_t>> packets;
  for (std::size_t i = 0; i < all_around.size(); ++i) {
    if (i % 75 < 15 || i % 75 >= 60) packets.push_back(all_around[i]);
  }
  const std::vector<Sweep> sweeps = sweeps_of(packets);
  ASSERT_EQ(sweeps.size(), 3U);
  EXPECT_EQ(sweeps[1].points_m.size(), 30U * 12 * 32);
}

TEST(Velodyne, PlacesReturnsByAzimuthElevationAndDistance) {
  VelodyneDecoder decoder(VelodyneModel::kVlp16);
  const auto sweeps = sweeps_of(vlp16_turns(2, 4.0));
  ASSERT_EQ(sweeps.size(), 1U);
  // Block 450 of the turn starts at azimuth 0: its first laser looks 15 degrees down, the second 1
  // degree up.
  const Eigen::Vector3f& low = sweeps[0].points_m[450 * 32];
  EXPECT_NEAR(low.x(), 0.0, 1e-4);
  EXPECT_NEAR(low.y(), 4.0 * std::cos(15.0 * M_PI / 180.0), 1e-4);
  EXPECT_NEAR(low.z(), -4.0 * std::sin(15.0 * M_PI / 180.0), 1e-4);
  EXPECT_NEAR(sweeps[0].points_m[450 * 32 + 1].z(), 4.0 * std::sin(M_PI / 180.0), 1e-4);
  // The second firing of a block is half a block (0.2 degrees) later: to the right, as it turns
  // clockwise.
  const Eigen::Vector3f& later = sweeps[0].points_m[450 * 32 + 16];
  EXPECT_NEAR(later.x(), low.y() * std::tan(0.2 * M_PI / 180.0), 1e-4);
}

TEST(Velodyne, TellsIntensityAndRingOfEachReturn) {
  const Sweep sweep = sweeps_of(vlp16_turns(2, 4.0)).at(0);
  ASSERT_EQ(sweep.intensities.size(), kReturnsOfATurn);
  ASSERT_EQ(sweep.rings.size(), kReturnsOfATurn);
  // Two firings of 16 lasers: the first looks lowest, the second is the ninth from below, the last
  // the highest.
  for (const std::size_t firing : {0U, 16U}) {
    EXPECT_EQ(sweep.rings[firing], 0);
    EXPECT_EQ(sweep.rings[firing + 1], 8);
    EXPECT_EQ(sweep.rings[firing + 15], 15);
    EXPECT_EQ(sweep.intensities[firing + 1], 101.0F + static_cast<float>(firing));
  }
}

TEST(Velodyne, NumbersTheRingsOfAnHdl32FromTheLowest) {
  VelodyneDecoder decoder(VelodyneModel::kHdl32);
  std::optional<Sweep> sweep;
  for (const auto& packet : vlp16_turns(2, 4.0)) {
    if (auto whole = decoder.add(packet, 0)) sweep = std::move(whole);
  }
  ASSERT_TRUE(sweep);
  // -30.67, -9.33 and 10.67 degrees.
  EXPECT_EQ(sweep->rings[0], 0);
  EXPECT_EQ(sweep->rings[1], 16);
  EXPECT_EQ(sweep->rings[31], 31);
}

TEST(Velodyne, LeavesOutLasersWithoutReturn) {
  const Sweep sweep = sweeps_of(vlp16_turns(2, 0.0)).at(0);
  EXPECT_TRUE(sweep.points_m.empty());
  EXPECT_TRUE(sweep.intensities.empty());
  EXPECT_TRUE(sweep.rings.empty());
}

TEST(Velodyne, CountsPacketsThatAreNone) {
  VelodyneDecoder decoder(VelodyneModel::kVlp16);
  EXPECT_FALSE(decoder.add(std::vector<std::uint8_t>(1206, 0), 0));
  EXPECT_FALSE(decoder.add(std::vector<std::uint8_t>(512, 0xFF), 0));
  EXPECT_EQ(decoder.num_malformed(), 2);
}

/// The model that packets of this last byte tell whose clock tells these times [us].
std::optional<VelodyneModel> model_of(std::uint8_t last_byte,
                                      const std::vector<std::uint32_t>& clocks_us,
                                      std::uint8_t returns = 0x37) {
  VelodyneModelFinder finder;
  std::optional<VelodyneModel> model;
  for (const std::uint32_t clock_us : clocks_us) {
    model = finder.add(vlp16_packet(0.0, 1.0, last_byte, clock_us, returns));
  }
  return model;
}

TEST(VelodyneModelFinder, KnowsAVlp16ByItsLastByte) {
  EXPECT_EQ(model_of(0x22, {0}), VelodyneModel::kVlp16);
}

TEST(VelodyneModelFinder, KnowsAnEarlyVlp16ThatCallsItselfHdl32ByItsClock) {
  EXPECT_FALSE(model_of(0x21, {70'000}));
  EXPECT_EQ(model_of(0x21, {70'000, 71'327}), VelodyneModel::kVlp16);
  EXPECT_EQ(model_of(0x21, {70'000, 70'664}, 0x39), VelodyneModel::kVlp16);
  EXPECT_EQ(model_of(0x21, {70'000, 70'553}), VelodyneModel::kHdl32);
  EXPECT_EQ(model_of(0x21, {70'000, 70'276}, 0x39), VelodyneModel::kHdl32);
}

TEST(VelodyneModelFinder, IsNotMisledByLostPacketsOrTheHoursEnd) {
  EXPECT_FALSE(model_of(0x21, {70'000, 71'106}));
  EXPECT_EQ(model_of(0x21, {70'000, 71'106, 71'659}), VelodyneModel::kHdl32);
  EXPECT_EQ(model_of(0x21, {3'599'999'900, 453, 1'006}), VelodyneModel::kHdl32);
}

TEST(VelodyneModelFinder, TrustsTheLastByteWhereTheClockStands) {
  EXPECT_FALSE(model_of(0x21, std::vector<std::uint32_t>(19, 5)));
  EXPECT_EQ(model_of(0x21, std::vector<std::uint32_t>(20, 5)), VelodyneModel::kHdl32);
  EXPECT_FALSE(model_of(0x99, std::vector<std::uint32_t>(20, 5)));
}

}  // namespace
}  // namespace limbcast::laser_scanner
