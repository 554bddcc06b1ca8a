#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "common/camera/calibration_reader.hpp"
#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

/// Calibration files as OpenCV and ROS write them, for tests that change an entry.
namespace limbcast::test {

using Entries = std::map<std::string, std::string>;

inline std::string matrix(int rows, int cols, const std::string& data) {
  return "!!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(cols) + "\n   dt: d\n   data: [ " + data + " ]";
}

inline Entries opencv_entries() {
  return {{"image_width", "640"},
          {"image_height", "480"},
          {"K1", matrix(3, 3, "500., 0., 320., 0., 501., 240., 0., 0., 1.")},
          {"D1", matrix(1, 5, "-0.3, 0.1, 0.001, -0.002, 0.05")},
          {"K2", matrix(3, 3, "510., 0., 321., 0., 511., 241., 0., 0., 1.")},
          {"D2", matrix(1, 5, "0., 0., 0., 0., 0.")},
          {"R", matrix(3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.")},
          {"T", matrix(3, 1, "-0.12, 0.001, -0.002")}};
}

inline std::string yaml(const Entries& entries, const std::string& header = "%YAML:1.0\n---\n") {
  std::string text = header;
  for (const auto& [key, value] : entries) text.append(key).append(": ").append(value).append("\n");
  return text;
}

/// 164 degrees across the image.
inline Entries fisheye_entries() {
  Entries entries = opencv_entries();
  entries["distortion_model"] = "equidistant";
  entries["K1"] = entries["K2"] = matrix(3, 3, "224., 0., 320., 0., 224., 240., 0., 0., 1.");
  entries["D1"] = entries["D2"] = matrix(1, 4, "-0.01, 0.03, -0.02, 0.004");
  return entries;
}

inline std::string ros_matrix(int rows, int cols, const std::string& data) {
  return "\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(cols) + "\n  data: [" +
         data + "]";
}

inline Entries ros_entries(const std::string& tx) {
  return {{"image_width", "640"},
          {"image_height", "480"},
          {"camera_name", "stereo/left"},
          {"camera_matrix", ros_matrix(3, 3, "430.0, 0, 310.5, 0, 431.0, 239.5, 0, 0, 1")},
          {"distortion_model", "plumb_bob"},
          {"distortion_coefficients", ros_matrix(1, 5, "-0.36, 0.16, 0.0001, -0.0002, 0")},
          {"rectification_matrix", ros_matrix(3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1")},
          {"projection_matrix",
           ros_matrix(3, 4, "400, 0, 315, " + tx + ", 0, 400, 240, 0, 0, 0, 1, 0")}};
}

/// The reader on a file that the test writes.
class StereoCalibrationFile : public ::testing::Test {
 protected:
  std::string error_with(const std::string& key, const std::string& value) {
    Entries entries = opencv_entries();
    entries[key] = value;
    return error_of_file(yaml(entries));
  }
  std::string error_of_file(const std::string& text) {
    const std::string path = folder_.write("stereo.yml", text);
    return error_of<InputError>([&] { read_stereo_calibration(path); });
  }
  TemporaryFolder folder_;
};

}  // namespace limbcast::test
