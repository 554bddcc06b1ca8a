#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "common/camera/recording.hpp"
#include "common/human_model/body_pose.hpp"
#include "common/sources/frame_source.hpp"
#include "modules/laser_scanner/cloud_file.hpp"

namespace limbcast::laser_scanner {

/// One scan, in our axes and metres.
struct CloudFrame {
  Stamp stamp;
  RawCloud cloud;
  std::optional<BodyPoses> truth;
  std::string fault;  ///< why the cloud has no points; empty where it has some
};
using CloudSource = FrameSource<CloudFrame>;

struct CloudSourceParams {
  std::string source;            ///< folder, cloud file, .pcap, or velodyne:PORT
  std::string axes;              ///< see Axes; empty: as the kind of source has them
  double unit_m = 1.0;           ///< metres for one unit of the files
  std::string model;             ///< of a Velodyne: "vlp16", "hdl32", or "auto", as its packets say
  double stall_timeout_s = 2.0;  ///< a live scanner that sends nothing for so long has stalled
  double near_limit_m = 0.3, far_limit_m = 30.0;
  std::size_t max_points = 0;  ///< files of more are refused
  RecordingParams recording;
  bool loop = false;
  std::string sensor, frame;  ///< for the stamp
};

/// A recording of packets or a live sensor, whose clocks tell the times.
bool is_of_packets(const std::string& source);

/// Opens a folder of .pcd, .ply or .bin files (with timestamps.csv and NAME_gt.json), one such
/// file, a pcap recording of a Velodyne, or a Velodyne itself. Throws InputError where that is not
/// possible.
std::unique_ptr<CloudSource> open_cloud_source(const CloudSourceParams& params);

}  // namespace limbcast::laser_scanner
