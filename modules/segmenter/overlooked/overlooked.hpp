#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "modules/segmenter/faces_and_joints/depth_pose.hpp"
#include "modules/segmenter/faces_and_joints/labelled_person.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/lattice.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// Candidates that were refused by the depths around them or by what grew, and may be heads all the
/// same, the likeliest first: apart from the people who were found, on surfaces that nobody has.
std::vector<HeadCandidate> find_overlooked(const Lattice& lattice, const FoundPeople& people,
                                           const OverlookedParams& params);

/// Candidates that were refused as parts of people who were found, and may be heads of others who
/// touch them.
std::vector<HeadCandidate> find_merged(const Lattice& lattice, const FoundPeople& people,
                                       const OverlookedParams& params);

/// What the network of depths must tell of the body under a head.
struct BodyLimits {
  float min_person_odds = 0.0F;  ///< log odds
  float max_head_error_m =
      std::numeric_limits<float>::infinity();  ///< from where it marks the head
};

/// Heads that it is asked about.
struct AskedHeads {
  std::vector<HeadCandidate> heads;
  const std::vector<std::int16_t>& labels;  ///< whose each of the cloud's points is
  std::int16_t first_label = 0;             ///< that of the first head; the others' follow
  BodyLimits limits;
  /// Other limits that suffice where the depths around a head nearly tell it.
  std::optional<BodyLimits> limits_of_likely = std::nullopt;
  /// Where the network sees the head elsewhere it is asked once more from there.
  bool heads_move = false;
};

/// Heads of those whose whole bodies it takes for people.
std::vector<HeadCandidate> heads_of_people(const Scene& scene, const AskedHeads& asked,
                                           const Params& params, const DepthPose& network);

/// What the network sees of a body, from its head on; nothing where the log odds of a person are
/// lower than that.
std::optional<PoseInDepths> see_body(const Scene& scene, const LabelledPerson& body,
                                     const DepthPictureParams& picture, const DepthPose& network,
                                     float min_person_odds);

}  // namespace limbcast::segmenter
