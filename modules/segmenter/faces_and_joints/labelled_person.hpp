#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace limbcast::segmenter {

/// A person of a cloud that was segmented.
struct LabelledPerson {
  const std::vector<std::int16_t>& labels;  ///< whose each of the cloud's points is
  std::int16_t label;                       ///< this person's
  Eigen::Vector3f head_m;                   ///< centre of the head, in the cloud's frame
};

}  // namespace limbcast::segmenter
