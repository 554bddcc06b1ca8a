#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

namespace limbcast::lcm_io {

/// Keeps this host in the group of a multicast URL. LCM joins it once, on the device that the route
/// names then; without this, nothing from other hosts would be heard any more after that device was
/// unplugged and came back, or after the route moved to another one. LCM's own socket hears what
/// any socket of the host has joined (IP_MULTICAST_ALL of ip(7)).
class GroupMembership {
 public:
  /// Of a URL of another kind nothing is joined.
  explicit GroupMembership(const std::string& url);
  ~GroupMembership();
  GroupMembership(const GroupMembership&) = delete;
  GroupMembership& operator=(const GroupMembership&) = delete;

  /// Joins on the device that the route names now, unless that is done. To be called again and
  /// again; without a route nothing happens.
  void renew();

 private:
  bool join() const;

  std::optional<in_addr> group_;
  int socket_ = -1;
};

}  // namespace limbcast::lcm_io
