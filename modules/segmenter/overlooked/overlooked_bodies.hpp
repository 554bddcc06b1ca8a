#pragma once

#include <vector>

#include "modules/segmenter/classifiers/surface_classifier.hpp"
#include "modules/segmenter/faces_and_joints/depth_pose.hpp"
#include "modules/segmenter/overlooked/hidden_heads.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "modules/segmenter/scene/surfaces.hpp"
#include "modules/segmenter/seeds/head_shape.hpp"

namespace limbcast::segmenter {

/// What tells bodies from things.
struct BodyJudges {
  const Params& params;
  const SurfaceClassifier& classifier;  ///< sorts the surfaces of cameras
  const DepthPose& network;             ///< tells of each
};

struct OverlookedBodies {
  std::vector<HeadCandidate> heads;       ///< in sight
  std::vector<HeadlessSurface> headless;  ///< of people whose heads are out of a camera's sight
};

/// Bodies that nobody has and that the network of depths takes for people. `surfaces`: those that
/// nobody has.
OverlookedBodies find_overlooked_bodies(const Scene& scene, const Surfaces& surfaces,
                                        const FoundPeople& people, const BodyJudges& judges);

}  // namespace limbcast::segmenter
