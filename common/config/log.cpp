#include "common/config/log.hpp"

#include <array>
#include <cstdio>

namespace limbcast::config {
namespace {

constexpr std::array<const char*, 4> kLevelNames = {"ERROR", "WARNING", "INFO", "DEBUG"};

std::string& module_name() {
  static std::string name = "limbcast";
  return name;
}

LogLevel& highest_level() {
  static LogLevel level = LogLevel::kInfo;
  return level;
}

}  // namespace

void configure_log(const std::string& module, const std::string& level) {
  module_name() = module;
  if (level == "error") highest_level() = LogLevel::kError;
  if (level == "warning") highest_level() = LogLevel::kWarning;
  if (level == "info") highest_level() = LogLevel::kInfo;
  if (level == "debug") highest_level() = LogLevel::kDebug;
}

void log(LogLevel level, const std::string& text) {
  if (level > highest_level()) return;
  // One call a line: stdio locks the stream, so lines of several threads do not mix.
  std::fprintf(stderr, "%s %s %s\n", module_name().c_str(), kLevelNames[static_cast<int>(level)],
               text.c_str());
}

}  // namespace limbcast::config
