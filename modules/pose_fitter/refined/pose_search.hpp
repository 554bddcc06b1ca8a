#pragma once

#include <vector>

#include "modules/pose_fitter/refined/arm_search.hpp"
#include "modules/pose_fitter/refined/solver.hpp"

namespace limbcast::pose_fitter::refined {

struct PoseCandidate {
  Real cost = 0.0;
  BodyState body;
};

/// Finds the body of least cost: from trunk and legs alone at many rotations, over arm postures,
/// and from the body that the image shows, to moves that leave a wrong minimum.
class PoseSearch {
 public:
  PoseSearch(const Observation& observation, const RefinedParams& params);

  /// Candidates that were refined on all points, best first, with what `front_cost` adds to their
  /// cost; never empty.
  std::vector<PoseCandidate> run();
  Solver& solver() { return solver_; }
  /// Other arms of a side, everything else staying; cost: what they add to the present arm's.
  std::vector<PoseCandidate> other_arms(const PoseCandidate& pose, int side);
  /// All points, all parts, the final spread of the surface.
  FitStage final_stage() const;

 private:
  std::vector<PoseCandidate> trunk_starts();
  PoseCandidate with_arms(const BodyState& start);
  /// Fitted from the body that the image shows and from the same seen from the other side; its size
  /// as of `like`. Empty where no image shows it.
  std::vector<PoseCandidate> poses_in_image(const BodyState& like);
  void move(PoseCandidate& pose);
  void move_limbs(PoseCandidate& pose);
  void choose_by_front(std::vector<PoseCandidate>& poses);
  bool try_flip(PoseCandidate& pose);
  bool accept_flipped(PoseCandidate flipped, PoseCandidate& pose);
  bool try_flip_with_other_arms(PoseCandidate& pose);
  bool try_legs(PoseCandidate& pose);
  bool try_arm(PoseCandidate& pose, int side);
  /// Takes a bent arm for a straight and raised one where that costs little more.
  void straighten_arm(PoseCandidate& pose, int side);
  /// The best `count` arms of `side` after fitting the arm alone to what the `explained` parts
  /// leave.
  std::vector<BodyState> fitted_arms(const BodyState& body, int side, unsigned explained,
                                     int postures, int count);
  bool accept(BodyState body, int iterations, PoseCandidate& pose);

  const Observation& observation_;
  const RefinedParams& params_;
  const SearchEffort& effort_;
  Solver solver_;
  std::vector<PoseCandidate> rejected_;  ///< bodies facing the other way that lost
  ArmSearch arms_;
};

}  // namespace limbcast::pose_fitter::refined
