#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/growing/filters.hpp"

namespace limbcast::segmenter {

/// Rejects a segment that is a part of another one's person, who gets its points among `labels`.
inline void give_to_same_person(std::size_t part, std::size_t person,
                                std::vector<Segment>& segments, std::vector<std::int16_t>& labels) {
  std::replace(labels.begin(), labels.end(), static_cast<std::int16_t>(part),
               static_cast<std::int16_t>(person));
  segments[part].rejected_by = SegmentFilter::kSamePerson;
  segments[part].filter_figure = 1.0F;
  segments[part].filter_limit = kSamePersonShare;
}

}  // namespace limbcast::segmenter
