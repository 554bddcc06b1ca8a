#include "modules/simulate/frame_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "common/camera/calibration_writer.hpp"
#include "common/camera/picture_file.hpp"
#include "common/config/options.hpp"
#include "common/whole_file.hpp"
#include "modules/simulate/truth.hpp"

namespace limbcast::simulate {
namespace {

void write_image(const std::string& path, const cv::Mat& image) {
  if (image.empty()) return;
  write_picture(path, image, {cv::IMWRITE_JPEG_QUALITY, 95, cv::IMWRITE_PNG_COMPRESSION, 3});
}

cv::Mat millimetres(const cv::Mat& depth_m) {
  cv::Mat result;
  if (!depth_m.empty()) depth_m.convertTo(result, CV_16U, 1000.0);
  return result;
}

void write_pcd(const std::string& path, const LaserScan& scan) {
  std::ostringstream file;
  file << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 "
          "4 4 4\n"
       << "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " << scan.width << "\nHEIGHT " << scan.height
       << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << scan.points_m.size() << "\nDATA binary\n";
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    const float record[4] = {scan.points_m[i].x(), scan.points_m[i].y(), scan.points_m[i].z(),
                             scan.intensities[i]};
    file.write(reinterpret_cast<const char*>(record), sizeof(record));
  }
  write_whole_file(path, file.str());
}

}  // namespace

FrameFolder::FrameFolder(const std::string& folder, const SimulatorParams& params)
    : folder_(folder), params_(params) {
  const std::string timestamps = folder + "/timestamps.csv";
  config::make_output_folder("--output", folder);
  lock_.emplace(folder);
  std::error_code error;
  if (std::filesystem::exists(timestamps, error))
    throw config::UsageError(
        folder + ": holds a recording already; choose another --output or delete the folder");
  const std::string calibration = folder + "/calibration.yml";
  if (params.sensor == SensorKind::kStereo)
    write_stereo_calibration(calibration, stereo_calibration(params));
  else if (params.sensor != SensorKind::kLaser)
    write_depth_calibration(calibration, depth_calibration(params));
  // Whole or not at all: a folder that has one holds a recording.
  write_whole_file(timestamps, "name,utime,down_x,down_y,down_z\n");
  timestamps_.open(timestamps, std::ios::app);
}

std::string FrameFolder::path(const SimulatedFrame& frame, const std::string& ending) const {
  return folder_ + "/" + frame.scenario.name + ending;
}

void FrameFolder::write(const SimulatedFrame& frame) {
  PinholeCamera view = params_.camera;
  if (params_.sensor == SensorKind::kLaser) {
    view = {};
    write_pcd(path(frame, ".pcd"), frame.laser);
  } else if (params_.sensor == SensorKind::kStereo) {
    write_image(path(frame, "_left.jpg"), frame.left);
    write_image(path(frame, "_right.jpg"), frame.right);
    if (!params_.blind) write_image(path(frame, "_depth.png"), millimetres(frame.true_depth_m));
  } else {
    write_image(path(frame, "_color.jpg"), frame.left);
    write_image(path(frame, "_depth.png"), millimetres(frame.sensed_depth_m));
    if (!params_.blind) write_image(path(frame, "_true.png"), millimetres(frame.true_depth_m));
  }
  if (!params_.blind) {
    write_image(path(frame, "_mask.png"), frame.mask);
    write_image(path(frame, "_labels.png"), frame.labels);
  }
  write_whole_file(path(frame, "_gt.json"),
                   truth_json(frame.scenario, view, frame.pixels).dump(1) + "\n");
  const Eigen::Vector3d& down = frame.told_down;
  char line[160];
  std::snprintf(line, sizeof(line), "%s,%lld,%.5f,%.5f,%.5f\n", frame.scenario.name.c_str(),
                static_cast<long long>(frame.scenario.utime), down.x(), down.y(), down.z());
  timestamps_ << line << std::flush;
  if (!timestamps_)
    throw std::runtime_error(folder_ + "/timestamps.csv: cannot be written (" +
                             std::strerror(errno) + ")");
}

}  // namespace limbcast::simulate
