#pragma once

#include <string>
#include <vector>

#include "modules/simulate/postures.hpp"

namespace limbcast::simulate {

enum class MotionKind {
  kAny,          ///< one of those below, drawn
  kWalkPoint,    ///< walks for 3 s, stops and points
  kWave,         ///< raises an arm and waves
  kPointAround,  ///< points at one thing after the other with the same arm
  kSitDown,      ///< stands, sits down, stays
};

/// What somebody does in the course of time; drawn once, then a function of time alone.
class Motion {
 public:
  /// `place`: where the body stands; a walker stops there.
  Motion(MotionKind kind, const BodyShape& body, const Place& place, const PointingParams& pointing,
         Rng rng);

  MotionKind kind() const { return kind_; }
  const BodyShape& body() const { return body_; }
  Posture posture(double seconds) const;
  Place place(double seconds) const;

 private:
  double walked_m(double seconds) const;

  MotionKind kind_;
  BodyShape body_;
  Place place_;
  std::vector<Posture> stations_;  ///< postures that are held, in turn
  int waving_side_ = 0;
};

/// The posture `share` of the way from one to the other; what cannot be mixed changes at the end.
Posture between(const Posture& from, const Posture& to, double share);

}  // namespace limbcast::simulate
