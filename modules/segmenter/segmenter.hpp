#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/head_classifier.hpp"
#include "modules/segmenter/lattice.hpp"
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
  std::vector<HeadCandidate> find_seeds(const Cloud& cloud, const Lattice& lattice) const;
  /// Both add segments to `result`, those of people first, and return the segment of each of the
  /// cloud's points.
  std::vector<std::int16_t> grow_refined(const Cloud& cloud, const Lattice& lattice, int step,
                                         const std::vector<HeadCandidate>& seeds,
                                         Segments& result) const;
  std::vector<std::int16_t> grow_as_paper(const Cloud& cloud, const Lattice& lattice,
                                          const std::vector<HeadCandidate>& seeds,
                                          Segments& result) const;
  void cut_out(const Cloud& cloud, const Lattice& lattice, const std::vector<std::int16_t>& labels,
               Segments& result) const;

  Params params_;
  SkinColor skin_;
  HeadClassifier classifier_;
};

/// What the heads of an organised cloud are searched in: every `step`-th of its pixels.
Lattice make_lattice(const Cloud& cloud, const LevelFrame& frame, int& step);

/// The same for one cloud; a Segmenter that is kept saves building its tables (10 ms).
Segments segment(const Cloud& cloud, const Params& params = {});

}  // namespace limbcast::segmenter
