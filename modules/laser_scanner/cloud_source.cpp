#include "modules/laser_scanner/cloud_source.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "common/file_extension.hpp"
#include "common/formatted.hpp"
#include "common/human_model/ground_truth_json.hpp"
#include "common/input_file.hpp"
#include "modules/laser_scanner/axes.hpp"
#include "modules/laser_scanner/packet_source.hpp"
#include "modules/laser_scanner/velodyne.hpp"

namespace limbcast::laser_scanner {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const std::string kLivePrefix = "velodyne:";

bool is_live_velodyne(const std::string& source) {
  return source.compare(0, kLivePrefix.size(), kLivePrefix) == 0;
}

/// What the kinds of sources mean by x, y and z where nobody says otherwise.
std::string axes_of(const CloudSourceParams& params, const std::string& usual) {
  return params.axes.empty() ? usual : params.axes;
}

RawCloud converted(const RawCloud& raw, const Axes& axes, const CloudSourceParams& params) {
  RawCloud cloud;
  for (std::size_t i = 0; i < raw.points.size(); ++i) {
    const Eigen::Vector3f point_m = axes(raw.points[i]);
    const float range_m = point_m.norm();
    if (range_m < params.near_limit_m || range_m > params.far_limit_m) continue;
    cloud.points.push_back(point_m);
    if (!raw.colors.empty()) cloud.colors.push_back(raw.colors[i]);
    if (!raw.intensities.empty()) cloud.intensities.push_back(raw.intensities[i]);
    if (!raw.rings.empty()) cloud.rings.push_back(raw.rings[i]);
  }
  return cloud;
}

/// Why no point of a cloud is left; empty where one is. `advice`: where all are too near or far.
std::string fault_of(const RawCloud& kept, const RawCloud& raw, const CloudSourceParams& params,
                     const std::string& where, const std::string& advice) {
  if (!kept.points.empty()) return "";
  if (raw.points.empty()) return where + ": has no finite points; is the scanner's view free?";
  return where +
         formatted(": none of %zu points lies within %g to %g m; ", raw.points.size(),
                   params.near_limit_m, params.far_limit_m) +
         advice;
}

/// The ends of the names of files of clouds, as they are written in this folder.
std::vector<std::string> cloud_extensions(const std::string& folder) {
  std::vector<std::string> extensions = {".pcd", ".ply", ".bin"};
  const std::set<std::string> known(extensions.begin(), extensions.end());
  std::set<std::string> spelled_otherwise;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    const bool is_cloud = known.count(extension_of(entry.path())) > 0;
    if (is_cloud && known.count(extension) == 0) spelled_otherwise.insert(extension);
  }
  extensions.insert(extensions.end(), spelled_otherwise.begin(), spelled_otherwise.end());
  return extensions;
}

Stamp stamp_of(const CloudSourceParams& params, std::int64_t utime, std::int64_t sequence) {
  Stamp stamp;
  stamp.utime = utime;
  stamp.sequence = sequence;
  stamp.sensor = params.sensor;
  stamp.frame = params.frame;
  return stamp;
}

/// Files of clouds.
class CloudFiles : public CloudSource {
 public:
  CloudFiles(CloudSourceParams params, Recording recording)
      : params_(std::move(params)),
        recording_(std::move(recording)),
        axes_(axes_of(params_, "x,y,z"), params_.unit_m),
        kitti_axes_(axes_of(params_, "-y,-z,x"), params_.unit_m) {}

  std::optional<CloudFrame> next() override {
    if (ended()) return std::nullopt;
    CloudFrame frame = read(recording_.frames[index_]);
    ++sequence_;
    if (++index_ == recording_.frames.size() && params_.loop) {
      index_ = 0;
      loop_offset_us_ += round_duration_us(recording_, params_.recording.rate_hz);
    }
    return frame;
  }
  bool ended() const override { return index_ >= recording_.frames.size(); }
  bool live() const override { return false; }
  std::string description() const override {
    return params_.source + ": " + std::to_string(recording_.frames.size()) +
           " clouds, times from " + (recording_.has_timestamps ? "timestamps.csv" : "the rate");
  }

 private:
  CloudFrame read(const RecordedFrame& recorded) const {
    CloudFrame frame;
    frame.stamp = stamp_of(params_, recorded.time.utime + loop_offset_us_, sequence_);
    const RawCloud raw = read_cloud_file(recorded.first_path, params_.max_points);
    const bool is_kitti = extension_of(recorded.first_path) == ".bin";
    frame.cloud = converted(raw, is_kitti ? kitti_axes_ : axes_, params_);
    frame.fault =
        fault_of(frame.cloud, raw, params_, recorded.first_path,
                 params_.unit_m == 1.0 ? "give --unit-m 0.001 where they are in millimetres"
                                       : "is --unit-m right?");
    if (recorded.time.down) {
      frame.stamp.gravity.down = *recorded.time.down;
      frame.stamp.gravity.source = GravitySource::kRecording;
    }
    if (!recorded.truth_path.empty()) frame.truth = read_truth_of(frame.stamp, recorded.truth_path);
    return frame;
  }

  CloudSourceParams params_;
  Recording recording_;
  Axes axes_, kitti_axes_;
  std::size_t index_ = 0;
  std::int64_t sequence_ = 0, loop_offset_us_ = 0;
};

/// Packets of a Velodyne, recorded or live, put together to turns.
template <class Packets>
class VelodyneSource : public CloudSource {
 public:
  /// `argument`: path of the recording, or the port.
  template <class Argument>
  VelodyneSource(CloudSourceParams params, const Argument& argument, bool is_live)
      : params_(std::move(params)),
        packets_(argument),
        axes_(axes_of(params_, "x,-z,y"), 1.0),
        is_live_(is_live) {
    if (params_.model == "vlp16") decoder_.emplace(VelodyneModel::kVlp16);
    if (params_.model == "hdl32") decoder_.emplace(VelodyneModel::kHdl32);
  }

  std::optional<CloudFrame> next() override {
    while (const std::optional<Packet> packet = packets_.next()) {
      if (packet->payload.size() != kVelodynePacketBytes || !is_ours(*packet)) continue;
      last_packet_at_ = Clock::now();
      if (!decoder_ && !find_model(*packet)) continue;
      if (auto sweep = decoder_->add(packet->payload, packet->utime)) {
        const RawCloud raw{
            std::move(sweep->points_m), {}, std::move(sweep->intensities), std::move(sweep->rings)};
        RawCloud cloud = converted(raw, axes_, params_);
        std::string fault = fault_of(cloud, raw, params_, params_.source, "give other limits");
        return CloudFrame{
            stamp_of(params_, sweep->utime, sequence_++), std::move(cloud), {}, std::move(fault)};
      }
    }
    ended_ = !is_live_;
    if (ended_ && !decoder_ && model_finder_.num_packets() > 0) throw unknown_model();
    if (ended_ && sequence_ == 0) {
      throw InputError(params_.source +
                       ": holds no whole turn of a Velodyne; record for a second or more");
    }
    return std::nullopt;
  }
  bool ended() const override { return ended_; }
  bool live() const override { return is_live_; }
  std::string problem() const override {
    const std::string own = is_live_ ? silence() : torn_end();
    return own.empty() ? second_scanner() : own;
  }
  std::string description() const override {
    return params_.source + (is_live_ ? ": Velodyne, live" : ": Velodyne, recorded");
  }

 private:
  /// Packets are left out until they have told the model: they belong to the first turn, of which
  /// the beginning is missing anyway.
  bool find_model(const Packet& packet) {
    const std::optional<VelodyneModel> model = model_finder_.add(packet.payload);
    if (model) decoder_.emplace(*model);
    if (!model && model_finder_.gave_up()) throw unknown_model();
    return model.has_value();
  }
  /// A live scanner that sent at this time has sent nothing for too long since.
  bool is_silent_since(Clock::time_point packet_at) const {
    const std::chrono::duration<double> silent_for = Clock::now() - packet_at;
    return is_live_ && silent_for.count() >= params_.stall_timeout_s;
  }
  /// Two scanners would be mixed to one cloud, so the first one heard is kept to; until it is
  /// silent, as its address may change where it is switched on again.
  bool is_ours(const Packet& packet) {
    if (sender_.empty() || is_silent_since(last_packet_at_)) {
      sender_ = packet.sender;
      second_sender_.clear();
    }
    if (packet.sender == sender_) return true;
    if (second_sender_.empty()) second_sender_ = packet.sender;
    second_packet_at_ = Clock::now();
    return false;
  }
  /// What is wrong where another scanner sends to the same port; empty where none does.
  std::string second_scanner() const {
    if (second_sender_.empty() || is_silent_since(second_packet_at_)) return "";
    return params_.source + ": packets of " + second_sender_ + " are left out, as those of " +
           sender_ + " came first; give each scanner a port and a recording of its own";
  }
  /// What is wrong with a scanner that sends nothing; empty where it does.
  std::string silence() const {
    if (!is_silent_since(last_packet_at_)) return "";
    return params_.source + ": no packets for " + formatted("%g", params_.stall_timeout_s) +
           " s; is the scanner on, and does it send to this host and port?";
  }
  /// What is wrong with a recording that was read to its end; empty where nothing is.
  std::string torn_end() const {
    if (packets_.torn_bytes() == 0) return "";
    return params_.source + ": is torn, its last " + std::to_string(packets_.torn_bytes()) +
           " bytes are no whole packet and were left out";
  }
  InputError unknown_model() const {
    return InputError(params_.source + ": its packets name no known model; give --velodyne-model");
  }

  CloudSourceParams params_;
  Packets packets_;
  Axes axes_;
  bool is_live_;
  bool ended_ = false;
  VelodyneModelFinder model_finder_;
  std::optional<VelodyneDecoder> decoder_;
  std::string sender_, second_sender_;  ///< empty where there was none
  Clock::time_point last_packet_at_ = Clock::now(), second_packet_at_;
  std::int64_t sequence_ = 0;
};

std::unique_ptr<CloudSource> open_velodyne(const CloudSourceParams& params) {
  const std::string text = params.source.substr(kLivePrefix.size());
  char* end = nullptr;
  const long port = text.empty() ? kVelodynePort : std::strtol(text.c_str(), &end, 10);
  if ((end != nullptr && *end != '\0') || port < 1 || port > 65535) {
    throw InputError(params.source + ": '" + text + "' is no UDP port; give velodyne:2368");
  }
  return std::make_unique<VelodyneSource<UdpReceiver>>(params, static_cast<int>(port), true);
}

}  // namespace

bool is_of_packets(const std::string& source) {
  return is_live_velodyne(source) ||
         (extension_of(source) == ".pcap" && fs::is_regular_file(source));
}

std::unique_ptr<CloudSource> open_cloud_source(const CloudSourceParams& params) {
  const std::string& source = params.source;
  if (is_live_velodyne(source)) return open_velodyne(params);
  if (fs::is_directory(source)) {
    return std::make_unique<CloudFiles>(
        params, find_recording_of_files(source, cloud_extensions(source), params.recording));
  }
  const std::string remedy =
      "give a folder or file of clouds (.pcd, .ply, .bin), a .pcap recording, or velodyne:PORT";
  if (!fs::exists(source)) throw InputError(source + ": does not exist; " + remedy);
  check_is_file(source, remedy);
  if (extension_of(source) == ".pcap") {
    if (params.loop)
      throw InputError(source + ": a pcap recording cannot be looped; leave out --loop");
    return std::make_unique<VelodyneSource<PcapReader>>(params, source, false);
  }
  RecordedFrame frame;
  frame.time = {fs::path(source).stem().string(), params.recording.start_utime, {}};
  frame.first_path = source;
  return std::make_unique<CloudFiles>(params, Recording{{frame}, false, 0});
}

}  // namespace limbcast::laser_scanner
