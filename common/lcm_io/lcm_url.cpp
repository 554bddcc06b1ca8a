#include "common/lcm_io/lcm_url.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <string_view>

namespace limbcast::lcm_io {
namespace {

/// What LCM can be told to talk over; only udpm is looked at closer.
constexpr std::array<std::string_view, 4> kKinds = {"udpm", "mpudpm", "tcpq", "memq"};

/// The parts of a udpm URL, each perhaps missing: address, port, arguments.
const std::regex& multicast_form() {
  static const std::regex kForm(R"(udpm://([^:?]*)(?::([^?]*))?(?:\?(.*))?)");
  return kForm;
}

std::string fault_of_address(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1) return "'" + text + "' is no IPv4 address";
  if (!IN_MULTICAST(ntohl(address.s_addr)))
    return "'" + text + "' is no multicast address (224.0.0.0 to 239.255.255.255)";
  return "";
}

std::string fault_of_port(const std::string& text) {
  static const std::regex kDigits("[0-9]{1,5}");
  constexpr int kLargest = 65535;
  if (text.empty()) return "has no port";
  const int port = std::regex_match(text, kDigits) ? std::stoi(text) : 0;
  return port > 0 && port <= kLargest ? "" : "'" + text + "' is no port (1 to 65535)";
}

/// "ttl=1&recv_buf_size=4000000" into `url`; returns what is wrong, empty for nothing.
std::string read_arguments(const std::string& text, MulticastUrl& url) {
  static const std::regex kForm("(ttl|recv_buf_size)=([0-9]{1,9})");
  constexpr int kLargestTtl = 255;
  std::istringstream arguments(text);
  std::string argument;
  while (std::getline(arguments, argument, '&')) {
    std::smatch match;
    const bool is_known = std::regex_match(argument, match, kForm);
    const int value = is_known ? std::stoi(match[2]) : 0;
    const bool is_ttl = is_known && match[1] == "ttl";
    if (!is_known || (is_ttl && value > kLargestTtl))
      return "'" + argument + "' is neither ttl=0 to 255 nor recv_buf_size=BYTES";
    (is_ttl ? url.ttl : url.recv_buf_size) = value;
  }
  return "";
}

/// Reads a udpm URL; returns what is wrong with it, empty for nothing.
std::string read_multicast_url(const std::smatch& parts, MulticastUrl& url) {
  // LCM has a group of its own where none is named; but it has no port for one that is.
  if (parts[1].length() > 0 || parts[2].matched) {
    for (const std::string& fault : {fault_of_address(parts[1]), fault_of_port(parts[2])})
      if (!fault.empty()) return fault;
    url.address = parts[1];
    url.port = std::stoi(parts[2]);
  }
  return read_arguments(parts[3], url);
}

}  // namespace

sockaddr_in MulticastUrl::socket_address() const {
  sockaddr_in socket_address{};
  socket_address.sin_family = AF_INET;
  socket_address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, address.c_str(), &socket_address.sin_addr);
  return socket_address;
}

bool is_url_of_file(const std::string& url) { return url.rfind("file://", 0) == 0; }

std::string url_fault(const std::string& url) {
  if (is_url_of_file(url)) return "is a file, no live URL";
  const std::size_t kind_end = url.find("://");
  const bool is_known =
      kind_end != std::string::npos &&
      std::find(kKinds.begin(), kKinds.end(), url.substr(0, kind_end)) != kKinds.end();
  if (!is_known) return "does not begin with udpm://";
  std::smatch parts;
  MulticastUrl ignored;
  return std::regex_match(url, parts, multicast_form()) ? read_multicast_url(parts, ignored) : "";
}

std::optional<MulticastUrl> parse_multicast_url(const std::string& url) {
  std::smatch parts;
  MulticastUrl parsed;
  if (!std::regex_match(url, parts, multicast_form()) || !read_multicast_url(parts, parsed).empty())
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
