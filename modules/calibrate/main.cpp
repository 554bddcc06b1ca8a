#include "common/config/options.hpp"
#include "modules/calibrate/commands.hpp"

int main(int argc, char** argv) {
  bool good = true;
  const int exit_code = limbcast::config::run_program(
      "limbcast-calibrate", [&] { good = limbcast::calibrate::run_stereo(argc, argv); });
  return exit_code != 0 ? exit_code : good ? 0 : 1;
}
