#pragma once

#include <netinet/in.h>

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

/// Nothing for another kind of URL (memq://, file://) and for one that makes no sense.
std::optional<MulticastUrl> parse_multicast_url(const std::string& url);

/// Why messages to the URL's group cannot be sent now, e.g. "Network is unreachable"; empty: they
/// can.
std::string why_unreachable(const MulticastUrl& url);

}  // namespace limbcast::lcm_io
