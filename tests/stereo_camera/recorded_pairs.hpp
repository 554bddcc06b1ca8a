#pragma once

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "common/camera/encoded_image.hpp"
#include "common/lcm_io/log_file.hpp"
#include "tests/common/sources/test_pictures.hpp"

namespace limbcast::test {

inline constexpr int kWidth = 64, kHeight = 48;
/// Right pictures are this much lighter than their left ones, so that a wrong pair shows.
inline constexpr int kRightLighter = 60;

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string write_stereo_calibration(const std::string& folder, double baseline_m = 0.12,
                                            const std::string& cx = "32.") {
  const std::string matrix = ": !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: ";
  const std::string K = "[ 50., 0., " + cx + ", 0., 50., 24., 0., 0., 1. ]\n";
  std::string text = "%YAML:1.0\n---\nimage_width: 64\nimage_height: 48\n";
  text += "K1" + matrix + K + "K2" + matrix + K;
  text += "R" + matrix + "[ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]\n";
  text += "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ " +
          std::to_string(-baseline_m) + ", 0., 0. ]\n";
  std::string path = folder + "/calibration.yml";
  write_text(path, text);
  return path;
}

/// Grey level of the first frame's left picture, and by how much each frame is lighter than the one
/// before it.
inline constexpr int kFirstLevel = 40, kLevelStep = 5;

/// Pairs frame_0, frame_1 ... of one grey level each, taken every `period_us` from 1000 s on.
inline void write_pairs(const std::string& folder, int frames, std::int64_t period_us) {
  std::string times = "name,utime\n";
  for (int i = 0; i < frames; ++i) {
    const std::string name = "frame_" + std::to_string(i);
    const std::string stem = std::string(folder).append("/").append(name);
    const int level = kFirstLevel + kLevelStep * i;
    test::write_bytes(stem + "_left.jpg",
                      encode_jpeg(test::grey_picture(kWidth, kHeight, level), 95));
    test::write_bytes(stem + "_right.jpg",
                      encode_jpeg(test::grey_picture(kWidth, kHeight, level + kRightLighter), 95));
    times.append(name)
        .append(",")
        .append(std::to_string(1'000'000'000 + i * period_us))
        .append("\n");
  }
  write_text(folder + "/timestamps.csv", times);
}

inline std::vector<lcm_io::LogEvent> events_of(const std::string& log) {
  lcm_io::LogReader reader(log);
  std::vector<lcm_io::LogEvent> events;
  while (auto event = reader.next()) events.push_back(std::move(*event));
  return events;
}

inline std::vector<std::string> channels_of(const std::vector<lcm_io::LogEvent>& events) {
  std::vector<std::string> channels;
  channels.reserve(events.size());
  for (const lcm_io::LogEvent& event : events) channels.push_back(event.channel);
  return channels;
}

}  // namespace limbcast::test
