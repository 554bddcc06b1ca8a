#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/cloud/segment.hpp"
#include "modules/segmenter/faces_and_joints/pose_network.hpp"
#include "modules/segmenter/overlooked/hidden_heads.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/people_search.hpp"
#include "modules/segmenter/scene/scene.hpp"

namespace limbcast::segmenter {

/// What the networks of poses see in a scene's colour image: whether there is somebody where the
/// depths leave it open, and the joints of those who were found. Several threads may use one
/// object.
class ImageOpinion {
 public:
  explicit ImageOpinion(const Params& params);

  /// Log odds of a head, by the depths around it and by what the colour image shows beneath it.
  /// Empty without an image.
  HeadOpinion head_opinion(const Scene& scene) const;
  /// What the colour image shows where a surface may be a body's whom none of `people` is; it looks
  /// at `people` as they are when it is asked. Empty without an image.
  BodyOpinion body_opinion(const Scene& scene, const FoundPeople& people) const;
  /// What the networks see of a person in the colour image; nothing without one.
  std::vector<ImagePose> see(const Scene& scene, const LabelledPerson& person) const;

 private:
  std::optional<float> head_odds(const Scene& scene, const HeadCandidate& head) const;
  /// The body beneath a head that is guessed. `labels`: whose each of the cloud's points is.
  std::optional<SeenBody> see_body(const Scene& scene, const std::vector<std::int16_t>& labels,
                                   const HeadCandidate& head) const;

  Params params_;
  PoseNetwork network_, second_network_;
};

}  // namespace limbcast::segmenter
