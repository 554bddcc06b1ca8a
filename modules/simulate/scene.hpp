#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "modules/simulate/body.hpp"
#include "modules/simulate/raycast.hpp"
#include "modules/simulate/skeleton.hpp"

namespace limbcast::simulate {

/// A circle on the floor, seen from above [m].
struct Circle {
  double x_m = 0.0, z_m = 0.0, radius_m = 0.5;
};

/// Puts a scene together in the world's frame: x to the camera's left, y up, z away from the
/// camera, the ground at y = 0. Colours of wood, leather and walls are often near those of skin:
/// that is on purpose.
class SceneBuilder {
 public:
  explicit SceneBuilder(Rng rng) : rng_(rng) {}

  /// Floor and, mostly, walls and ceiling; else a yard with a house and trees far away. Mostly the
  /// walls keep away from the circles; some people lean against them.
  void room(const std::vector<Circle>& keep_free);
  /// In place of a room: trunks, poles with signs, bushes, bins, bicycles and cars on open ground,
  /// houses far away. Trunks and poles reach over what a scanner of few degrees sees; through the
  /// panes of most cars one sees seats and pillars.
  void street(const std::vector<Circle>& keep_free);
  /// `count` pieces of furniture that leave the circles free.
  void furniture(int count, const std::vector<Circle>& keep_free);
  /// Something between the camera and `place` that hides a part of what stands there.
  void occluder(const Place& place);
  /// The chair, stool or sofa on which this person sits.
  void seat(const BodyShape& body, const Skeleton& skeleton);
  /// The box or tray that both hands hold.
  void carried(const Skeleton& skeleton);
  /// The board or crate before somebody.
  void held(const HeldThing& thing, const Skeleton& skeleton);
  /// Things that look like heads, shoulders or arms: balls on pillars, coats on stands, figures of
  /// boxes.
  void lookalikes(int count, const std::vector<Circle>& keep_free);

  World& world() { return world_; }

 private:
  /// Puts parts of one thing where it stands: x along it, y up, z across.
  struct Placed {
    SceneBuilder& scene;
    Eigen::Vector3d at;
    double yaw_rad;
    Material material;

    Eigen::AngleAxisd turn() const { return {yaw_rad, Eigen::Vector3d::UnitY()}; }
    Eigen::Vector3d world(const Eigen::Vector3d& point) const { return at + turn() * point; }
    void box(const Eigen::Vector3d& center, const Eigen::Vector3d& size) const {
      scene.box(world(center), size, yaw_rad, material);
    }
    void bar(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double thick_m) const;
  };
  Placed placed(double x, double z, double yaw_rad);

  Solid& box(const Eigen::Vector3d& center, const Eigen::Vector3d& size, double yaw_rad,
             const Material& material);
  Solid& round(Solid::Kind kind, const Eigen::Vector3d& center, const Eigen::Vector3d& half,
               const Material& material);
  Material some_material();
  Material wood();
  Material even(Bgr color, float grain);
  /// A free place at `from_m` to `to_m`, in a view that widens by `slope` to each side.
  bool find_place(const std::vector<Circle>& keep_free, double radius_m, double& x_m, double& z_m,
                  double from_m = 1.6, double to_m = 6.5, double slope = 0.75);

  void table(double x, double z);
  void chair(double x, double z, double yaw_rad, double seat_height_m, double width_m);
  void sofa(double x, double z, double yaw_rad, double seat_height_m);
  void shelf(double x, double z);
  void plant(double x, double z);
  void lamp(double x, double z);
  void boxes(double x, double z);
  void ball_on_pillar(double x, double z);
  void coat_stand(double x, double z);
  void box_figure(double x, double z);
  void trunk(double x, double z);
  void pole(double x, double z);
  void foliage(const Eigen::Vector3d& center, double spread_m);
  void bush(double x, double z);
  /// A wheel or a sign, upright; `yaw_rad` turns it about the vertical.
  void disc(const Eigen::Vector3d& center, double radius_m, double half_width_m, double yaw_rad);
  void bin(double x, double z);
  void bicycle(double x, double z);
  void car(double x, double z);
  /// On a car of this length, height of the panes' lower edge, and width [m].
  void cabin(const Placed& car, const Eigen::Vector3d& size);

  Rng rng_;
  World world_;
};

}  // namespace limbcast::simulate
