#include "common/lcm_io/lcm_url.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

namespace limbcast::lcm_io {
namespace {

/// "ttl=1&recv_buf_size=4000000"
bool read_arguments(const std::string& text, MulticastUrl& url) {
  std::istringstream arguments(text);
  std::string argument;
  while (std::getline(arguments, argument, '&')) {
    static const std::regex kForm("([a-z_]+)=([0-9]{1,9})");
    std::smatch match;
    if (!std::regex_match(argument, match, kForm)) return false;
    const int value = std::stoi(match[2]);
    if (match[1] == "ttl") url.ttl = value;
    if (match[1] == "recv_buf_size") url.recv_buf_size = value;
  }
  return true;
}

}  // namespace

sockaddr_in MulticastUrl::socket_address() const {
  sockaddr_in socket_address{};
  socket_address.sin_family = AF_INET;
  socket_address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address.c_str(), &socket_address.sin_addr);
  return socket_address;
}

std::optional<MulticastUrl> parse_multicast_url(const std::string& url) {
  static const std::regex kForm(R"(udpm://([0-9.]*)(?::([0-9]{1,5}))?(?:\?(.*))?)");
  std::smatch match;
  if (!std::regex_match(url, match, kForm)) return std::nullopt;
  MulticastUrl parsed;
  if (match[1].length() > 0) parsed.address = match[1];
  if (match[2].matched) parsed.port = std::stoi(match[2]);
  in_addr address{};
  constexpr int kLargestPort = 65535;
  if (inet_pton(AF_INET, parsed.address.c_str(), &address) != 1 || parsed.port > kLargestPort ||
      !read_arguments(match[3], parsed))
    return std::nullopt;
  return parsed;
}

std::string with_receive_buffer(const std::string& url) {
  const auto multicast = parse_multicast_url(url);
  if (!multicast || multicast->recv_buf_size > 0) return url;
  const char* separator = url.find('?') == std::string::npos ? "?" : url.back() == '?' ? "" : "&";
  return url + separator + "recv_buf_size=" + std::to_string(kReceiveBufferSize);
}

std::string with_receive_buffer_of_at_most(std::int64_t limit_bytes, const std::string& url) {
  const auto multicast = parse_multicast_url(url);
  if (!multicast || multicast->recv_buf_size <= limit_bytes) return url;
  static const std::regex kBuffer("recv_buf_size=[0-9]+");
  return std::regex_replace(url, kBuffer, "recv_buf_size=" + std::to_string(limit_bytes));
}

std::optional<std::int64_t> receive_buffer_limit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  std::int64_t bytes = 0;
  return file >> bytes ? std::optional(bytes) : std::nullopt;
}

std::string why_unreachable(const MulticastUrl& url) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = url.socket_address();
  const bool connected =
      connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  std::string reason = connected ? "" : std::strerror(errno);
  close(probe);
  return reason;
}

}  // namespace limbcast::lcm_io
