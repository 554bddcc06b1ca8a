#include "modules/laser_scanner/packet_source.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "common/formatted.hpp"
#include "common/input_error.hpp"

namespace limbcast::laser_scanner {
namespace {

constexpr std::size_t kLargestPacket = 65536;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kUdpHeaderBytes = 8;
constexpr std::size_t kSenderAt = 12;  ///< in the IP header
constexpr std::size_t kVlanTagBytes = 4;

/// Bytes before the IP header, by the file's kind of link.
std::optional<std::size_t> link_bytes(std::uint32_t link_type) {
  if (link_type == 1) return 14;    // Ethernet
  if (link_type == 101) return 0;   // raw IP
  if (link_type == 113) return 16;  // Linux cooked
  return std::nullopt;
}

/// Where the IP header begins: behind the link's bytes, whose last two say what follows, and the
/// tags of virtual networks (IEEE 802.1Q: 0x8100), which end likewise.
std::size_t ip_begin(const std::vector<std::uint8_t>& frame, std::size_t link_bytes) {
  std::size_t begin = link_bytes;
  while (begin >= 2 && begin <= frame.size() && frame[begin - 2] == 0x81 && frame[begin - 1] == 0) {
    begin += kVlanTagBytes;
  }
  return begin;
}

std::string ipv4_text(const std::uint8_t* address) {
  return formatted("%d.%d.%d.%d", address[0], address[1], address[2], address[3]);
}

/// What a UDP packet carries; empty for all else.
std::vector<std::uint8_t> udp_payload(const std::vector<std::uint8_t>& frame, std::size_t ip_at) {
  constexpr std::size_t kShortestIpHeader = 20;
  if (frame.size() < ip_at + kShortestIpHeader + kUdpHeaderBytes) return {};
  const std::uint8_t* ip = frame.data() + ip_at;
  const bool is_ipv4_udp = ip[0] >> 4 == 4 && ip[9] == kUdp;
  const std::size_t payload_at = ip_at + 4U * (ip[0] & 0x0FU) + kUdpHeaderBytes;
  if (!is_ipv4_udp || payload_at > frame.size()) return {};
  return {frame.begin() + static_cast<std::ptrdiff_t>(payload_at), frame.end()};
}

/// Why a port cannot be listened on, and what to do.
std::string reason_to_refuse(int port, int error) {
  if (error == EADDRINUSE)
    return " is taken by another process; end it (ss -lunp sport = :" + std::to_string(port) +
           " names it), or let the scanner send to another port";
  return std::string(": ") + std::strerror(error) +
         "; let the scanner send to a port from 1024 on, which needs no privilege";
}

}  // namespace

PcapReader::PcapReader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  std::array<std::uint8_t, 24> header{};
  file_.read(reinterpret_cast<char*>(header.data()), header.size());
  if (!file_)
    throw InputError(path + ": cannot be read as a pcap file; give a recording of packets");
  std::uint32_t magic = 0;
  std::memcpy(&magic, header.data(), 4);
  constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4;
  constexpr std::uint32_t kNanoseconds = 0xA1B23C4D;
  swapped_ = __builtin_bswap32(magic) == kMicroseconds || __builtin_bswap32(magic) == kNanoseconds;
  if (swapped_) magic = __builtin_bswap32(magic);
  nanoseconds_ = magic == kNanoseconds;
  if (magic != kMicroseconds && magic != kNanoseconds) {
    throw InputError(path +
                     ": is no pcap file; a pcapng file is turned into one by editcap -F pcap");
  }
  const auto bytes = link_bytes(number_32(&header[20]));
  if (!bytes)
    throw InputError(path + ": was recorded on an unknown kind of link; record on Ethernet");
  link_bytes_ = *bytes;
  records_end_bytes_ = file_.tellg();
}

std::uint32_t PcapReader::number_32(const std::uint8_t* bytes) const {
  std::uint32_t number = 0;
  std::memcpy(&number, bytes, 4);
  return swapped_ ? __builtin_bswap32(number) : number;
}

/// What a link carried, as a packet; nothing at the end and where the file is torn.
std::optional<Packet> PcapReader::next_frame() {
  std::array<std::uint8_t, 16> header{};
  if (!file_.read(reinterpret_cast<char*>(header.data()), header.size())) return std::nullopt;
  const std::uint32_t size = number_32(&header[8]);
  if (size > kLargestPacket) return std::nullopt;
  const std::int64_t fraction = number_32(&header[4]);
  Packet frame;
  frame.utime = std::int64_t{1'000'000} * number_32(header.data()) +
                (nanoseconds_ ? fraction / 1000 : fraction);
  frame.payload.resize(size);
  if (!file_.read(reinterpret_cast<char*>(frame.payload.data()), size)) return std::nullopt;
  records_end_bytes_ = file_.tellg();
  return frame;
}

std::int64_t PcapReader::bytes_behind_records() {
  file_.clear();
  file_.seekg(0, std::ios::end);
  return file_.tellg() - records_end_bytes_;
}

std::optional<Packet> PcapReader::next() {
  while (const std::optional<Packet> frame = next_frame()) {
    const std::size_t ip_at = ip_begin(frame->payload, link_bytes_);
    std::vector<std::uint8_t> payload = udp_payload(frame->payload, ip_at);
    if (payload.empty()) continue;
    return Packet{frame->utime, std::move(payload), ipv4_text(&frame->payload[ip_at + kSenderAt])};
  }
  torn_bytes_ = bytes_behind_records();
  return std::nullopt;
}

UdpReceiver::UdpReceiver(int port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
  // A turn of a fast scanner, so that none is lost while one is worked on.
  const int buffer_bytes = 4'000'000;
  const timeval timeout{0, 100'000};
  setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof(buffer_bytes));
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  // Without SO_REUSEADDR: of two that share a port, one alone gets what is sent to this host.
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const int error = errno;
    ::close(socket_);
    throw InputError("UDP port " + std::to_string(port) + reason_to_refuse(port, error));
  }
}

UdpReceiver::~UdpReceiver() { ::close(socket_); }

std::optional<Packet> UdpReceiver::next() {
  Packet packet;
  packet.payload.resize(kLargestPacket);
  sockaddr_in sender{};
  socklen_t sender_bytes = sizeof(sender);
  const ssize_t size = recvfrom(socket_, packet.payload.data(), packet.payload.size(), 0,
                                reinterpret_cast<sockaddr*>(&sender), &sender_bytes);
  if (size < 0) return std::nullopt;
  packet.sender = ipv4_text(reinterpret_cast<const std::uint8_t*>(&sender.sin_addr));
  packet.payload.resize(static_cast<std::size_t>(size));
  using namespace std::chrono;
  packet.utime = duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
  return packet;
}

}  // namespace limbcast::laser_scanner
