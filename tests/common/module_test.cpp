#include "common/lcm_io/module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <limbcast/module_status_t.hpp>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::lcm_io {
namespace {

using ::testing::ExitedWithCode;
using ::testing::HasSubstr;

constexpr int kToldToEnd = 0, kGoesOn = 1;

/// What a program does whose terminal is closed.
[[noreturn]] void hang_up(sighandler_t handler_at_start) {
  std::signal(SIGHUP, handler_at_start);
  install_signal_handlers();
  std::raise(SIGHUP);
  std::exit(stop_requested() ? kToldToEnd : kGoesOn);
}

TEST(Signals, OfAClosedTerminalTellToEnd) {
  EXPECT_EXIT(hang_up(SIG_DFL), ExitedWithCode(kToldToEnd), "");
}

TEST(Signals, OfAClosedTerminalSayNothingUnderNohup) {
  EXPECT_EXIT(hang_up(SIG_IGN), ExitedWithCode(kGoesOn), "");
}

config::CommonOptions options_of_one_process() {
  config::CommonOptions options;
  options.lcm_url = "memq://";
  return options;
}

[[noreturn]] void lose_the_reader_of_the_log() {
  const Module module("test", options_of_one_process());
  std::raise(SIGPIPE);
  std::exit(kGoesOn);
}

TEST(Module, GoesOnWhenNobodyReadsItsLogAnyMore) {
  EXPECT_EXIT(lose_the_reader_of_the_log(), ExitedWithCode(kGoesOn), "");
}

/// Works on a message until a status has come: none would come if it waited for the message.
[[noreturn]] void work_until_a_status_comes() {
  constexpr std::chrono::milliseconds kLook{100};
  constexpr int kMostLooks = 100;
  config::CommonOptions options;
  options.lcm_url = test::private_lcm_url();
  Bus listener(options.lcm_url);
  std::string state;
  listener.subscribe<module_status_t>(kStatusChannel, Keep::kAll,
                                      [&](const module_status_t& status) { state = status.state; });
  Module module("test", options);
  module.subscribe_all<module_status_t>("WORK", [&](const module_status_t&) {
    for (int look = 0; look < kMostLooks && state.empty(); ++look) listener.handle(kLook);
    request_stop();
  });
  listener.publish("WORK", module_status_t{});
  module.run();
  std::exit(state == "running" ? kGoesOn : kToldToEnd);
}

TEST(Module, TellsItsStatusWhileAMessageTakesLong) {
  EXPECT_EXIT(work_until_a_status_comes(), ExitedWithCode(kGoesOn), "0.0 out, nothing sent");
}

TEST(Module, TellsChannelsThatLcmDoesNotTake) {
  Module module("test", options_of_one_process());
  const auto subscribe = [&](const std::string& channel) {
    module.subscribe_all<module_status_t>(channel, [](const module_status_t&) {});
  };
  EXPECT_EQ(test::error_of<config::UsageError>([&] { subscribe(""); }),
            "channel '' has 0 characters, LCM takes 1 to 63; choose another name");

  ::testing::internal::CaptureStderr();
  module.publish(std::string(64, 'A'), module_status_t{});
  EXPECT_THAT(::testing::internal::GetCapturedStderr(),
              HasSubstr("messages cannot be sent: channel 'AAA"));
}

}  // namespace
}  // namespace limbcast::lcm_io
