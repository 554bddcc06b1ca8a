#pragma once

#include <string>

#include "common/config/options.hpp"
#include "modules/simulate/report.hpp"
#include "modules/simulate/simulator.hpp"

namespace limbcast::simulate {

/// Options of limbcast-simulate: what users turn, with their defaults.
struct SimulateOptions {
  std::string output, log;  ///< both empty: live over LCM
  std::string sensor_name = "simulated";
  std::string set = "pointing";
  std::string sensor = "stereo";
  std::string noise = "varied";
  std::string posture = "any", motion = "any";
  int frames = 20, first = 0, seed = 1, persons = 0;
  double rate_hz = 10.0;  ///< of live frames
  bool loop = false;
  bool report = false;  ///< instead of frames: to what distance poses are right
  ReportParams report_params;
  SimulatorParams params;
};

/// Binds the keys of section [simulate].
void declare(config::Section& section, SimulateOptions& options);

/// The parameters that the options ask for. Throws config::UsageError where they contradict one
/// another.
SimulatorParams to_params(const SimulateOptions& options);

/// Throws config::UsageError where the command line gives options of another sensor, set or output
/// than was chosen. A robot's configuration file may tell them: of no use then.
void refuse_options_of_others(const SimulateOptions& options, const config::Parser& parser);

}  // namespace limbcast::simulate
