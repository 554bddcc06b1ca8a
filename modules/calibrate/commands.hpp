#pragma once

namespace limbcast::calibrate {

// Each reads its options, does one thing and prints what it found. They return whether that is
// good; an exception is what run_program makes of it.

/// Calibrates a pair from pictures of a board.
bool run_stereo(int argc, const char* const* argv);
/// Draws a board to print.
bool run_board(int argc, const char* const* argv);
/// Measures how well a calibration fits a recording.
bool run_check(int argc, const char* const* argv);
/// Adds gravity and the camera's height to a calibration.
bool run_mounting(int argc, const char* const* argv);

}  // namespace limbcast::calibrate
