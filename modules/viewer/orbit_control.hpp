#pragma once

#include "modules/viewer/viewpoint.hpp"

namespace limbcast::viewer {

/// What a user can ask for to see the people from elsewhere.
enum class Look { kLeft, kRight, kUp, kDown, kNearer, kFarther, kAsAtStart };

/// From where the user looks. Knows no window.
class OrbitControl {
 public:
  explicit OrbitControl(const Orbit& start) : start_(start), orbit_(start) {}

  void apply(Look look);
  /// The mouse was dragged by a share of the window's size (right and down positive): what is near
  /// goes with it.
  void drag(float width_share, float height_share);
  /// The wheel was turned by so many notches; away from the user is nearer to the people.
  void turn_wheel(float notches);

  const Orbit& orbit() const { return orbit_; }

 private:
  void turn(float right_deg, float up_deg);
  void approach(float steps);

  Orbit start_, orbit_;
};

}  // namespace limbcast::viewer
