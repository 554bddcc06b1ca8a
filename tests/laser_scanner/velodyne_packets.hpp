#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "modules/laser_scanner/velodyne.hpp"

namespace limbcast::laser_scanner {

/// A VLP-16 packet whose 12 blocks start at this azimuth, 0.4 degrees each, all returns at this
/// distance.
inline std::vector<std::uint8_t> vlp16_packet(double azimuth_deg, double distance_m,
                                              std::uint8_t model = 0x22) {
  std::vector<std::uint8_t> packet;
  const auto number_16 = [&packet](int value) {
    packet.push_back(static_cast<std::uint8_t>(value & 0xFF));
    packet.push_back(static_cast<std::uint8_t>(value >> 8));
  };
  for (int block = 0; block < 12; ++block) {
    number_16(0xEEFF);
    number_16(static_cast<int>(std::lround(100.0 * azimuth_deg + 40.0 * block)) % 36000);
    for (int i = 0; i < 32; ++i) {
      number_16(static_cast<int>(std::lround(distance_m / 0.002)));
      packet.push_back(100);
    }
  }
  packet.insert(packet.end(), {0, 0, 0, 0, 0x37, model});
  return packet;
}

/// Packets of whole turns: 75 packets of 4.8 degrees each, beginning in front.
inline std::vector<std::vector<std::uint8_t>> vlp16_turns(int turns, double distance_m) {
  std::vector<std::vector<std::uint8_t>> packets;
  packets.reserve(75 * static_cast<std::size_t>(turns));
  for (int i = 0; i < 75 * turns; ++i) {
    packets.push_back(vlp16_packet(std::fmod(4.8 * i, 360.0), distance_m));
  }
  return packets;
}

}  // namespace limbcast::laser_scanner
