#include "modules/segmenter/overlooked/overlooked_bodies.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "modules/segmenter/faces_and_joints/labelled_person.hpp"
#include "modules/segmenter/overlooked/head_view.hpp"
#include "modules/segmenter/overlooked/overlooked.hpp"

namespace limbcast::segmenter {
namespace {

/// The surfaces that the network is asked about, the likeliest first.
std::vector<HeadlessSurface> likeliest_bodies(const Scene& scene, const Surfaces& surfaces,
                                              const FoundPeople& people, const BodyJudges& judges) {
  const HiddenHeadParams& params = judges.params.overlooked_bodies;
  std::vector<HeadlessSurface> bodies;
  for (HeadlessSurface& body : find_body_parts(scene.lattice, surfaces, people, params)) {
    if (people.labels[body.points.front()] != kNobody) continue;
    // Trained on cameras' clouds; of others the largest come first.
    if (scene.cloud.organized())
      body.head.odds = judges.classifier.mean_odds(scene.lattice, body.points);
    if (body.head.odds >= params.min_part_odds) bodies.push_back(std::move(body));
  }
  std::stable_sort(
      bodies.begin(), bodies.end(),
      [](const HeadlessSurface& a, const HeadlessSurface& b) { return a.head.odds > b.head.odds; });
  bodies.resize(std::min(bodies.size(), static_cast<std::size_t>(params.max_asked)));
  return bodies;
}

/// Where the network sees the head of a person (level frame); nothing where it sees none. `body`'s
/// own head is a guess.
std::optional<Eigen::Vector3f> see_head(const Scene& scene, LabelledPerson body,
                                        const BodyJudges& judges) {
  const OverlookedParams& params = judges.params.overlooked;
  const auto see = [&](float min_odds) {
    return see_body(scene, body, judges.params.depth_pose.picture, judges.network, min_odds);
  };
  const auto first = see(params.min_person_odds - params.guess_costs_odds);
  if (!first) return std::nullopt;
  // Once more with the head where it was seen.
  body.head_m = first->places_m[index(Joint::kHead)];
  const auto pose = see(params.min_person_odds);
  if (!pose) return std::nullopt;
  return scene.lattice.frame.to_level(pose->places_m[index(Joint::kHead)]);
}

}  // namespace

OverlookedBodies find_overlooked_bodies(const Scene& scene, const Surfaces& surfaces,
                                        const FoundPeople& people, const BodyJudges& judges) {
  if (!judges.params.depth_pose.enabled) return {};
  std::vector<HeadlessSurface> bodies = likeliest_bodies(scene, surfaces, people, judges);
  if (bodies.empty()) return {};
  const auto label_of = [&](std::size_t k) {
    return static_cast<std::int16_t>(people.heads.size() + k);
  };
  std::vector<std::int16_t> labels = people.labels;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    for (const std::uint32_t i : bodies[k].points) labels[i] = label_of(k);
  }
  labels = labels_of_cloud(scene, labels, judges.params.joint);
  std::vector<std::optional<Eigen::Vector3f>> heads_m(bodies.size());
  tbb::parallel_for(std::size_t{0}, bodies.size(), [&](std::size_t k) {
    const Eigen::Vector3f guess_m = scene.lattice.frame.to_sensor(bodies[k].head.center_m);
    heads_m[k] = see_head(scene, {labels, label_of(k), guess_m}, judges);
  });
  const HeadView view(scene.lattice, people, judges.params.hidden_heads);
  OverlookedBodies seen;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!heads_m[k]) continue;
    if (auto head = head_near(scene.lattice, *heads_m[k])) {
      head->kind = SeedKind::kBody;
      head->odds = judges.params.overlooked.head_odds;
      head->told_by_body = true;
      seen.heads.push_back(*head);
    } else if (scene.cloud.organized() && view.hides_head(*heads_m[k])) {
      bodies[k].head.center_m = *heads_m[k];
      bodies[k].head.surface_m = head_surface(scene.lattice, *heads_m[k]);
      seen.headless.push_back(std::move(bodies[k]));
    }
  }
  return seen;
}

}  // namespace limbcast::segmenter
