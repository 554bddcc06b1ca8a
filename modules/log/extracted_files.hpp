#pragma once

#include <limbcast/image_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/human_model/body_pose.hpp"

namespace limbcast::logs {

// Writers of the files that the sources read; each throws std::runtime_error naming the file where
// it cannot be written.

/// The picture's own bytes where it is a JPEG or PNG, else as PNG. `path` without ending.
void write_picture(const std::string& path, const image_t& image);
/// Binary PCD of the points that are there, with rgb, intensity and ring where the cloud has them.
void write_cloud(const std::string& path, const Cloud& cloud);
/// NAME_gt.json as read_ground_truth reads it.
void write_truth(const std::string& path, const BodyPoses& truth);
/// timestamps.csv, in the order of `stamps`.
void write_timestamps(const std::string& path, const std::vector<Stamp>& stamps);

/// Name of a frame: its utime, with zeros so that names sort by time.
std::string frame_name(const Stamp& stamp);

}  // namespace limbcast::logs
