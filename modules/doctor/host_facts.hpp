#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace limbcast::doctor {

/// A network device as /sys/class/net shows it.
struct Interface {
  std::string name;
  bool up = false, multicast = false, carrier = false;
};

/// The entry of the routing table that messages to the multicast group take.
struct Route {
  std::string interface;
  int prefix_length = 0;  ///< 0: the default route
};

/// What the kernel says about this host; nothing where it does not say.
struct HostFacts {
  std::optional<Route> multicast_route;
  std::string default_interface;  ///< of the default route; empty: none
  std::vector<Interface> interfaces;
  std::optional<std::int64_t> rmem_max, rmem_default;             ///< [byte]
  std::optional<std::int64_t> ipfrag_time_s, ipfrag_high_thresh;  ///< [s], [byte]
  std::int64_t failed_reassemblies = 0;  ///< large packets of which pieces were missing, since boot
  std::int64_t full_buffer_drops = 0;    ///< packets dropped because a socket's buffer was full
  std::vector<std::string> cpu_governors;  ///< one of each processor; empty: the clock is fixed
};

/// Reads /proc and /sys under `root` ("/", or a copy). `group`: the multicast address, e.g.
/// "239.255.76.67".
HostFacts read_host_facts(const std::filesystem::path& root, const std::string& group);

}  // namespace limbcast::doctor
