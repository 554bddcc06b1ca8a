#pragma once

#include <regex>
#include <string>

namespace limbcast::logs {

/// Which channels of a log are meant: as lcm-logger does it, by regular expressions for the whole
/// name.
class ChannelFilter {
 public:
  /// Empty: all channels, or none left out. Throws config::UsageError for what is no expression.
  explicit ChannelFilter(const std::string& only = "", const std::string& without = "");

  bool takes(const std::string& channel) const;

 private:
  std::regex only_;
  std::regex without_;
};

}  // namespace limbcast::logs
