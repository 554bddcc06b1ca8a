#include "common/lcm_io/lcm_url.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
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
