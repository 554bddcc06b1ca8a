#include "modules/doctor/host_checks.hpp"

#include <algorithm>

namespace limbcast::doctor {
namespace {

/// A pair of VGA images, JPEG: the largest message of a usual robot, when none was heard.
constexpr std::int64_t kUsualLargestMessage = 200'000;
/// Messages that must fit into a socket's buffer while its process waits for a processor.
constexpr std::int64_t kBufferedMessages = 4;
/// What modules/launch/sysctl/60-limbcast.conf sets.
constexpr std::int64_t kReassemblyTime_s = 2;
constexpr std::int64_t kReassemblyMemory = 64LL << 20;
constexpr std::int64_t kBufferStep = 1'000'000;

const Interface* find(const HostFacts& host, const std::string& name) {
  const auto found = std::find_if(host.interfaces.begin(), host.interfaces.end(),
                                  [&name](const Interface& i) { return i.name == name; });
  return found == host.interfaces.end() ? nullptr : &*found;
}

bool is_loopback(const std::string& interface) { return interface == "lo"; }

/// The device that most likely leads to the other hosts; empty where there is none.
std::string outer_interface(const HostFacts& host) {
  if (!host.default_interface.empty()) return host.default_interface;
  std::string unconnected;
  for (const Interface& interface : host.interfaces) {
    if (is_loopback(interface.name)) continue;
    if (interface.up && interface.carrier) return interface.name;
    if (unconnected.empty()) unconnected = interface.name;
  }
  return unconnected;
}

std::string route_command(const std::string& interface) {
  return "ip route replace 224.0.0.0/4 dev " + interface;
}

/// A route that does not lead to the other hosts, and the command that mends it.
Finding no_outer_route(const HostFacts& host, const std::string& text) {
  const std::string interface = outer_interface(host);
  if (interface.empty())
    return {Level::kProblem, "multicast route",
            text + ", and this host has no network device but lo: add one", ""};
  return {Level::kProblem, "multicast route", text, route_command(interface)};
}

std::string kilobytes(std::int64_t bytes) {
  return bytes < 1000 ? std::to_string(bytes) + " bytes" : std::to_string(bytes / 1000) + " kB";
}

Findings check_interface(const Interface& interface) {
  if (!interface.up)
    return {{Level::kProblem, "multicast route", interface.name + " is down",
             "ip link set " + interface.name + " up"}};
  if (!interface.multicast)
    return {{Level::kProblem, "multicast route", interface.name + " does not take multicast",
             "ip link set " + interface.name + " multicast on"}};
  if (!interface.carrier)
    return {{Level::kProblem, "multicast route", interface.name + " has no link: check the cable",
             "ip -statistics link show " + interface.name}};
  return {};
}

/// Sets the URL with this ttl and a receive buffer of `size` bytes.
std::string url_command(const UrlFacts& url, int ttl, std::int64_t size) {
  const std::string head = url.url.substr(0, url.url.find('?'));
  return "export LCM_DEFAULT_URL='" + head + "?ttl=" + std::to_string(ttl) +
         "&recv_buf_size=" + std::to_string(size) + "'";
}

}  // namespace

Findings check_route(const HostFacts& host, const UrlFacts& url) {
  const std::string name = "multicast route";
  if (!host.multicast_route) {
    const std::string text = "none to " + url.group + ": no message can be sent";
    if (url.ttl == 0) return {{Level::kProblem, name, text, route_command("lo")}};
    return {no_outer_route(host, text)};
  }
  const Route& route = *host.multicast_route;
  if (is_loopback(route.interface)) {
    if (url.ttl == 0) return {{Level::kGood, name, "by lo, on this host only", ""}};
    return {no_outer_route(
        host, "by lo: nothing leaves this host although ttl=" + std::to_string(url.ttl))};
  }
  Findings findings;
  if (const Interface* interface = find(host, route.interface))
    findings = check_interface(*interface);
  const auto connected =
      std::count_if(host.interfaces.begin(), host.interfaces.end(),
                    [](const Interface& i) { return i.up && i.carrier && !is_loopback(i.name); });
  if (route.prefix_length == 0 && connected > 1 && url.ttl > 0)
    findings.push_back({Level::kProblem, name,
                        "by " + route.interface + " because the default route says so, but " +
                            std::to_string(connected) +
                            " devices are connected: name the one that leads to the robot",
                        route_command(route.interface)});
  if (findings.empty()) findings.push_back({Level::kGood, name, "by " + route.interface, ""});
  return findings;
}

Findings check_ttl(const UrlFacts& url) {
  if (url.ttl == 0)
    return {{Level::kNote, "ttl", "0: messages stay on this host; ttl=1 reaches the others", ""}};
  if (url.ttl == 1)
    return {{Level::kGood, "ttl",
             "1: messages stay on the local network, where anyone can read and send them", ""}};
  return {{Level::kProblem, "ttl",
           std::to_string(url.ttl) +
               ": messages leave the local network, and LCM has no authentication",
           url_command(url, 1, url.recv_buf_size)}};
}

Findings check_receive_buffer(const HostFacts& host, const UrlFacts& url,
                              std::int64_t largest_message) {
  const std::string name = "receive buffer";
  if (!host.rmem_max || !host.rmem_default)
    return {{Level::kNote, name, "this kernel does not tell its limits", ""}};
  const std::int64_t largest = largest_message > 0 ? largest_message : kUsualLargestMessage;
  const std::int64_t needed =
      (kBufferedMessages * largest / kBufferStep + 1) * kBufferStep;  // rounded up
  Findings findings;
  if (*host.rmem_max < needed)
    findings.push_back(
        {Level::kProblem, name,
         "rmem_max is " + kilobytes(*host.rmem_max) + ", sockets need " + kilobytes(needed) +
             " (the largest message has " + kilobytes(largest) + ")",
         "sysctl -w net.core.rmem_max=" + std::to_string(std::max(needed, url.recv_buf_size))});
  if (url.recv_buf_size < needed)
    findings.push_back({Level::kProblem, name,
                        "the LCM URL gives sockets " + kilobytes(url.recv_buf_size) +
                            ", they need " + kilobytes(needed),
                        url_command(url, url.ttl, needed)});
  if (findings.empty())
    findings.push_back({Level::kGood, name,
                        kilobytes(std::min(url.recv_buf_size, *host.rmem_max)) +
                            " for messages of up to " + kilobytes(largest),
                        ""});
  // The kernel doubles what is asked for, to cover its own bookkeeping; its default is so already.
  if (!url.names_buffer)
    findings.push_back({Level::kNote, name,
                        "the LCM URL names none: programs that are not limbcast's, such as "
                        "lcm-logger, get " +
                            kilobytes(*host.rmem_default / 2) + " and lose large messages",
                        url_command(url, url.ttl, std::max(url.recv_buf_size, needed))});
  return findings;
}

Findings check_reassembly(const HostFacts& host, const UrlFacts& url) {
  const std::string name = "packets with missing pieces";
  // On this host packets of 64 kB are not split.
  if (url.ttl == 0 || !host.ipfrag_time_s || !host.ipfrag_high_thresh) return {};
  if (*host.ipfrag_time_s <= kReassemblyTime_s && *host.ipfrag_high_thresh >= kReassemblyMemory)
    return {{Level::kGood, name, "are dropped in time", ""}};
  return {{Level::kProblem, name,
           "are kept for " + std::to_string(*host.ipfrag_time_s) + " s in " +
               kilobytes(*host.ipfrag_high_thresh) +
               ": on a link that loses packets large messages stop for as long (" +
               std::to_string(host.failed_reassemblies) + " so far)",
           "sysctl -w net.ipv4.ipfrag_time=" + std::to_string(kReassemblyTime_s) +
               " net.ipv4.ipfrag_high_thresh=" + std::to_string(kReassemblyMemory)}};
}

Findings check_drops(const HostFacts& before, const HostFacts& after) {
  const std::int64_t dropped = after.full_buffer_drops - before.full_buffer_drops;
  const std::int64_t incomplete = after.failed_reassemblies - before.failed_reassemblies;
  Findings findings;
  if (dropped > 0)
    findings.push_back({Level::kProblem, "dropped packets",
                        std::to_string(dropped) + " while listening: a process on this host does "
                                                  "not empty its socket in time",
                        "ss --udp --memory --processes --all"});
  if (incomplete > 0)
    findings.push_back({Level::kProblem, "lost packets",
                        std::to_string(incomplete) + " while listening: pieces of large messages "
                                                     "are lost on the network",
                        "ip -statistics link show"});
  if (findings.empty())
    findings.push_back({Level::kGood, "dropped packets", "none while listening", ""});
  return findings;
}

Findings check_cpu(const HostFacts& host) {
  const std::string name = "CPU governor";
  if (host.cpu_governors.empty()) return {{Level::kGood, name, "the clock is fixed", ""}};
  const auto slow = std::find_if(host.cpu_governors.begin(), host.cpu_governors.end(),
                                 [](const std::string& g) { return g != "performance"; });
  if (slow == host.cpu_governors.end()) return {{Level::kGood, name, "performance", ""}};
  return {{Level::kProblem, name, *slow + ": frames wait for the clock to rise",
           "echo performance | tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor"}};
}

}  // namespace limbcast::doctor
