#include "modules/log/channel_filter.hpp"

#include "common/config/options.hpp"

namespace limbcast::logs {
namespace {

std::regex expression(const std::string& key, const std::string& text) {
  try {
    return std::regex(text, std::regex::extended);
  } catch (const std::regex_error&) {
    throw config::UsageError("'" + key + "' is '" + text +
                             "', must be a regular expression, e.g. 'BODY_POSES|MODULE_.*'");
  }
}

}  // namespace

ChannelFilter::ChannelFilter(const std::string& only, const std::string& without)
    : only_(expression("channel", only.empty() ? ".*" : only)),
      without_(expression("without", without)) {}

bool ChannelFilter::takes(const std::string& channel) const {
  return std::regex_match(channel, only_) && !std::regex_match(channel, without_);
}

}  // namespace limbcast::logs
