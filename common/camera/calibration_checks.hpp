#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "common/camera/calibration.hpp"
#include "common/camera/yaml_reader.hpp"

/// What a calibration must fulfil before anything is measured with it. Each check throws InputError
/// with file, key, what was found and what to do.
namespace limbcast {

/// A number as a message shows it.
std::string text_of(double value);

/// The camera of `K`, the matrix under `key`, for an image of this size [px].
PinholeCamera checked_pinhole(const YamlReader& yaml, const std::string& key, int width, int height,
                              const Eigen::Matrix3d& K);
/// What is wrong with a lens whose image does not grow with the angle to its axis as far as the
/// image reaches, and what to do.
struct DistortionFault {
  std::string found, remedy;
};
std::optional<DistortionFault> distortion_fault(const LensCalibration& lens);
/// There is none.
void check_distortion(const YamlReader& yaml, const std::string& key, const LensCalibration& lens);
/// `T`, the right camera's offset [m], puts it to the right of the left one.
void check_baseline(const YamlReader& yaml, const std::string& key, const Eigen::Vector3d& T);
/// `T`, one camera's offset from another of the same device [m], is no longer than such devices.
void check_near(const YamlReader& yaml, const std::string& key, const Eigen::Vector3d& T);
/// The cameras of a pair have like lenses and look the same way. The keys are those of the right
/// camera's matrix and turn.
void check_alike(const YamlReader& yaml, const std::string& matrix_key,
                 const std::string& rotation_key, const StereoCalibration& calibration);
/// `P`, a rectified camera, is one for the images of `camera`.
void check_rectified(const YamlReader& yaml, const std::string& key,
                     const Eigen::Matrix<double, 3, 4>& P, const PinholeCamera& camera);
/// The rectified cameras of a pair share their focal length and rows. The key is the right one's.
void check_rows_match(const YamlReader& yaml, const std::string& key,
                      const Rectification& rectification);
/// `T` and the rectified cameras tell the same baseline.
void check_same_baseline(const YamlReader& yaml, const Eigen::Vector3d& T,
                         const Eigen::Matrix<double, 3, 4>& P2);

}  // namespace limbcast
