#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_calibration_t.hpp>
#include <string>
#include <thread>
#include <vector>

#include "common/config/options.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/log_file.hpp"
#include "common/lcm_io/module.hpp"

namespace limbcast::logs {

inline constexpr std::int64_t kBegin = 1'000'000'000'000;
inline constexpr std::int64_t kFrame_us = 100'000;

inline body_poses_t poses_of_frame(int number, const std::string& sensor = "front") {
  BodyPoses poses;
  poses.stamp.utime = kBegin + number * kFrame_us;
  poses.stamp.sequence = number;
  poses.stamp.sensor = sensor;
  return lcm_io::to_message(poses);
}

inline stereo_calibration_t calibration_of(const std::string& sensor, double baseline_m = 0.12) {
  StereoCalibration calibration;
  calibration.left.camera = {640, 480, 520.0, 520.0, 320.0, 240.0};
  calibration.right = calibration.left;
  calibration.T = {-baseline_m, 0.0, 0.0};
  return lcm_io::to_message(calibration, kBegin, sensor);
}

inline module_status_t status_of(const std::string& host, const std::string& module) {
  module_status_t status{};
  status.host = host;
  status.module = module;
  status.pid = 7;
  status.version = "0.1.0";
  status.state = "running";
  status.num_lost = 3;
  return status;
}

inline std::vector<char> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::string& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Ten frames of sensor "front" a tenth of a second apart, with a foreign message 50 ms behind
/// each, after a calibration: events 0 (calibration), 1 (frame 0), 2 (foreign), 3 (frame 1) ...
inline void write_ten_frames(const std::string& path) {
  lcm_io::LogWriter log(path);
  log.write(kBegin, "STEREO_CALIBRATION", calibration_of("front"));
  for (int i = 0; i < 10; ++i) {
    log.write(kBegin + i * kFrame_us, "BODY_POSES", poses_of_frame(i));
    log.write({kBegin + i * kFrame_us + kFrame_us / 2,
               "FOREIGN",
               {1, 2, 3, 4, 5, 6, 7, 8, static_cast<std::uint8_t>(i)}});
  }
  log.close();
}

inline std::vector<lcm_io::LogEvent> events_in(const std::string& path) {
  std::vector<lcm_io::LogEvent> events;
  lcm_io::LogReader reader(path);
  while (auto event = reader.next()) events.push_back(std::move(*event));
  return events;
}

/// Ends with the program's exit code, but leaves the tests' folders.
template <class Command>
[[noreturn]] void run_and_exit(const Command& command) {
  std::_Exit(config::run_program("log", command));
}

template <class Command>
[[noreturn]] void run_interrupted(const Command& command) {
  run_and_exit([&command] {
    lcm_io::request_stop();
    command();
  });
}

/// Runs a command that writes more than a pipe holds (4 kB) to `pipe`, which is made, at once: it
/// is told to end when the first of it came out, and before the rest is taken.
template <class Command>
[[noreturn]] void run_interrupted_by_last_output(const std::string& pipe, const Command& command) {
  const bool made = mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR) == 0;
  const int file = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  if (!made || file < 0 || fcntl(file, F_SETPIPE_SZ, 4096) < 0) std::abort();
  std::thread([file] {
    pollfd output{file, POLLIN, 0};
    poll(&output, 1, -1);
    lcm_io::request_stop();
    std::array<char, 4096> bytes{};
    do poll(&output, 1, -1);
    while (read(file, bytes.data(), bytes.size()) != 0);
  }).detach();
  run_and_exit(command);
}

inline bool same(const lcm_io::LogEvent& a, const lcm_io::LogEvent& b) {
  return a.utime == b.utime && a.channel == b.channel && a.data == b.data && a.number == b.number;
}

}  // namespace limbcast::logs
