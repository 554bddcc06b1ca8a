#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace limbcast::laser_scanner {

/// What a UDP packet carried, and when it came.
struct Packet {
  std::int64_t utime = 0;  ///< [us since the Unix epoch]
  std::vector<std::uint8_t> payload;
  std::string sender;  ///< IPv4 address, e.g. "192.168.1.201"
};

/// Reads the UDP packets of a pcap recording (tcpdump, Wireshark; microseconds or nanoseconds;
/// Ethernet, also with VLAN tags, Linux cooked or raw IPv4).
class PcapReader {
 public:
  /// Throws InputError where the file is no pcap file.
  explicit PcapReader(const std::string& path);
  /// The next UDP packet; nothing at the end or where the file is torn.
  std::optional<Packet> next();

  /// After the last packet: bytes that follow it but hold no whole one (a torn file), else 0.
  std::int64_t torn_bytes() const { return torn_bytes_; }

 private:
  std::optional<Packet> next_frame();
  std::int64_t bytes_behind_records();
  std::uint32_t number_32(const std::uint8_t* bytes) const;

  std::string path_;
  std::ifstream file_;
  bool swapped_ = false, nanoseconds_ = false;
  std::size_t link_bytes_ = 0;
  std::int64_t records_end_bytes_ = 0, torn_bytes_ = 0;
};

/// Receives UDP packets on a port of this host.
class UdpReceiver {
 public:
  /// Throws InputError where the port cannot be opened or another process listens there.
  explicit UdpReceiver(int port);
  ~UdpReceiver();
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;
  /// The next packet; nothing where none comes within 100 ms.
  std::optional<Packet> next();

  /// A network gives whole packets or none.
  static std::int64_t torn_bytes() { return 0; }

 private:
  int socket_ = -1;
};

}  // namespace limbcast::laser_scanner
