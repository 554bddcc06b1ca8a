#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/formatted.hpp"
#include "common/units.hpp"
#include "modules/log/log_info.hpp"

namespace limbcast::logs {
namespace {

using Json = nlohmann::ordered_json;

std::string bytes_text(std::int64_t bytes) {
  constexpr double kKilo = 1000.0;
  const auto value = static_cast<double>(bytes);
  if (value >= kKilo * kKilo) return formatted("%.1f MB", value / (kKilo * kKilo));
  if (value >= kKilo) return formatted("%.1f kB", value / kKilo);
  return formatted("%lld B", static_cast<long long>(bytes));
}

/// "2026-04-01 00:26:40.000 UTC (1775003200.000000)"
std::string time_text(std::int64_t utime) {
  const std::time_t seconds = utime / kMicrosecondsPerSecond<std::int64_t>;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S", &utc);
  const auto micros = static_cast<int>(utime % kMicrosecondsPerSecond<std::int64_t>);
  return formatted("%s.%03d UTC (%lld.%06d)", text, micros / 1000, static_cast<long long>(seconds),
                   micros);
}

void write_head(const LogInfo& info, std::ostream& out) {
  out << formatted("log        %s, %s\n", info.path.c_str(), bytes_text(info.size_bytes).c_str());
  out << formatted("events     %lld, numbers %lld to %lld", static_cast<long long>(info.events),
                   static_cast<long long>(info.first_number),
                   static_cast<long long>(info.last_number));
  if (info.missing_numbers > 0)
    out << formatted(", %lld numbers missing", static_cast<long long>(info.missing_numbers));
  out << '\n';
  if (info.events > 0)
    out << formatted("begin      %s\nend        %s\nduration   %.3f s\n",
                     time_text(info.first_utime).c_str(), time_text(info.last_utime).c_str(),
                     info.duration_s());
  if (info.backward_steps > 0)
    out << formatted("order      %lld events are earlier than the one before\n",
                     static_cast<long long>(info.backward_steps));
  if (info.damaged_bytes > 0)
    out << formatted("damage     %s between events hold no whole event and are lost\n",
                     bytes_text(info.damaged_bytes).c_str());
  if (info.torn_bytes > 0)
    out << formatted("torn       the last %lld bytes are no whole event and are lost\n",
                     static_cast<long long>(info.torn_bytes));
}

void write_channels(const LogInfo& info, std::ostream& out) {
  out << formatted("\n%-20s %-22s %8s %10s %10s %12s\n", "channel", "type", "messages", "rate",
                   "mean size", "longest gap");
  for (const auto& [name, channel] : info.channels) {
    const std::string type = channel.several_types ? "several types"
                             : channel.foreign     ? "foreign " + channel.type
                                                   : channel.type;
    out << formatted(
        "%-20s %-22s %8lld %7.2f Hz %10s %10.3f s\n", name.c_str(), type.c_str(),
        static_cast<long long>(channel.messages), channel.rate_hz(),
        bytes_text(channel.bytes / channel.messages).c_str(),
        static_cast<double>(channel.longest_gap_us) / kMicrosecondsPerSecond<std::int64_t>);
    for (const auto& [sensor, frames] : channel.sensors) {
      out << formatted("  sensor %s: %lld frames, %lld sequence numbers lost", sensor.c_str(),
                       static_cast<long long>(frames.frames), static_cast<long long>(frames.lost));
      if (frames.repeated > 0)
        out << formatted(", %lld came again", static_cast<long long>(frames.repeated));
      if (frames.restarts > 0)
        out << formatted(", started again %lld times", static_cast<long long>(frames.restarts));
      out << '\n';
    }
    if (channel.malformed > 0)
      out << formatted("  %lld malformed, the first: %s\n",
                       static_cast<long long>(channel.malformed), channel.first_malformed.c_str());
  }
}

void write_cameras(const LogInfo& info, std::ostream& out) {
  if (!info.cameras.empty()) out << "\ncalibration\n";
  for (const auto& [sensor, camera] : info.cameras) {
    out << formatted("  %s: %d x %d px, focal length %.1f px", sensor.c_str(), camera.width,
                     camera.height, camera.focal_px);
    if (camera.baseline_m > 0.0) out << formatted(", baseline %.4f m", camera.baseline_m);
    out << (camera.has_gravity ? ", tells gravity" : "");
    if (camera.changes > 0)
      out << formatted(", changed %lld times", static_cast<long long>(camera.changes));
    out << '\n';
  }
}

void write_modules(const LogInfo& info, std::ostream& out) {
  if (!info.modules.empty()) out << "\nhosts and modules, as their last status says\n";
  for (const ModuleInfo& module : info.modules) {
    out << formatted(
        "  %s: %s (pid %d, version %s) %s, %lld in, %lld out, %lld lost, %lld skipped, %lld "
        "malformed\n",
        module.host.c_str(), module.module.c_str(), module.pid, module.version.c_str(),
        module.state.c_str(), static_cast<long long>(module.received),
        static_cast<long long>(module.published), static_cast<long long>(module.lost),
        static_cast<long long>(module.skipped), static_cast<long long>(module.malformed));
    if (!module.last_error.empty()) out << "    last error: " << module.last_error << '\n';
  }
}

Json channel_json(const ChannelInfo& channel) {
  Json json = {{"type", channel.foreign ? Json(nullptr) : Json(channel.type)},
               {"messages", channel.messages},
               {"bytes", channel.bytes},
               {"rate_hz", channel.rate_hz()},
               {"first_utime", channel.first_utime},
               {"last_utime", channel.last_utime},
               {"longest_gap_us", channel.longest_gap_us},
               {"malformed", channel.malformed},
               {"sensors", Json::object()}};
  if (channel.foreign) json["fingerprint"] = channel.type;
  for (const auto& [sensor, frames] : channel.sensors)
    json["sensors"][sensor] = {{"frames", frames.frames},
                               {"lost", frames.lost},
                               {"repeated", frames.repeated},
                               {"restarts", frames.restarts}};
  return json;
}

Json camera_json(const CameraInfo& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"focal_px", camera.focal_px},
          {"baseline_m", camera.baseline_m},
          {"has_gravity", camera.has_gravity},
          {"changes", camera.changes}};
}

Json module_json(const ModuleInfo& module) {
  return {{"host", module.host},
          {"module", module.module},
          {"pid", module.pid},
          {"version", module.version},
          {"state", module.state},
          {"received", module.received},
          {"published", module.published},
          {"lost", module.lost},
          {"skipped", module.skipped},
          {"malformed", module.malformed},
          {"last_error", module.last_error}};
}

}  // namespace

std::string info_text(const LogInfo& info) {
  std::ostringstream out;
  write_head(info, out);
  write_channels(info, out);
  write_cameras(info, out);
  write_modules(info, out);
  return out.str();
}

std::string info_json(const LogInfo& info) {
  Json json = {{"path", info.path},
               {"size_bytes", info.size_bytes},
               {"events", info.events},
               {"first_number", info.first_number},
               {"last_number", info.last_number},
               {"missing_numbers", info.missing_numbers},
               {"first_utime", info.first_utime},
               {"last_utime", info.last_utime},
               {"duration_s", info.duration_s()},
               {"backward_steps", info.backward_steps},
               {"damaged_bytes", info.damaged_bytes},
               {"torn_bytes", info.torn_bytes},
               {"channels", Json::object()},
               {"cameras", Json::object()},
               {"modules", Json::array()}};
  for (const auto& [name, channel] : info.channels) json["channels"][name] = channel_json(channel);
  for (const auto& [sensor, camera] : info.cameras) json["cameras"][sensor] = camera_json(camera);
  for (const ModuleInfo& module : info.modules) json["modules"].push_back(module_json(module));
  // Names on foreign channels may be no UTF-8.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace limbcast::logs
