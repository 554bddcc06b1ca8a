#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limbcast/module_status_t.hpp>
#include <sstream>
#include <stdexcept>

#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/config/output_file.hpp"
#include "common/lcm_io/bus.hpp"
#include "common/lcm_io/module.hpp"
#include "common/lcm_io/module_status_codec.hpp"
#include "modules/status/status_board.hpp"
#include "modules/status/table.hpp"

namespace limbcast::status {
namespace {

using Clock = std::chrono::steady_clock;

/// How long the program may take to see a signal.
constexpr std::chrono::milliseconds kWait{50};
constexpr const char* kHomeAndClear = "\033[H\033[2J";

struct Options {
  std::string channel = lcm_io::kStatusChannel, expect;
  bool once = false;
  double wait_s = 2.5, period_s = 1.0;
  BoardParams board;
};

void declare(config::Section& section, Options& options) {
  section.add("once", options.once,
              "print the table once; exit code 1 where a module is in error or none is there");
  section.add("wait-s", options.wait_s, "s",
              "once: listen for this long; modules tell every second", {0.1, 3600.0});
  section.add("period-s", options.period_s, "s", "live: time between two tables", {0.1, 3600.0});
  section.add("expect", options.expect,
              "modules that must be there, e.g. reconstructor,segmenter; others are shown too");
  section.add("silent-after-s", options.board.silent_after_s, "s",
              "a module that is not heard for this long is in error", {1.0, 3600.0});
  section.add_channel("channel", options.channel, "channel of the modules' status");
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// 0 where stdout is no terminal.
int terminal_width() {
  winsize size{};
  return isatty(STDOUT_FILENO) != 0 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col
                                                                                    : 0;
}

void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw config::cannot_write_to_stdout();
}

/// Listens until the time has come or a signal.
void listen(lcm_io::Bus& bus, Clock::time_point until) {
  while (!lcm_io::stop_requested() && Clock::now() < until) bus.handle(kWait);
}

std::chrono::duration<double> seconds(double value) { return std::chrono::duration<double>(value); }

void watch(lcm_io::Bus& bus, StatusBoard& board, const Options& options, Clock::time_point start) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  auto due = Clock::now();
  while (!lcm_io::stop_requested()) {
    due += std::chrono::duration_cast<Clock::duration>(seconds(options.period_s));
    listen(bus, due);
    const std::string table =
        table_text(board.rows(seconds_since(start)), terminal, terminal_width());
    print((terminal ? kHomeAndClear : "") + table + (terminal ? "" : "\n"));
  }
}

void show_once(lcm_io::Bus& bus, StatusBoard& board, const Options& options,
               Clock::time_point start, const std::string& url) {
  listen(bus, start + std::chrono::duration_cast<Clock::duration>(seconds(options.wait_s)));
  const std::vector<Row> rows = board.rows(seconds_since(start));
  print(table_text(rows, isatty(STDOUT_FILENO) != 0, terminal_width()));
  if (rows.empty())
    throw std::runtime_error("no module was heard on " + url +
                             "; are they running, and with the same URL? see limbcast-doctor");
  const auto errors =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.is_in_error(); });
  if (errors > 0) throw std::runtime_error("modules in error: " + std::to_string(errors));
}

void run(int argc, const char* const* argv) {
  Options options;
  config::Section section("status");
  declare(section, options);
  config::Parser parser("limbcast-status", "Shows how all modules on all hosts fare, live.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("status", parser.common().log_level);
  lcm_io::install_signal_handlers();

  const Clock::time_point start = Clock::now();
  StatusBoard board(split(options.expect), options.board);
  lcm_io::Bus bus(parser.common().lcm_url);
  bus.set_on_malformed([](const std::string& channel, const std::string& reason) {
    config::log(config::LogLevel::kWarning, channel + ": message dropped: " + reason);
  });
  bus.subscribe<module_status_t>(options.channel, lcm_io::Keep::kAll,
                                 [&](const module_status_t& message) {
                                   board.take(lcm_io::from_message(message), seconds_since(start));
                                 });
  if (options.once) {
    show_once(bus, board, options, start, lcm_io::effective_url(parser.common().lcm_url));
  } else {
    watch(bus, board, options, start);
  }
}

}  // namespace
}  // namespace limbcast::status

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-status",
                                       [&] { limbcast::status::run(argc, argv); });
}
