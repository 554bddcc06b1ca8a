#include <map>
#include <string>

#include "common/config/options.hpp"
#include "modules/calibrate/commands.hpp"

namespace limbcast::calibrate {
namespace {

/// True: the result is good.
bool run(int argc, const char* const* argv) {
  using Command = bool (*)(int, const char* const*);
  static const std::map<std::string, Command> kCommands = {
      {"board", run_board}, {"check", run_check}, {"mounting", run_mounting}};
  const std::string first = argc > 1 ? argv[1] : "";
  const auto command = kCommands.find(first);
  // The command's name takes the place of the program's, which the parser passes over.
  if (command != kCommands.end()) return command->second(argc - 1, argv + 1);
  if (!first.empty() && first.front() != '-')
    throw config::UsageError("command line: '" + first +
                             "' is no command; use board, check or mounting, or options alone to "
                             "calibrate, see limbcast-calibrate --help");
  return run_stereo(argc, argv);
}

}  // namespace
}  // namespace limbcast::calibrate

int main(int argc, char** argv) {
  bool good = true;
  const int exit_code = limbcast::config::run_program(
      "limbcast-calibrate", [&] { good = limbcast::calibrate::run(argc, argv); });
  return exit_code != 0 ? exit_code : good ? 0 : 1;
}
