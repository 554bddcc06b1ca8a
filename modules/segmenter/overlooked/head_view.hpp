#pragma once

#include <array>
#include <vector>

#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// What a camera does not see: beyond the first and the last measured point of each row, since a
/// stereo camera measures nothing at the edge that only one of its images shows, and behind people.
/// Keeps references.
class HeadView {
 public:
  HeadView(const Lattice& lattice, const FoundPeople& found, const HiddenHeadParams& params);

  /// Whether a head about a place (level frame) is out of sight.
  bool hides_head(const Eigen::Vector3f& center_m) const;

 private:
  void find_principal_point();
  bool out_of_sight(const Eigen::Vector3f& sensor_m) const;
  bool is_a_persons(std::size_t i) const;

  const Lattice& lattice_;
  const FoundPeople& found_;
  const HiddenHeadParams& params_;
  std::vector<std::array<int, 2>> seen_;  ///< first and last measured column of each row
  Eigen::Vector2f principal_px_ = Eigen::Vector2f::Zero();
};

}  // namespace limbcast::segmenter
