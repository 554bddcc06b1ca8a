#include "modules/viewer/log_frames.hpp"

#include <limbcast/body_poses_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <optional>

#include "common/config/log.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/segments_codec.hpp"

namespace limbcast::viewer {
namespace {

using lcm_io::decode;

/// Of a message that belongs to a frame; nothing for other channels.
std::optional<stamp_t> stamp_of(const lcm_io::LogEvent& event, const ViewChannels& channels) {
  if (event.channel == channels.point_cloud) return decode<point_cloud_t>(event.data).stamp;
  if (event.channel == channels.segments) return decode<segments_t>(event.data).stamp;
  if (event.channel == channels.poses || event.channel == channels.truth)
    return decode<body_poses_t>(event.data).stamp;
  return std::nullopt;
}

void add(const lcm_io::LogEvent& event, const ViewChannels& channels, FrameAssembler& assembler) {
  using lcm_io::from_message;
  if (event.channel == channels.point_cloud)
    assembler.add(from_message(decode<point_cloud_t>(event.data)));
  if (event.channel == channels.segments)
    assembler.add(from_message(decode<segments_t>(event.data)));
  if (event.channel == channels.poses)
    assembler.add(from_message(decode<body_poses_t>(event.data)));
  if (event.channel == channels.truth)
    assembler.add_truth(from_message(decode<body_poses_t>(event.data)));
}

}  // namespace

ModuleFigures figures_of(const lcm_io::ModuleStatus& status) {
  return {status.module, status.host, status.rate_out_hz, status.latency_p50_ms};
}

LogFrames::LogFrames(const std::string& log, const ViewChannels& channels)
    : channels_(channels), reader_(log) {
  std::map<Key, Place> places;
  std::int64_t begin = 0;
  while (const auto event = reader_.next()) {
    try {
      note(*event, begin, places);
    } catch (const lcm_io::MessageError& error) {
      drop(*event, begin, error.what());
    }
    begin = reader_.position_bytes();
  }
  torn_bytes_ = reader_.torn_bytes();
  for (auto& [key, place] : places)
    if (place.has_more_than_truth) frames_.push_back(std::move(place));
}

void LogFrames::note(const lcm_io::LogEvent& event, std::int64_t begin,
                     std::map<Key, Place>& places) {
  if (event.channel == channels_.status) take_status(event);
  const auto stamp = stamp_of(event, channels_);
  if (!stamp) {
    if (lcm_io::fingerprint_of(event.data) == body_poses_t::getHash())
      other_pose_channels_.insert(event.channel);
    return;
  }
  has_poses_ |= event.channel == channels_.poses;
  Place& place = places[{stamp->utime, stamp->sensor}];
  if (place.events.empty())
    for (const auto& [name, figures] : modules_) place.modules.push_back(figures);
  place.events.push_back(begin);
  place.has_more_than_truth |= event.channel != channels_.truth;
}

void LogFrames::take_status(const lcm_io::LogEvent& event) {
  const ModuleFigures figures =
      figures_of(lcm_io::from_message(decode<module_status_t>(event.data)));
  modules_[figures.host + '\n' + figures.module] = figures;
}

void LogFrames::drop(const lcm_io::LogEvent& event, std::int64_t begin, const std::string& reason) {
  if (malformed_.empty())
    config::log(config::LogLevel::kWarning, event.channel + ": message dropped: " + reason);
  malformed_.insert(begin);
}

ViewFrame LogFrames::frame(int number) {
  const Place& place = frames_.at(static_cast<std::size_t>(number));
  FrameAssembler assembler;
  for (const std::int64_t begin : place.events) {
    reader_.seek(begin);
    const auto event = reader_.next();
    if (!event) break;
    try {
      add(*event, channels_, assembler);
    } catch (const lcm_io::MessageError& error) {
      drop(*event, begin, error.what());
    }
  }
  ViewFrame frame = assembler.next_at_end().value_or(ViewFrame{});
  frame.number = number;
  frame.modules = place.modules;
  return frame;
}

}  // namespace limbcast::viewer
