#pragma once

#include <optional>
#include <string>
#include <utility>

#include "common/config/log.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/calibrate/pair_input.hpp"

namespace limbcast::calibrate {

/// What an LCM log holds on one channel. Malformed messages are left out; the first of them, and a
/// torn end, are told in the log.
template <class Message>
class LogMessages {
 public:
  using Value = decltype(lcm_io::from_message(std::declval<const Message&>()));

  LogMessages(const std::string& log, std::string channel)
      : log_(log), channel_(std::move(channel)), reader_(log) {}

  /// Nothing after the last. Throws std::runtime_error where the program is told to end.
  std::optional<Value> next() {
    while (const auto event = reader_.next()) {
      check_not_told_to_end();
      if (event->channel != channel_) continue;
      try {
        return lcm_io::from_message(lcm_io::decode<Message>(event->data));
      } catch (const lcm_io::MessageError& error) {
        if (num_malformed_++ == 0)
          config::log(config::LogLevel::kWarning, log_ + ": malformed messages on " + channel_ +
                                                      " are left out; the first: " + error.what());
      }
    }
    if (reader_.torn_bytes() > 0)
      config::log(config::LogLevel::kWarning, lcm_io::torn_end(log_, reader_.torn_bytes()));
    return std::nullopt;
  }

 private:
  std::string log_, channel_;
  lcm_io::LogReader reader_;
  int num_malformed_ = 0;
};

}  // namespace limbcast::calibrate
