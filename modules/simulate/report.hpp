#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "modules/simulate/simulator.hpp"

namespace limbcast::simulate {

struct ReportParams {
  double from_m = 1.5, to_m = 6.0, step_m = 0.5;  ///< distances of people from the camera
  int frames = 12;                                ///< simulated at each distance
  double right_share =
      0.95;  ///< of the visible joints within 10 cm: from here on poses count as right
};

/// What can be expected of a sensor at one distance.
struct ReportRow {
  double distance_m = 0.0;
  double sigma_z_m = 0.0;         ///< standard deviation of a measured distance there
  double points_on_person = 0.0;  ///< pixels or returns, mean of the frames
  /// From runs of the chain; nothing where nobody was in view.
  std::optional<double> found_percent, joints_percent, joint_error_cm, right_percent, pointing_deg;
};

/// Standard deviation of the distance that the sensor measures at `distance_m`. Stereo: Z^2 sigma_d
/// / (f B), from differentiating Z = f B / d.
double sigma_z_m(const SimulatorParams& params, double distance_m);

/// From the nearest to the farthest.
std::vector<double> distances_m(const ReportParams& report);

/// Simulates people who point at each distance, runs limbcast-replay and limbcast-evaluate of the
/// folder `programs` on them and reads their figures: the rows done so far where the program is
/// told to end. Throws std::runtime_error where these fail.
std::vector<ReportRow> make_report(const SimulatorParams& params, const ReportParams& report,
                                   const std::string& programs, std::uint64_t seed);

/// The table, and to what distance poses are right.
void print_report(const std::vector<ReportRow>& rows, const ReportParams& report,
                  std::ostream& out);

}  // namespace limbcast::simulate
