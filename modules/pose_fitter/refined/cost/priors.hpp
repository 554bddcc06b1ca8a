#pragma once

#include "modules/pose_fitter/refined/body_state.hpp"
#include "modules/pose_fitter/refined/cost/cone_equations.hpp"
#include "modules/pose_fitter/refined/cost/normal_equations.hpp"

namespace limbcast::pose_fitter::refined {

/// The rows that what is known of bodies adds to the normal equations, each with its derivatives.
/// prior_terms.cpp says which of them hold for which parts.
class Priors {
 public:
  Priors(const BodyState& body, const Cones& cones, NormalEquations& equations)
      : body_(body), cones_(cones), equations_(equations), stature_(body.stature_m()) {}

  /// Point against reference in the body's frame.
  void offset(int point, int reference, const Vec3& mean, const Vec3& sigma);
  void bone(int from, int to, Real length, Real relative_sigma);
  /// Left and right bone are of one length.
  void symmetry(int from, int to);
  /// The hand prolongs the forearm.
  void hand(int side);
  /// A knee does not bend backwards.
  void knee(int side);
  /// An elbow stands outwards, below and behind the line shoulder-wrist, and does not fold up
  /// wholly.
  void elbow(int side);
  /// A shoulder does not let the upper arm far behind the trunk.
  void shoulder_limit(int side);
  /// A point of an arm stands outside head and trunk.
  void outside_trunk(int point);
  /// Two limb segments do not go through each other.
  void limbs_apart(int a0, int a1, int b0, int b1);
  /// Feet are not in the ground, most often on it.
  void ground(int side, const Vec3& up, Real floor_m);
  /// The trunk stands along gravity, less surely so to the front.
  void upright(const Vec3& up);
  void head(const Vec3& start, Real sigma_m);
  void log_girth();
  /// Most people are adults; a child is no impossible one.
  void log_stature(Real mean, Real sigma);

 private:
  void add_anchor(const Anchor& anchor, const Vec3& derivative);

  const BodyState& body_;
  const Cones& cones_;
  NormalEquations& equations_;
  Real stature_;
};

}  // namespace limbcast::pose_fitter::refined
