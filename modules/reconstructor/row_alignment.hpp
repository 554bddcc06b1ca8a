#pragma once

#include <optional>

#include "common/camera/pinhole_camera.hpp"
#include "modules/reconstructor/corner_tracks.hpp"

namespace limbcast::reconstructor {

/// How a camera stands against where its calibration has it: a mount that bends turns it, in a lens
/// that moves the image is shifted. find_right_turn tells of one of nod and shift. A turn about the
/// upright axis is not asked for: it moves hardly a row, but all disparities.
struct CameraTurn {
  double nod_rad = 0.0;   ///< about x: its image moves down, more so above and below the middle
  double roll_rad = 0.0;  ///< about z: its image turns clockwise
  double shift_px = 0.0;  ///< of the lens: its image moves down
};

struct RowAlignmentParams {
  /// Corners are looked for in images of about this width [px], then tracked once more in the
  /// pair's own; tracking them back as well tells the turn no better.
  int search_width_px = 320;
  CornerParams corners = {200, 0.02, 6.0, 15, 4, std::nullopt, 12.0};
  /// The last tracking moves a corner that was found at this scale by a pixel or so.
  double max_move_px = 1.5;
  /// Fewer corners say nothing, nor do such as do not agree [px of the search, robust standard
  /// deviation]: pairs of stereo_dev have 0.14 at most, of 900 simulated ones four from 0.2 on,
  /// which were told to be off by 0.2 to 0.5 px and are not.
  int min_corners = 40;
  double max_sigma_px = 0.15;
  /// Rows that differ by less are left alone [px, root mean square over the image]: half a pixel
  /// takes 13 of 94 right arms, and pairs of stereo_dev whose rows match tell 0.1 at most
  /// (tests/accuracy/README.md).
  double min_shift_px = 0.15;
};

/// How the right camera of a rectified, 8-bit grey pair is turned, as the rows of its corners tell;
/// nothing where there are too few or they do not agree. `camera` is both images'.
std::optional<CameraTurn> find_right_turn(const RectifiedPair& pair, const PinholeCamera& camera,
                                          const RowAlignmentParams& params = {});

/// By how much a turn moves rows [px, root mean square over the image].
double row_shift_px(const CameraTurn& turn, const PinholeCamera& camera);

/// A rectified pair, grey or BGR, with the right image in grey; where their rows do not match it is
/// turned to where they do.
RectifiedPair with_rows_aligned(const RectifiedPair& pair, const PinholeCamera& camera,
                                const RowAlignmentParams& params = {});

}  // namespace limbcast::reconstructor
