#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/laser_scanner/velodyne.hpp"

namespace limbcast::laser_scanner {

/// A VLP-16 packet whose 12 blocks start at this azimuth, 0.4 degrees each, all returns at this
/// distance; the intensity of a return is 100 plus its number in the block. Its last two bytes tell
/// the kind of returns and the model.
inline std::vector<std::uint8_t> vlp16_packet(double azimuth_deg, double distance_m,
                                              std::uint8_t model = 0x22, std::uint32_t clock_us = 0,
                                              std::uint8_t returns = 0x37) {
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
      packet.push_back(static_cast<std::uint8_t>(100 + i));
    }
  }
  number_16(static_cast<int>(clock_us & 0xFFFFU));
  number_16(static_cast<int>(clock_us >> 16U));
  packet.insert(packet.end(), {returns, model});
  return packet;
}

/// Returns of a turn of vlp16_turns: 900 blocks of 0.4 degrees.
inline constexpr std::size_t kReturnsOfATurn = std::size_t{900} * 32;

/// What a VLP-16 takes for a packet, by its clock [us].
inline constexpr std::uint32_t kVlp16Packet_us = 1327;

/// Packets of whole turns: 75 packets of 4.8 degrees each, beginning in front.
inline std::vector<std::vector<std::uint8_t>> vlp16_turns(int turns, double distance_m) {
  std::vector<std::vector<std::uint8_t>> packets;
  packets.reserve(75 * static_cast<std::size_t>(turns));
  for (int i = 0; i < 75 * turns; ++i) {
    packets.push_back(vlp16_packet(std::fmod(4.8 * i, 360.0), distance_m, 0x22,
                                   static_cast<std::uint32_t>(i) * kVlp16Packet_us));
  }
  return packets;
}

/// Begins a pcap file whose times are in microseconds.
inline constexpr std::uint32_t kPcapMicroseconds = 0xA1B2C3D4;

/// A link's header as pcap_of() puts it before each packet. The second: of a virtual network,
/// number 5.
inline const std::string kEthernet = std::string(14, '\0');
inline const std::string kVlan =
    std::string(12, '\0') + std::string{'\x81', '\0', '\0', '\x05', '\x08', '\0'};

/// A pcap file with Ethernet frames of one UDP packet each, 1 ms apart from 1000 s on. The packets
/// come by turns from as many senders, 0.0.0.0 and on.
inline std::string pcap_of(const std::vector<std::vector<std::uint8_t>>& payloads,
                           std::uint32_t magic = kPcapMicroseconds,
                           const std::string& link = kEthernet, std::size_t num_senders = 1) {
  std::string file;
  const auto number_32 = [&file](std::uint32_t value) {
    file.append(reinterpret_cast<const char*>(&value), 4);
  };
  for (const std::uint32_t value : {magic, 0x00040002U, 0U, 0U, 65535U, 1U}) number_32(value);
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    std::string frame = link;
    frame += std::string("\x45") + std::string(8, 0) + '\x11' + std::string(5, 0);  // IPv4, UDP
    frame += static_cast<char>(i % num_senders);                                    // sender
    frame += std::string(4, '\0');                                                  // receiver
    frame += std::string(8, '\0');                                                  // UDP
    frame.append(payloads[i].begin(), payloads[i].end());
    for (const std::size_t value : {std::size_t{1000}, 1000 * i, frame.size(), frame.size()}) {
      number_32(static_cast<std::uint32_t>(value));
    }
    file += frame;
  }
  return file;
}

}  // namespace limbcast::laser_scanner
