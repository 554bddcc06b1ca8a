#include "common/lcm_io/module_status_codec.hpp"

#include <algorithm>
#include <cmath>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {
namespace {

/// Whoever is on the network can send: what could steer a terminal is replaced.
std::string printable(std::string text) {
  constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7F;
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < kFirstPrintable || byte == kDelete;
      },
      ' ');
  return text;
}

double rate(float value) {
  require(std::isfinite(value) && value >= 0.0F, "status: a rate is negative or not finite");
  return value;
}

std::optional<double> latency(float value) {
  return is_age_of_live_data(value) ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

bool is_age_of_live_data(float age_ms) {
  constexpr float kLargestAge_ms = 60'000.0F;
  return std::abs(age_ms) < kLargestAge_ms;
}

ModuleStatus from_message(const module_status_t& message) {
  require(!message.module.empty(), "status: 'module' is empty");
  require(std::min({message.num_received, message.num_published, message.num_lost,
                    message.num_skipped, message.num_malformed}) >= 0,
          "status: a count is negative");
  ModuleStatus status;
  status.utime = message.utime;
  status.module = printable(message.module);
  status.host = printable(message.host);
  status.version = printable(message.version);
  status.state = printable(message.state);
  status.pid = message.pid;
  status.rate_in_hz = rate(message.rate_in_hz);
  status.rate_out_hz = rate(message.rate_out_hz);
  status.latency_p50_ms = latency(message.latency_p50_ms);
  status.latency_p99_ms = latency(message.latency_p99_ms);
  status.received = message.num_received;
  status.published = message.num_published;
  status.lost = message.num_lost;
  status.skipped = message.num_skipped;
  status.malformed = message.num_malformed;
  status.last_error = printable(message.last_error);
  status.note = printable(message.note);
  return status;
}

}  // namespace limbcast::lcm_io
