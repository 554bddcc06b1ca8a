#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <string>

namespace limbcast::lcm_io {

/// What a udpm URL says, e.g. udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4000000
struct MulticastUrl {
  std::string address = "239.255.76.67";  ///< LCM's own default
  int port = 7667;                        ///< LCM's own default
  int ttl = 0;                            ///< 0: nothing leaves the host
  int recv_buf_size = 0;                  ///< of the socket [byte]; 0: the system's default

  sockaddr_in socket_address() const;
};

/// LCM reads or writes a log by such a URL, but not both: a module would hear nothing, or say with
/// each message that it cannot be sent.
bool is_url_of_file(const std::string& url);

/// What is wrong with a live LCM URL, e.g. "has no port"; empty: nothing. LCM would take some such
/// URLs for others, or blame the firewall.
std::string url_fault(const std::string& url);

/// Nothing for another kind of URL (memq://) and for one that makes no sense.
std::optional<MulticastUrl> parse_multicast_url(const std::string& url);

/// Of the socket, where a URL names none [byte]: several images or clouds while a process is not
/// scheduled. With the system's default up to half of the image pairs are lost even on one host.
inline constexpr int kReceiveBufferSize = 4'000'000;

/// The URL with kReceiveBufferSize where it is a multicast URL that names no buffer.
std::string with_receive_buffer(const std::string& url);

/// The URL with the buffer that the kernel gives, where it asks for more than `limit_bytes`: LCM
/// would take what it gets and complain in a form of its own.
std::string with_receive_buffer_of_at_most(std::int64_t limit_bytes, const std::string& url);

/// The largest buffer that the kernel gives to a socket [byte]; nothing where it does not tell.
std::optional<std::int64_t> receive_buffer_limit();

/// Why messages to the URL's group cannot be sent now, e.g. "Network is unreachable"; empty: they
/// can.
std::string why_unreachable(const MulticastUrl& url);

}  // namespace limbcast::lcm_io
