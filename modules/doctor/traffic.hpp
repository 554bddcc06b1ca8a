#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "modules/doctor/finding.hpp"

namespace limbcast::doctor {

/// What came on one channel.
struct ChannelTraffic {
  std::int64_t messages = 0, bytes = 0, largest = 0;
  std::set<std::int64_t> fingerprints;  ///< of the types, as LCM puts them before each message
};

/// What a module told about itself on MODULE_STATUS.
struct ModuleReport {
  std::string module, host;
  std::int32_t pid = 0;
  std::int64_t sent_utime = 0;      ///< by the module's clock [us]
  std::int64_t received_utime = 0;  ///< by this host's clock [us]
  std::int64_t lost = 0;            ///< frames, since the module started
  std::string state, last_error;
};

/// All that was heard on the LCM bus for a while.
struct Traffic {
  double duration_s = 0.0;
  std::map<std::string, ChannelTraffic> channels;
  std::vector<ModuleReport> reports;  ///< in the order of arrival
};

/// Channel to the fingerprint of the type that belongs there.
using KnownChannels = std::map<std::string, std::int64_t>;

/// Foreign types on our channels; who else is on the bus.
Findings check_channels(const Traffic& traffic, const KnownChannels& known);
/// Modules that fail or lose frames, that run twice, and those of `expected` that are silent.
/// `expected` empty: the chain, once anything of limbcast is heard.
Findings check_modules(const Traffic& traffic, const std::vector<std::string>& expected);
/// Clocks of the other hosts against this one, `this_host`.
Findings check_clocks(const Traffic& traffic, const std::string& this_host);

std::int64_t largest_message(const Traffic& traffic);

}  // namespace limbcast::doctor
