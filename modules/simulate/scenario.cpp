#include "modules/simulate/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/units.hpp"
#include "modules/simulate/body_surface.hpp"

namespace limbcast::simulate {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kEnd_s = 1e3;  // every motion has come to its end

const char* name_of(SetKind set) {
  switch (set) {
    case SetKind::kPointing:
      return "pointing";
    case SetKind::kGeneral:
      return "general";
    case SetKind::kMulti:
      return "multi";
    case SetKind::kNoHuman:
      return "nohuman";
    case SetKind::kSequence:
      return "sequence";
  }
  return "";
}

struct View {
  double height_m, pitch_down_rad, roll_rad;
  /// World: x left, y up, z forward; sensor: x right, y down, z forward.
  Isometry3d sensor_from_world() const {
    Isometry3d level = Isometry3d::Identity();
    level.linear() = Vector3d(-1, -1, 1).asDiagonal();
    Isometry3d result = Isometry3d::Identity();
    result.linear() = (Eigen::AngleAxisd(roll_rad, Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(pitch_down_rad, Vector3d::UnitX()))
                          .toRotationMatrix();
    return result * level * Eigen::Translation3d(0, -height_m, 0);
  }
};

View draw_view(Rng& rng, const ScenarioParams& params) {
  return {rng.uniform(params.min_camera_height_m, params.max_camera_height_m),
          radians(rng.normal(params.pitch_down_deg, params.pitch_sigma_deg)),
          radians(rng.normal(0.0, params.roll_sigma_deg))};
}

int draw_count(Rng& rng, const ScenarioParams& params) {
  if (params.max_persons > 0)
    return params.min_persons + rng.pick(params.max_persons - params.min_persons + 1);
  if (params.set == SetKind::kNoHuman) return 0;
  return params.set == SetKind::kMulti ? 2 + rng.pick(4) : 1;
}

/// Most people face the camera; some stand in any direction.
double draw_yaw(Rng& rng) {
  return rng.chance(0.6) ? radians(rng.normal(0.0, 40.0)) : rng.uniform(-kPi<double>, kPi<double>);
}

bool in_view(const PinholeCamera& camera, const Isometry3d& sensor_from_world,
             const Vector3d& point, double margin_px) {
  const Vector3d p = sensor_from_world * point;
  if (p.z() < 0.3) return false;
  const Eigen::Vector2f pixel = camera.project(p.cast<float>());
  return pixel.x() > margin_px && pixel.x() < camera.width - margin_px && pixel.y() > margin_px &&
         pixel.y() < camera.height - margin_px;
}

/// How much of somebody is in the image.
enum class Framing { kWithHands, kWithHead, kHeadAbove };

Framing draw_framing(Rng& rng, const ScenarioParams& params) {
  if (params.head_above_share > 0.0 && rng.chance(params.head_above_share))
    return Framing::kHeadAbove;
  return rng.chance(params.cut_share) ? Framing::kWithHead : Framing::kWithHands;
}

bool is_framed(Framing framing, const Skeleton& world, const PinholeCamera& camera,
               const Isometry3d& sensor_from_world) {
  constexpr double kMargin_px = 4.0, kMarginAroundWhole_px = 12.0;
  const auto sees = [&](const Vector3d& point, double margin_px) {
    return in_view(camera, sensor_from_world, point, margin_px);
  };
  switch (framing) {
    case Framing::kWithHands:
      return sees(world[Joint::kHead], kMarginAroundWhole_px) &&
             sees(world.head_top, kMarginAroundWhole_px) && sees(world.fingertip[0], kMargin_px) &&
             sees(world.fingertip[1], kMargin_px);
    case Framing::kWithHead:
      return sees(world[Joint::kHead], kMargin_px);
    case Framing::kHeadAbove:
      return sees(world[Joint::kChest], kMargin_px) &&
             camera.project((sensor_from_world * world[Joint::kHead]).cast<float>()).y() < 0.0F;
  }
  return false;
}

/// A place in view where nobody stands yet; false where none was found.
bool find_place(Rng& rng, const ScenarioParams& params, const PinholeCamera& camera,
                const Isometry3d& sensor_from_world, const std::vector<Person>& others,
                Person& person) {
  const Framing framing = draw_framing(rng, params);
  for (int attempt = 0; attempt < 60; ++attempt) {
    person.place.z_m = rng.uniform(params.min_distance_m, params.max_distance_m);
    const double half_width = 0.5 * camera.width / camera.fx;
    person.place.x_m = rng.uniform(-1.0, 1.0) * half_width * person.place.z_m;
    const double apart = 0.30 * person.body.stature_m;  // shoulder to shoulder: some touch
    const bool free = std::none_of(others.begin(), others.end(), [&](const Person& other) {
      return std::hypot(other.place.x_m - person.place.x_m, other.place.z_m - person.place.z_m) <
             apart;
    });
    if (!free) continue;
    const Skeleton world = make_skeleton(person.body, person.posture, person.place);
    if (!is_framed(framing, world, camera, sensor_from_world)) continue;
    person.skeleton = world;
    return true;
  }
  return false;
}

std::vector<Person> draw_people(Rng& rng, const ScenarioParams& params, const PinholeCamera& camera,
                                const Isometry3d& sensor_from_world) {
  std::vector<Person> persons;
  const int count = draw_count(rng, params);
  for (int i = 0; i < count; ++i) {
    Rng own = rng.derive(static_cast<std::uint64_t>(i));
    for (int attempt = 0; attempt < 6; ++attempt) {
      Person person;
      person.body = draw_body(own, params.body);
      const bool points =
          params.set == SetKind::kPointing || (params.set == SetKind::kMulti && own.chance(0.35));
      person.posture = points                   ? draw_pointing(own, person.body, params.pointing)
                       : params.posture.empty() ? draw_natural(own, person.body)
                                                : draw_posture(own, person.body, params.posture);
      person.place.yaw_rad = draw_yaw(own);
      if (!find_place(own, params, camera, sensor_from_world, persons, person)) continue;
      persons.push_back(person);
      break;
    }
  }
  return persons;
}

/// People who move, apart from one another; in furnishing they are where they end.
std::vector<Motion> draw_motions(const Rng& base, const ScenarioParams& params) {
  std::vector<Motion> motions;
  const int count = std::max(1, params.max_persons);
  for (int i = 0; i < count; ++i) {
    Rng rng = base.derive(static_cast<std::uint64_t>(i));
    const BodyShape body = draw_body(rng, params.body);
    const double yaw = radians(rng.uniform(-60, 60));
    // A walker comes from about 2 m farther away.
    const double z = rng.uniform(0.42, 0.7) * params.max_distance_m;
    const double x = (i - 0.5 * (count - 1)) * 0.9 + rng.normal(0.0, 0.1);
    motions.emplace_back(params.motion, body, Place{x, z, yaw}, params.pointing, rng.derive(1));
  }
  return motions;
}

std::vector<Person> people_at(const std::vector<Motion>& motions, double seconds) {
  std::vector<Person> persons;
  for (const Motion& motion : motions) {
    Person person;
    person.body = motion.body();
    person.posture = motion.posture(seconds);
    person.place = motion.place(seconds);
    person.skeleton = make_skeleton(person.body, person.posture, person.place);
    persons.push_back(person);
  }
  return persons;
}

void furnish(SceneBuilder& scene, Rng& rng, const ScenarioParams& params,
             const std::vector<Person>& persons, std::vector<Circle> keep_free) {
  keep_free.push_back({0.0, 0.0, 1.2});
  for (const Person& person : persons) {
    keep_free.push_back({person.place.x_m, person.place.z_m, person.posture.seated ? 0.9 : 0.6});
    // Nothing stands at random before a person: occluders are drawn on purpose.
    keep_free.push_back({0.7 * person.place.x_m, 0.7 * person.place.z_m, 0.5});
  }
  const bool empty = params.set == SetKind::kNoHuman;
  if (rng.derive(1).chance(params.street_share)) {
    scene.street(keep_free);
  } else {
    scene.room(keep_free);
    scene.furniture(2 + rng.pick(6), keep_free);
  }
  scene.lookalikes(empty ? 2 + rng.pick(5) : rng.pick(3) / 2, keep_free);
  for (const Person& person : persons) {
    if (person.posture.seated) scene.seat(person.body, person.skeleton);
    if (person.posture.name == "carry") scene.carried(person.skeleton);
    if (person.posture.held) scene.held(*person.posture.held, person.skeleton);
  }
  if (!persons.empty() && params.set != SetKind::kSequence && rng.chance(params.occluder_share)) {
    scene.occluder(persons[rng.pick(static_cast<int>(persons.size()))].place);
  }
}

}  // namespace

Scenario draw_scenario(const ScenarioParams& params, const PinholeCamera& camera,
                       std::uint64_t seed, int index) {
  const bool moving = params.set == SetKind::kSequence;
  const Rng base = Rng(seed).derive(static_cast<std::uint64_t>(params.set) + 1);
  Rng rng = moving ? base : base.derive(static_cast<std::uint64_t>(index));
  const View view = draw_view(rng, params);
  const Isometry3d sensor_from_world = view.sensor_from_world();

  Scenario scenario;
  char name[64];
  std::snprintf(name, sizeof(name), "%s_%04d", name_of(params.set), index);
  scenario.name = name;
  const double seconds = index / params.frame_rate_hz;
  // A day of its own for each seed, so that frames of different sets never share a time.
  scenario.utime = 1'780'000'000'000'000 +
                   static_cast<std::int64_t>(seed % 10000) * 86'400'000'000 +
                   std::llround(seconds * 1e6);
  std::vector<Person> furnished_for;
  std::vector<Circle> paths;
  if (moving) {
    const std::vector<Motion> motions = draw_motions(rng.derive(7), params);
    scenario.persons = people_at(motions, seconds);
    furnished_for = people_at(motions, kEnd_s);
    for (const Motion& motion : motions) {
      for (const double moment : {0.0, 0.8, 1.6, 2.4}) {
        paths.push_back({motion.place(moment).x_m, motion.place(moment).z_m, 0.6});
      }
    }
  } else {
    scenario.persons = draw_people(rng, params, camera, sensor_from_world);
    furnished_for = scenario.persons;
  }

  SceneBuilder scene(rng.derive(8));
  Rng furniture = rng.derive(9);
  furnish(scene, furniture, params, furnished_for, paths);
  scenario.world = std::move(scene.world());
  for (Solid& solid : scenario.world.solids) {
    solid.frame_from_solid = sensor_from_world.cast<float>() * solid.frame_from_solid;
  }
  for (Surface& surface : scenario.world.surfaces)
    surface = surface.transformed(sensor_from_world.cast<float>());
  int mask_index = 0;
  for (Person& person : scenario.persons) {
    person.skeleton = transformed(person.skeleton, sensor_from_world);
    person.surface = static_cast<int>(scenario.world.surfaces.size());
    scenario.world.surfaces.push_back(
        make_body_surface(person.body, person.posture, person.skeleton, ++mask_index));
  }
  scenario.down = sensor_from_world.linear() * Vector3d(0, -1, 0);
  scenario.sensor_height_m = view.height_m;
  scenario.pitch_down_deg = view.pitch_down_rad * 180.0 / kPi<double>;
  Rng sky = rng.derive(10);
  const double light_z = -0.6 + sky.normal(0.0, 0.5);
  const Vector3d light(sky.normal(0.0, 0.7), 1.0, light_z);
  scenario.light = (sensor_from_world.linear() * light.normalized()).cast<float>();
  return scenario;
}

}  // namespace limbcast::simulate
