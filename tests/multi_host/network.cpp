#include "tests/multi_host/network.hpp"

#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

constexpr const char* kSwitch = "switch";

/// Names of two runs at the same time differ.
std::string namespace_name(const std::string& host) {
  return "limbcast-" + std::to_string(getpid()) + "-" + host;
}

void execute(const std::vector<std::string>& command) {
  const RunResult result = run(command);
  if (result.exit_code == 0) return;
  std::string line;
  for (const std::string& word : command) line += word + " ";
  throw std::runtime_error(line + ": " + result.output);
}

void execute_in(const std::string& host, std::vector<std::string> command) {
  command.insert(command.begin(), {"ip", "netns", "exec", namespace_name(host)});
  execute(command);
}

/// A TAP device in the namespace of this thread.
int open_tap(const std::string& name) {
  const int device = open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  ifreq request{};
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  name.copy(request.ifr_name, IFNAMSIZ - 1);
  if (device < 0 || ioctl(device, TUNSETIFF, &request) < 0)
    throw std::runtime_error("/dev/net/tun: " + std::string(std::strerror(errno)));
  return device;
}

int open_tap_in(const std::string& host, const std::string& name) {
  const InNamespace inside(namespace_name(host));
  return open_tap(name);
}

}  // namespace

InNamespace::InNamespace(const std::string& name)
    : own_(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC)) {
  const int other = open(("/run/netns/" + name).c_str(), O_RDONLY | O_CLOEXEC);
  const int entered = setns(other, CLONE_NEWNET);
  close(other);
  if (entered != 0) throw std::runtime_error("network namespace " + name + " cannot be entered");
}

InNamespace::~InNamespace() {
  setns(own_, CLONE_NEWNET);
  close(own_);
}

std::optional<std::string> Network::why_impossible() {
  const std::string name = namespace_name("probe");
  std::optional<std::string> reason;
  // Where the last one works (in a chroot it does not, for one), all that a network is made of
  // does.
  const std::vector<std::vector<std::string>> needed = {
      {"ip", "netns", "add", name},
      {"ip", "netns", "exec", name, "ip", "link", "add", "br0", "type", "bridge"}};
  for (const std::vector<std::string>& command : needed) {
    const RunResult result = run(command);
    if (result.exit_code == 0) continue;
    reason = "needs root, iproute2 and network namespaces, but was told: " + result.output;
    break;
  }
  run({"ip", "netns", "del", name});
  return reason;
}

Network::Network(const std::vector<std::string>& hosts) {
  make_namespace(kSwitch);
  execute_in(kSwitch, {"ip", "link", "add", "br0", "type", "bridge"});
  execute_in(kSwitch, {"ip", "link", "set", "br0", "up"});
  has_netem_ = run({"ip", "netns", "exec", namespace_name(kSwitch), "tc", "qdisc", "add", "dev",
                    "lo", "root", "netem", "loss", "0%"})
                   .exit_code == 0;
  int number = 0;
  for (const std::string& host : hosts) {
    make_namespace(host);
    connect(host, ++number);
  }
}

Network::~Network() {
  cables_.clear();
  for (const std::string& name : namespaces_) run({"ip", "netns", "del", name});
}

std::string Network::namespace_of(const std::string& host) const { return namespace_name(host); }

std::vector<std::string> Network::on_host(const std::string& host,
                                          std::vector<std::string> command) const {
  command.insert(command.begin(), {"ip", "netns", "exec", namespace_name(host), "unshare", "--uts",
                                   "sh", "-c", R"(hostname "$0" && exec "$@")", host});
  return command;
}

void Network::make_namespace(const std::string& name) {
  execute({"ip", "netns", "add", namespace_name(name)});
  namespaces_.push_back(namespace_name(name));
  execute_in(name, {"ip", "link", "set", "lo", "up"});
}

void Network::connect(const std::string& host, int number) {
  if (has_netem_) {
    execute({"ip", "-n", namespace_name(host), "link", "add", "eth0", "type", "veth", "peer",
             "name", host, "netns", namespace_name(kSwitch)});
  } else {
    cables_[host] = std::make_unique<Cable>(open_tap_in(host, "eth0"), open_tap_in(kSwitch, host));
    // A burst of large messages must wait here, not be lost, when the machine is busy.
    execute_in(host, {"ip", "link", "set", "eth0", "txqueuelen", "10000"});
    execute_in(kSwitch, {"ip", "link", "set", host, "txqueuelen", "10000"});
  }
  execute_in(kSwitch, {"ip", "link", "set", host, "master", "br0"});
  plug(host);
  execute_in(host,
             {"ip", "address", "add", "10.77.0." + std::to_string(number) + "/24", "dev", "eth0"});
  bring_up(host);
}

void Network::set_kernel(const std::string& host, const std::string& settings) {
  execute_in(host, {"sysctl", "--quiet", "--pattern", "^net.ipv4", "--load", settings});
}

void Network::impair(const std::string& host, const Impairment& impairment) {
  if (!has_netem_) return cables_.at(host)->impair(impairment);
  const auto percent = [](double value) { return std::to_string(value) + "%"; };
  std::vector<std::string> command = {"tc",   "qdisc", "replace", "dev",  "eth0",
                                      "root", "netem", "limit",   "10000"};
  command.insert(command.end(), {"loss", percent(impairment.loss_percent)});
  if (impairment.delay_ms > 0.0) {
    command.insert(command.end(), {"delay", std::to_string(impairment.delay_ms) + "ms", "reorder",
                                   percent(impairment.reorder_percent)});
  }
  execute_in(host, command);
}

void Network::unplug(const std::string& host) {
  execute_in(kSwitch, {"ip", "link", "set", host, "down"});
}

void Network::plug(const std::string& host) {
  execute_in(kSwitch, {"ip", "link", "set", host, "up"});
}

void Network::take_down(const std::string& host) {
  execute_in(host, {"ip", "link", "set", "eth0", "down"});
}

void Network::bring_up(const std::string& host) {
  execute_in(host, {"ip", "link", "set", "eth0", "up"});
  execute_in(host, {"ip", "route", "replace", "224.0.0.0/4", "dev", "eth0"});
}

}  // namespace limbcast::test
