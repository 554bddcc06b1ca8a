#include "modules/replay/chain.hpp"

#include <memory>
#include <stdexcept>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/module.hpp"

namespace limbcast::replay {
namespace {

using lcm_io::decode;
using lcm_io::LogEvent;

template <class Message>
LogEvent to_event(std::int64_t utime, const std::string& channel, const Message& message) {
  return {utime, channel, lcm_io::encode(message)};
}

template <class Message>
std::optional<Frame> frame_in(const LogEvent& event) {
  try {
    const stamp_t stamp = decode<Message>(event.data).stamp;
    return Frame{stamp.sensor, stamp.utime};
  } catch (const lcm_io::MessageError&) {
    return std::nullopt;
  }
}

}  // namespace

Chain::Chain(const ChainOptions& options)
    : options_(options),
      reconstructor_(options.reconstructor),
      segmenter_(options.segmenter),
      pose_fitter_(options.pose_fitter) {}

std::optional<Level> Chain::level_of(const std::string& channel) const {
  const auto& reconstructor = options_.reconstructor;
  if (channel == reconstructor.stereo_images_channel) return Level::kImages;
  if (channel == reconstructor.depth_images_channel) return Level::kImages;
  if (channel == options_.segmenter.point_cloud_channel) return Level::kClouds;
  if (channel == options_.pose_fitter.segments_channel) return Level::kSegments;
  if (channel == options_.pose_fitter.body_poses_channel) return Level::kPoses;
  return std::nullopt;
}

bool Chain::is_calibration(const std::string& channel) const {
  return channel == options_.reconstructor.stereo_calibration_channel;
}

std::optional<Frame> Chain::frame_of(const LogEvent& event) const {
  switch (level_of(event.channel).value()) {
    case Level::kImages:
      return event.channel == options_.reconstructor.depth_images_channel
                 ? frame_in<depth_images_t>(event)
                 : frame_in<stereo_images_t>(event);
    case Level::kClouds:
      return frame_in<point_cloud_t>(event);
    case Level::kSegments:
      return frame_in<segments_t>(event);
    case Level::kPoses:
      return frame_in<body_poses_t>(event);
  }
  return std::nullopt;
}

bool Chain::needs_calibration(const std::string& channel) const {
  return channel == options_.reconstructor.stereo_images_channel;
}

bool Chain::has_calibration(const std::string& sensor) const {
  return reconstructor_.find(sensor) != nullptr;
}

void Chain::on_calibration(const LogEvent& event) {
  reconstructor_.on_calibration(decode<stereo_calibration_t>(event.data));
}

void Chain::on_first_calibration(const LogEvent& event) {
  try {
    const auto message = decode<stereo_calibration_t>(event.data);
    if (reconstructor_.find(message.sensor) == nullptr) reconstructor_.on_calibration(message);
  } catch (const std::exception&) {
    // The same event comes again in its turn, and is counted then.
  }
}

std::function<FrameResult()> Chain::prepare(LogEvent event) const {
  Reconstructor stereo;
  if (event.channel == options_.reconstructor.stereo_images_channel)
    stereo = reconstructor_.find(frame_of(event).value_or(Frame{}).sensor);
  return [this, event = std::move(event), stereo = std::move(stereo)] {
    FrameResult result;
    try {
      work(event, stereo, result);
    } catch (const lcm_io::MessageError& error) {
      result.malformed = error.what();
    } catch (const std::exception& error) {
      result.failure = error.what();
    }
    return result;
  };
}

void Chain::work(const LogEvent& event, const Reconstructor& stereo, FrameResult& result) const {
  switch (level_of(event.channel).value()) {
    case Level::kImages:
      return from_images(event, stereo, result);
    case Level::kClouds:
      return from_cloud(event.utime, decode<point_cloud_t>(event.data), result);
    case Level::kSegments:
      return from_segments(event.utime, decode<segments_t>(event.data), result);
    case Level::kPoses:
      result.persons =
          static_cast<int>(lcm_io::from_message(decode<body_poses_t>(event.data)).persons.size());
      return;
  }
}

void Chain::from_images(const LogEvent& event, const Reconstructor& stereo,
                        FrameResult& result) const {
  point_cloud_t cloud;
  if (event.channel == options_.reconstructor.depth_images_channel) {
    cloud = reconstructor_.process(decode<depth_images_t>(event.data));
  } else {
    const auto images = decode<stereo_images_t>(event.data);
    if (stereo == nullptr)
      throw std::runtime_error("no calibration of stereo camera '" + images.stamp.sensor + "' on " +
                               options_.reconstructor.stereo_calibration_channel +
                               "; log that channel beside the images");
    cloud = reconstructor::Stage::process(*stereo, images);
  }
  result.events.push_back(to_event(event.utime, options_.reconstructor.point_cloud_channel, cloud));
  if (lcm_io::stop_requested()) return;
  from_cloud(event.utime, cloud, result);
}

void Chain::from_cloud(std::int64_t utime, const point_cloud_t& cloud, FrameResult& result) const {
  const segments_t segments = segmenter_.process(cloud);
  result.events.push_back(to_event(utime, options_.segmenter.segments_channel, segments));
  if (lcm_io::stop_requested()) return;
  from_segments(utime, segments, result);
}

void Chain::from_segments(std::int64_t utime, const segments_t& segments,
                          FrameResult& result) const {
  const body_poses_t poses = pose_fitter_.process(segments);
  result.events.push_back(to_event(utime, options_.pose_fitter.body_poses_channel, poses));
  result.persons = poses.num_persons;
}

}  // namespace limbcast::replay
