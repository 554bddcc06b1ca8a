#include <cmath>
#include <filesystem>
#include <limbcast/point_cloud_t.hpp>
#include <optional>
#include <string>

#include "common/cloud/ground_plane.hpp"
#include "common/formatted.hpp"
#include "common/input_error.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/sources/log_playback.hpp"
#include "common/sources/source_loop.hpp"
#include "modules/laser_scanner/cloud_source.hpp"

namespace limbcast::laser_scanner {
namespace {

struct Options {
  SourceProcessOptions process;
  CloudSourceParams source;
  double noise_m = 0.02;
  bool ground_plane = true;
  std::string cloud_channel = "POINT_CLOUD";
};

void declare(config::Section& section, Options& options) {
  options.process.sensor = "laser";
  options.source.model = "auto";
  section.add(
      "source", options.source.source,
      "folder or file of clouds (.pcd, .ply, .bin), .pcap recording of a Velodyne, velodyne:PORT");
  section.add(
      "axes", options.source.axes,
      "the sensor's axes that point right, down and forward, e.g. -y,-z,x for x forward, z up; "
      "default: x,y,z for .pcd and .ply, -y,-z,x for .bin, x,-z,y for a Velodyne");
  section.add("unit-m", options.source.unit_m, "m", "length of one unit in the files", {1e-6, 1e3});
  section.add_choice("velodyne-model", options.source.model, {"auto", "vlp16", "hdl32"},
                     "auto: as its packets say");
  section.add("stall-timeout-s", options.source.stall_timeout_s, "s",
              "without a packet for this long a live Velodyne counts as stalled", {0.1, 3600.0});
  section.add("near-limit-m", options.source.near_limit_m, "m", "leave out nearer points",
              {0.0, 1e3});
  section.add("far-limit-m", options.source.far_limit_m, "m", "leave out farther points",
              {0.0, 1e3});
  section.add("noise-m", options.noise_m, "m", "standard deviation of the sensor's distances",
              {0.0, 1.0});
  section.add("ground-plane", options.ground_plane,
              "find gravity and the sensor's height from the ground where nobody told them");
  declare_playback(section, options.process);
  section.add_channel("cloud-channel", options.cloud_channel, "channel of the clouds");
}

Cloud make_cloud(CloudFrame& frame, const Options& options) {
  Cloud cloud;
  cloud.stamp = frame.stamp;
  cloud.stamp.depth_noise.constant_m = static_cast<float>(options.noise_m);
  cloud.points_m = std::move(frame.cloud.points);
  cloud.colors = std::move(frame.cloud.colors);
  cloud.intensities = std::move(frame.cloud.intensities);
  cloud.rings = std::move(frame.cloud.rings);
  cloud.width = static_cast<int>(cloud.points_m.size());
  cloud.height = 1;
  return cloud;
}

/// Tells who told gravity: always in the status, in the program's log when it is another than
/// before.
class GravityReport {
 public:
  void tell(const Gravity& gravity, const std::optional<GroundPlane>& ground, Outlet& outlet) {
    const std::string text = describe(gravity, ground);
    outlet.set_note(text);
    if (last_source_ != gravity.source) config::log(config::LogLevel::kInfo, text);
    last_source_ = gravity.source;
  }

 private:
  std::optional<GravitySource> last_source_;
};

/// Tells of clouds without points: in the status, or as one line where a log is written.
class EmptyCloudReport {
 public:
  void tell(const std::string& fault, bool to_log, Outlet& outlet) {
    const bool is_new = fault_.empty();
    if (fault.empty()) {
      if (!fault_.empty()) config::log(config::LogLevel::kInfo, "over: " + fault_);
      fault_.clear();
      return;
    }
    // The first one's text stands for those that follow, whose numbers differ.
    if (is_new) fault_ = fault;
    if (!to_log) {
      outlet.report_problem(fault_);
    } else if (is_new) {
      config::log(config::LogLevel::kWarning, fault_);
    }
  }

 private:
  std::string fault_;
};

void check_limits(const CloudSourceParams& source) {
  if (source.near_limit_m < source.far_limit_m) return;
  throw config::UsageError(formatted("'near-limit-m' is %g, must be below 'far-limit-m', %g",
                                     source.near_limit_m, source.far_limit_m) +
                           "; no point lies within");
}

void run(Options& options, const config::Parser& parser) {
  if (options.source.source.empty()) {
    throw config::UsageError("--source is missing; see limbcast-laser-scanner --help");
  }
  if (begins_as_lcm_log(options.source.source))
    throw InputError(options.source.source + ": is an LCM log; play its clouds with lcm-logplayer");
  if (std::filesystem::exists(options.source.source))
    refuse_live_options(options.source.source, {"stall-timeout-s"}, parser);
  keep_start_time_out(options.source.source, is_of_packets(options.source.source), parser);
  check_limits(options.source);
  options.process.source.source = options.source.source;  // a log must not be written over it
  options.process.source.loop = options.source.loop = options.process.source.loop;
  require_end(options.process);
  const double rate_hz = options.process.source.rate_hz;
  options.source.recording = {rate_hz > 0.0 ? rate_hz : kDefaultRate_hz,
                              std::llround(1e6 * options.process.start_time_s)};
  options.source.max_points = lcm_io::kMaxPoints;
  options.source.sensor = options.process.sensor;
  options.source.frame = options.process.sensor + "/scan";
  GravityReport gravity_report;
  EmptyCloudReport empty_cloud_report;
  FrameSender<CloudFrame> sender(options.process, {}, [&](Outlet& outlet, CloudFrame& frame) {
    empty_cloud_report.tell(frame.fault, !options.process.log.empty(), outlet);
    Cloud cloud = make_cloud(frame, options);
    const auto ground = options.ground_plane ? complete_gravity(cloud) : std::nullopt;
    gravity_report.tell(cloud.stamp.gravity, ground, outlet);
    outlet.send_frame(options.cloud_channel, lcm_io::to_message(cloud));
  });
  const std::unique_ptr<CloudSource> source = open_cloud_source(options.source);
  run_frames("laser_scanner", options.process, parser.common(), *source, sender,
             source->description());
}

}  // namespace
}  // namespace limbcast::laser_scanner

int main(int argc, char** argv) {
  using namespace limbcast;
  return config::run_program("limbcast-laser-scanner", [&] {
    laser_scanner::Options options;
    config::Section section("laser_scanner");
    laser_scanner::declare(section, options);
    config::Parser parser("limbcast-laser-scanner",
                          "publishes the clouds of a laser range finder, live or recorded");
    parser.add(section);
    if (!parser.parse(argc, argv)) return;
    laser_scanner::run(options, parser);
  });
}
