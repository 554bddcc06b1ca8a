#include "common/lcm_io/group_membership.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "common/lcm_io/lcm_url.hpp"

namespace limbcast::lcm_io {
namespace {

int open_socket() { return socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0); }

}  // namespace

GroupMembership::GroupMembership(const std::string& url) {
  const auto multicast = parse_multicast_url(url);
  if (!multicast) return;
  group_ = multicast->socket_address().sin_addr;
  socket_ = open_socket();
}

GroupMembership::~GroupMembership() {
  if (socket_ >= 0) close(socket_);
}

void GroupMembership::renew() {
  if (!group_ || join() || errno != ENOBUFS) return;
  // A socket holds 20 memberships, those of devices that are gone among them.
  close(socket_);
  socket_ = open_socket();
  join();
}

bool GroupMembership::join() const {
  ip_mreq request{};
  request.imr_multiaddr = *group_;
  return setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof(request)) == 0;
}

}  // namespace limbcast::lcm_io
