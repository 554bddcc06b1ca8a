#pragma once

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/skin_color.hpp"

namespace limbcast::segmenter {

/// Finds the people in a cloud (paper, section III-B). Keeps nothing from one cloud to the next.
class Segmenter {
 public:
  explicit Segmenter(const Params& params = {});

  /// One segment for each seed that was looked at: first the people, then the rejected, without
  /// points and with the filter that ended them.
  Segments segment(const Cloud& cloud) const;

 private:
  Params params_;
  SkinColor skin_;
};

/// The same for one cloud; a Segmenter that is kept saves building its tables (10 ms).
Segments segment(const Cloud& cloud, const Params& params = {});

}  // namespace limbcast::segmenter
