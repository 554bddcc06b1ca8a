#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/multi_host/cable.hpp"

namespace limbcast::test {

/// While it lives, sockets that this thread opens belong to the network namespace.
class InNamespace {
 public:
  explicit InNamespace(const std::string& name);
  ~InNamespace();
  InNamespace(const InNamespace&) = delete;
  InNamespace& operator=(const InNamespace&) = delete;

 private:
  int own_;
};

/// Hosts on one switch, each a network namespace with the device eth0, joined by a bridge. The
/// links are veth pairs with netem, or cables of our own where the kernel has no netem.
class Network {
 public:
  /// Throws std::runtime_error with the command that failed.
  explicit Network(const std::vector<std::string>& hosts);
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// Why this machine lets nobody make such hosts; nothing where it does.
  static std::optional<std::string> why_impossible();

  std::string namespace_of(const std::string& host) const;
  /// What runs `command` on the host, under the host's name, as a process with the same id.
  std::vector<std::string> on_host(const std::string& host, std::vector<std::string> command) const;

  /// Sets what of a sysctl.conf(5) belongs to a network namespace (net.ipv4).
  void set_kernel(const std::string& host, const std::string& settings);
  /// From now on, for what the host sends.
  void impair(const std::string& host, const Impairment& impairment);
  /// The host's cable pulled from the switch: it keeps its address and routes.
  void unplug(const std::string& host);
  void plug(const std::string& host);
  /// The host's own device down: addresses stay, routes go.
  void take_down(const std::string& host);
  void bring_up(const std::string& host);

 private:
  void make_namespace(const std::string& name);
  void connect(const std::string& host, int number);

  std::vector<std::string> namespaces_;
  bool has_netem_ = false;
  std::map<std::string, std::unique_ptr<Cable>> cables_;
};

}  // namespace limbcast::test
