#pragma once

#include <cstdint>
#include <vector>

#include "common/cloud/cloud.hpp"
#include "common/cloud/segment.hpp"
#include "modules/segmenter/bodies/split_bodies.hpp"
#include "modules/segmenter/classifiers/body_classifier.hpp"
#include "modules/segmenter/classifiers/head_classifier.hpp"
#include "modules/segmenter/classifiers/surface_classifier.hpp"
#include "modules/segmenter/faces_and_joints/depth_picture.hpp"
#include "modules/segmenter/faces_and_joints/depth_pose.hpp"
#include "modules/segmenter/faces_and_joints/face_finder.hpp"
#include "modules/segmenter/overlooked/image_opinion.hpp"
#include "modules/segmenter/params.hpp"
#include "modules/segmenter/scene/scene.hpp"
#include "modules/segmenter/seeds/skin_color.hpp"

namespace limbcast::segmenter {

/// One for each segment.
using DepthPictures = std::vector<std::optional<DepthPicture>>;

/// Finds the people in a cloud (paper, section III-B). Keeps nothing from one cloud to the next.
class Segmenter {
 public:
  explicit Segmenter(const Params& params = {});

  /// One segment for each seed that was looked at: first the people, then the rejected, without
  /// points and with the filter that ended them. Arms taken for people are among the first, and
  /// rejected. `pictures`, where it is wanted, gets what the network of depths was shown of each;
  /// nothing of rejected ones.
  Segments segment(const Cloud& cloud, DepthPictures* pictures = nullptr) const;

  /// Cuts out the people whose heads' centres are told (sensor frame): one valid segment for each
  /// head that the cloud shows, grown as `growing = refined` does. Finds and rejects nobody.
  Segments cut_out_people(const Cloud& cloud, const std::vector<Eigen::Vector3f>& heads_m) const;

 private:
  std::vector<HeadCandidate> find_seeds(const Scene& scene) const;
  /// Both add segments to `result`, those of people first, and return the segment of each of the
  /// cloud's points.
  std::vector<std::int16_t> grow_refined(const Scene& scene, std::vector<HeadCandidate> seeds,
                                         Segments& result) const;
  std::vector<std::int16_t> grow_as_paper(const Scene& scene,
                                          const std::vector<HeadCandidate>& seeds,
                                          Segments& result) const;
  /// Refused heads, alone and on somebody's body, whose own bodies the network of depths takes for
  /// people.
  std::vector<HeadCandidate> find_overlooked_people(const Scene& scene,
                                                    const FoundPeople& people) const;
  /// The head of each of the cloud's points as all of them grow together, whether or not they are
  /// heads, and what is no part of a body is cut off. Points of the lattice that `taken` labels are
  /// left out.
  std::vector<std::int16_t> grow_from(const Scene& scene, std::vector<HeadCandidate> heads,
                                      const std::vector<std::int16_t>* taken = nullptr) const;
  /// Joins segments that are arms of somebody else's to theirs, as the image shows them.
  void join_arms(const Scene& scene, std::vector<std::int16_t>& labels, Segments& result) const;
  /// What the networks see of each person and its face in the colour image.
  void see_people(const Scene& scene, const std::vector<std::int16_t>& labels,
                  Segments& result) const;
  /// Of each segment what the network of depths is shown; nothing of rejected ones.
  DepthPictures draw_people(const Scene& scene, const std::vector<std::int16_t>& labels,
                            const std::vector<Segment>& segments) const;
  /// What the network of depths sees of each person.
  PosesInDepths see_depths(const DepthPictures& pictures) const;
  /// Whether the network of depths may put right where people's heads are.
  enum class Heads { kFound, kTold };
  /// The same and what it was shown, of people whose bodies it has put right where it may
  /// (split_bodies.hpp).
  PosesInDepths put_bodies_right(const Scene& scene, Heads heads, std::vector<std::int16_t>& labels,
                                 DepthPictures& pictures, Segments& result) const;
  /// Returns what the network of depths was shown.
  DepthPictures fill_segments(const Scene& scene, std::vector<std::int16_t> labels, Heads heads,
                              Segments& result) const;
  /// The points of the cloud that carry `label`, and the range image around them.
  void fill_segment(const Scene& scene, const std::vector<std::int16_t>& labels, std::int16_t label,
                    Segment& segment) const;

  Params params_;
  SkinColor skin_;
  HeadClassifier classifier_;
  BodyClassifier bodies_;
  FaceFinder faces_;
  ImageOpinion image_;
  DepthPose depth_pose_;
  SurfaceClassifier surfaces_;
};

/// The same for one cloud; a Segmenter that is kept saves building its tables (10 ms).
Segments segment(const Cloud& cloud, const Params& params = {});

}  // namespace limbcast::segmenter
