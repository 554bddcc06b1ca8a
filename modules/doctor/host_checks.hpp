#pragma once

#include <cstdint>
#include <string>

#include "modules/doctor/finding.hpp"
#include "modules/doctor/host_facts.hpp"

namespace limbcast::doctor {

/// What the LCM URL says, as far as the checks need it.
struct UrlFacts {
  std::string url;    ///< as given
  std::string group;  ///< multicast address
  int ttl = 0;
  std::int64_t recv_buf_size = 0;  ///< that limbcast's programs ask for [byte]
  bool names_buffer = false;  ///< else other programs, lcm-logger too, get the system's default
};

/// Each function looks at one thing and tells what it found.
Findings check_route(const HostFacts& host, const UrlFacts& url);
Findings check_ttl(const UrlFacts& url);
/// `largest_message`: [byte], of those that were heard; 0: none was.
Findings check_receive_buffer(const HostFacts& host, const UrlFacts& url,
                              std::int64_t largest_message);
Findings check_reassembly(const HostFacts& host, const UrlFacts& url);
/// Drops between two looks at the host.
Findings check_drops(const HostFacts& before, const HostFacts& after);
Findings check_cpu(const HostFacts& host);

}  // namespace limbcast::doctor
