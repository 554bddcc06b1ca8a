#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/lattice.hpp"

namespace limbcast::segmenter {

/// A place on the surface where growing may start.
struct HeadCandidate {
  int u = 0, v = 0;           ///< lattice
  Eigen::Vector3f surface_m;  ///< point of the lattice there, level frame
  Eigen::Vector3f center_m;   ///< of the head behind it, level frame
  float score = 0.0F;         ///< template's, 0 to 2.48; of a part of skin its area [m^2]
  SeedKind kind = SeedKind::kHeadShape;
  float odds = 0.0F;  ///< log odds that this is a head, of the classifier
  /// `odds` come from the body beneath it, not from its shape.
  bool told_by_body = false;
  /// That body was told from those of the people beside it: nobody's hand or chest.
  bool stands_beside = false;
};

/// Heads by their shape: something as large as a head, nothing of its depth beside and over it,
/// shoulders under it. Best first. The template's sizes are those of an adult's head; a child's of
/// 5 years is 0.9 times as large.
std::vector<HeadCandidate> find_heads(const Lattice& lattice, const HeadShapeParams& params);

/// Where a point of the level frame lies from the head's centre, as the sensor sees the head: x
/// across to the right, y away from the sensor, z up.
Eigen::Vector3f from_head(const Lattice& lattice, const HeadCandidate& head,
                          const Eigen::Vector3f& level_m);

/// Centre of the head whose surface is seen at `surface_m` (both level frame), and back.
Eigen::Vector3f head_center(const Lattice& lattice, const Eigen::Vector3f& surface_m);
Eigen::Vector3f head_surface(const Lattice& lattice, const Eigen::Vector3f& center_m);

/// The head whose centre is told (level frame), at the point of the lattice nearest to it; nothing
/// where none lies near.
std::optional<HeadCandidate> head_near(const Lattice& lattice, const Eigen::Vector3f& center_m);

}  // namespace limbcast::segmenter
