#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/camera/calibration.hpp"
#include "common/config/options.hpp"
#include "common/sources/open_source.hpp"
#include "modules/calibrate/views.hpp"

namespace limbcast::calibrate {

/// Throws std::runtime_error where a signal to end came: nobody wants the result any more.
void check_not_told_to_end();

/// Option of the right camera, where it has one of its own.
inline constexpr const char* kSecondKey = "source-right";

/// Declares --source and what belongs to it.
void declare_source(config::Section& section, SourceOptions& options);

/// What is read: logs, videos and cameras, or a folder's pictures. Its calibration is not among
/// them, since it may be completed in its place.
std::vector<std::string> pictures_read(const SourceOptions& source);

/// Do the pairs come one after another (video, camera, log) or as separate shots (folder)?
bool in_sequence(const std::string& source);

/// Calls `take` with each frame of a folder, a video or cameras, until the source ends or `take`
/// returns false; what is wrong with a camera is told in the log. Throws as visit_pairs.
void visit_source(const SourceOptions& options, const PairFormat& format,
                  const std::function<bool(const FramePair&)>& take);

/// How many pairs a folder holds. Throws InputError where it is none of pairs.
std::size_t count_pairs(const std::string& folder);

/// Calls `take` with each pair of a folder (NAME_left, NAME_right), an LCM log, a video or cameras,
/// until the source ends or `take` returns false. Throws InputError where the source cannot be
/// used, std::runtime_error where the program is told to end.
void visit_pairs(const SourceOptions& options, const std::function<bool(const GreyPair&)>& take);

/// Throws InputError where an image has another size than the calibration is for.
void check_sizes(const GreyPair& pair, const StereoCalibration& calibration);

/// The calibration of `path`; without a path the one that an LCM log carries. Throws InputError
/// where there is none.
StereoCalibration find_calibration(const std::string& path, const std::string& source);

}  // namespace limbcast::calibrate
