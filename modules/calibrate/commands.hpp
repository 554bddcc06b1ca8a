#pragma once

namespace limbcast::calibrate {

// Each reads its options, does one thing and prints what it found. They return whether that is
// good; an exception is what run_program makes of it.

/// Calibrates a pair from pictures of a board.
bool run_stereo(int argc, const char* const* argv);

}  // namespace limbcast::calibrate
