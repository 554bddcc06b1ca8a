#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "common/lcm_io/log_file.hpp"

namespace limbcast::replay {

inline std::vector<lcm_io::LogEvent> events_of(const std::string& log) {
  std::vector<lcm_io::LogEvent> events;
  lcm_io::LogReader reader(log);
  while (auto event = reader.next()) events.push_back(std::move(*event));
  return events;
}

inline void write_events(const std::string& log, const std::vector<lcm_io::LogEvent>& events) {
  lcm_io::LogWriter writer(log);
  for (const lcm_io::LogEvent& event : events) writer.write(event);
  writer.close();
}

inline std::vector<lcm_io::LogEvent> on_channel(const std::vector<lcm_io::LogEvent>& events,
                                                const std::string& channel) {
  std::vector<lcm_io::LogEvent> found;
  std::copy_if(events.begin(), events.end(), std::back_inserter(found),
               [&channel](const lcm_io::LogEvent& event) { return event.channel == channel; });
  return found;
}

/// The events of a log up to its n-th pair of images.
inline std::vector<lcm_io::LogEvent> first_frames(const std::string& log, int n) {
  std::vector<lcm_io::LogEvent> kept;
  for (lcm_io::LogEvent& event : events_of(log)) {
    if (event.channel == "STEREO_IMAGES" && n-- == 0) break;
    kept.push_back(std::move(event));
  }
  return kept;
}

/// Without what comes after the last one on `channel`.
inline std::vector<lcm_io::LogEvent> up_to_last(std::vector<lcm_io::LogEvent> events,
                                                const std::string& channel) {
  while (!events.empty() && events.back().channel != channel) events.pop_back();
  return events;
}

inline bool same(const lcm_io::LogEvent& a, const lcm_io::LogEvent& b) {
  return a.utime == b.utime && a.channel == b.channel && a.data == b.data;
}

inline bool same(const std::vector<lcm_io::LogEvent>& a, const std::vector<lcm_io::LogEvent>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const lcm_io::LogEvent& x, const lcm_io::LogEvent& y) { return same(x, y); });
}

}  // namespace limbcast::replay
