#pragma once

#include <string>

#include "common/human_model/body_pose.hpp"

namespace limbcast {

/// Reads the truth of one frame, NAME_gt.json (format: README of the modules that read recordings).
///
/// How truth is written as BodyPoses (and so in GROUND_TRUTH messages):
/// - `stamp.utime` is the file's; `stamp.gravity` has its down and camera_height, source
/// kRecording, where it
///   tells them, else kLevel.
/// - `persons` in the file's order; `id` the file's where that is a number, else the place, from 1;
///   `confidence` 1.
/// - A joint is `valid` where its position is known, seen or not; its `confidence` is 1 where it is
/// visible (in
///   the image, nothing in front) and 0 where it is hidden.
/// - `pointing` has one entry where the file says that this person points, else none. Its
/// `confidence` is 1
///   where the arm is visible and the label can be trusted, and 0 where the arm is hidden or the
///   label says depth_consistent: false (count only those of 1 in pointing figures). In the latter
///   case `direction` is direction_straight_arm where the file has it. `forearm` and `head_hand`
///   are zero where they are not told.
/// - What truth does not know keeps its default: lengths, angles, errors, typical pose.
///
/// Throws InputError: file, person, key, what was found.
BodyPoses read_ground_truth(const std::string& path);

/// The same as the truth of the frame that has this stamp: it gets the frame's time and sensor, and
/// the truth's own gravity, which is exact, where it tells one.
BodyPoses read_truth_of(const Stamp& frame, const std::string& path);

}  // namespace limbcast
