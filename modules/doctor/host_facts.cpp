#include "modules/doctor/host_facts.hpp"

#include <arpa/inet.h>
#include <net/if.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace limbcast::doctor {
namespace {

namespace fs = std::filesystem;

/// Empty where the file is missing.
std::string first_word(const fs::path& file) {
  std::ifstream in(file);
  std::string word;
  in >> word;
  return word;
}

std::optional<std::int64_t> number(const fs::path& file) {
  std::ifstream in(file);
  std::int64_t value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// One line of /proc/net/route; addresses in network byte order.
struct Entry {
  std::string interface;
  std::uint32_t destination = 0, mask = 0;
  unsigned flags = 0;
  int metric = 0;
};

std::vector<Entry> routing_table(const fs::path& file) {
  constexpr unsigned kRouteUp = 0x1;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);  // names of the columns
  std::vector<Entry> entries;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    Entry entry;
    std::string gateway, references, uses;
    words >> entry.interface >> std::hex >> entry.destination >> gateway >> entry.flags >>
        references >> uses >> std::dec >> entry.metric >> std::hex >> entry.mask;
    if (words && (entry.flags & kRouteUp) != 0) entries.push_back(entry);
  }
  return entries;
}

int prefix_length(std::uint32_t mask) { return __builtin_popcount(mask); }

/// The longest prefix wins, then the lowest metric.
std::optional<Entry> route_to(const std::vector<Entry>& table, std::uint32_t address) {
  std::optional<Entry> best;
  for (const Entry& entry : table) {
    if ((address & entry.mask) != entry.destination) continue;
    const auto rank = [](const Entry& e) { return std::pair(-prefix_length(e.mask), e.metric); };
    if (!best || rank(entry) < rank(*best)) best = entry;
  }
  return best;
}

std::vector<Interface> interfaces_in(const fs::path& folder) {
  std::vector<Interface> interfaces;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const unsigned flags = static_cast<unsigned>(
        std::strtoul(first_word(entry.path() / "flags").c_str(), nullptr, 16));
    interfaces.push_back({entry.path().filename(), (flags & IFF_UP) != 0,
                          (flags & IFF_MULTICAST) != 0,
                          first_word(entry.path() / "carrier") == "1"});
  }
  std::sort(interfaces.begin(), interfaces.end(),
            [](const Interface& a, const Interface& b) { return a.name < b.name; });
  return interfaces;
}

/// /proc/net/snmp: for each protocol a line of names and one of values.
std::map<std::string, std::int64_t> network_counters(const fs::path& file) {
  std::map<std::string, std::int64_t> counters;
  std::ifstream in(file);
  std::string names_line, values_line;
  while (std::getline(in, names_line) && std::getline(in, values_line)) {
    std::istringstream names(names_line), values(values_line);
    std::string protocol, name;
    std::int64_t value = 0;
    names >> protocol;
    values >> protocol;
    while (names >> name && values >> value) counters[protocol + name] = value;
  }
  return counters;
}

std::vector<std::string> governors_in(const fs::path& folder) {
  std::vector<std::string> governors;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string governor = first_word(entry.path() / "cpufreq/scaling_governor");
    if (!governor.empty()) governors.push_back(governor);
  }
  return governors;
}

}  // namespace

HostFacts read_host_facts(const fs::path& root, const std::string& group) {
  HostFacts facts;
  const std::vector<Entry> table = routing_table(root / "proc/net/route");
  if (const auto route = route_to(table, inet_addr(group.c_str())))
    facts.multicast_route = Route{route->interface, prefix_length(route->mask)};
  if (const auto route = route_to(table, 0)) facts.default_interface = route->interface;
  facts.interfaces = interfaces_in(root / "sys/class/net");
  facts.rmem_max = number(root / "proc/sys/net/core/rmem_max");
  facts.rmem_default = number(root / "proc/sys/net/core/rmem_default");
  facts.ipfrag_time_s = number(root / "proc/sys/net/ipv4/ipfrag_time");
  facts.ipfrag_high_thresh = number(root / "proc/sys/net/ipv4/ipfrag_high_thresh");
  const auto counters = network_counters(root / "proc/net/snmp");
  const auto counter = [&counters](const std::string& name) {
    const auto found = counters.find(name);
    return found == counters.end() ? 0 : found->second;
  };
  facts.failed_reassemblies = counter("Ip:ReasmFails");
  facts.full_buffer_drops = counter("Udp:RcvbufErrors");
  facts.cpu_governors = governors_in(root / "sys/devices/system/cpu");
  return facts;
}

}  // namespace limbcast::doctor
