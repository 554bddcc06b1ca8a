#include <string>

#include "common/config/log.hpp"
#include "modules/simulate/frame_folder.hpp"
#include "modules/simulate/options.hpp"

namespace limbcast::simulate {
namespace {

void run(int argc, const char* const* argv) {
  SimulateOptions options;
  config::Section section("simulate");
  declare(section, options);
  config::Parser parser("limbcast-simulate", "Makes recordings with truth of simulated people.");
  parser.add(section);
  if (!parser.parse(argc, argv)) return;
  config::configure_log("simulate", parser.common().log_level);
  const SimulatorParams params = to_params(options);
  FrameFolder folder(options.output, params);
  for (int i = 0; i < options.frames; ++i) {
    folder.write(
        simulate_frame(params, static_cast<std::uint64_t>(options.seed), options.first + i));
    if ((i + 1) % 10 == 0 || i + 1 == options.frames) {
      config::log(config::LogLevel::kInfo,
                  std::to_string(i + 1) + " of " + std::to_string(options.frames) + " frames");
    }
  }
}

}  // namespace
}  // namespace limbcast::simulate

int main(int argc, char** argv) {
  return limbcast::config::run_program("limbcast-simulate",
                                       [&] { limbcast::simulate::run(argc, argv); });
}
