#pragma once

#include <string>

#include "common/sources/source_process.hpp"

namespace limbcast {

/// Whether the source is a log made by lcm-logger (or by a camera process with --log), or a file
/// that is named like one, of which lcm_io::LogReader says what is wrong.
bool is_lcm_log(const std::string& source);
/// Whether there are messages of LCM in it, whatever its name.
bool begins_as_lcm_log(const std::string& source);

/// What of a log belongs to a camera; all else in it stays where it is.
struct PlaybackChannels {
  std::string frames;
  std::string calibration;  ///< empty: the sensor has none of its own
  std::string truth;
};

/// Sends a camera's messages of a log again: frames at the rate that the options say, calibration
/// and truth with them, with their times unless these change (restamp, loop) and numbered anew.
/// Calibrations are repeated as a camera does, for a log may hold one alone. Message: the type of
/// the frames. Throws InputError where the log holds no such frame.
template <class Message>
void play_log(const std::string& module_name, const SourceProcessOptions& options,
              const config::CommonOptions& common, const PlaybackChannels& channels);

}  // namespace limbcast
