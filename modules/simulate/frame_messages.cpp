#include "modules/simulate/frame_messages.hpp"

#include <cmath>
#include <opencv2/core.hpp>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/simulate/truth.hpp"

namespace limbcast::simulate {
namespace {

constexpr int kJpegQuality = 92;  // the pairs of the demo log: at most 250 kB a message

Stamp stamp_of(const SimulatedFrame& frame, const std::string& sensor,
               const std::string& frame_name, std::int64_t sequence) {
  Stamp stamp;
  stamp.utime = frame.scenario.utime;
  stamp.sequence = sequence;
  stamp.sensor = sensor;
  stamp.frame = sensor + "/" + frame_name;
  stamp.gravity.down = frame.told_down.cast<float>();
  stamp.gravity.source = GravitySource::kRecording;
  return stamp;
}

DepthImages depth_images(const SimulatedFrame& frame, const Stamp& stamp) {
  DepthImages images;
  images.stamp = stamp;
  images.color = frame.left;
  frame.sensed_depth_m.convertTo(images.depth, CV_16U, 1000.0);
  return images;
}

Cloud laser_cloud(const LaserScan& scan, const LaserParams& params, Stamp stamp) {
  stamp.depth_noise.constant_m =
      static_cast<float>(std::hypot(params.range_sigma_m, params.ring_range_sigma_m));
  Cloud cloud;
  cloud.stamp = stamp;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    if (!scan.points_m[i].allFinite()) continue;
    cloud.points_m.push_back(scan.points_m[i]);
    cloud.intensities.push_back(scan.intensities[i]);
  }
  cloud.width = static_cast<int>(cloud.points_m.size());
  cloud.height = 1;
  return cloud;
}

}  // namespace

FrameMessages::FrameMessages(const SimulatorParams& params, const SimulatedFrame& frame,
                             const std::string& sensor, std::int64_t sequence) {
  PinholeCamera view = params.camera;
  Stamp stamp;
  if (params.sensor == SensorKind::kStereo) {
    stamp = stamp_of(frame, sensor, "left_rectified", sequence);
    stereo_ = lcm_io::to_message(StereoImages{stamp, frame.left, frame.right},
                                 lcm_io::ImageCoding::kJpeg, kJpegQuality);
    calibration_ = lcm_io::to_message(stereo_calibration(params), stamp.utime, sensor);
  } else if (params.sensor == SensorKind::kLaser) {
    view = {};
    stamp = stamp_of(frame, sensor, "laser_optical", sequence);
    cloud_ = lcm_io::to_message(laser_cloud(frame.laser, params.laser, stamp));
  } else {
    stamp = stamp_of(frame, sensor, "color_optical", sequence);
    depth_ =
        lcm_io::to_message(depth_images(frame, stamp), depth_calibration(params), kJpegQuality);
  }
  truth_ = lcm_io::to_message(truth_poses(frame.scenario, view, stamp));
}

void FrameMessages::restamp(std::int64_t utime, std::int64_t sequence) {
  const auto set = [&](stamp_t& stamp) {
    stamp.utime = utime;
    stamp.sequence = sequence;
  };
  if (stereo_) set(stereo_->stamp);
  if (calibration_) calibration_->utime = utime;
  if (depth_) set(depth_->stamp);
  if (cloud_) set(cloud_->stamp);
  set(truth_.stamp);
}

void FrameMessages::send(const Channels& channels, Outlet& outlet) const {
  // With every frame: small, and whoever joins late knows it at once.
  if (calibration_) outlet.send(utime(), channels.stereo_calibration, *calibration_);
  if (stereo_) outlet.send_frame(channels.stereo_images, *stereo_);
  if (depth_) outlet.send_frame(channels.depth_images, *depth_);
  if (cloud_) outlet.send_frame(channels.point_cloud, *cloud_);
  outlet.send(utime(), channels.truth, truth_);
}

}  // namespace limbcast::simulate
