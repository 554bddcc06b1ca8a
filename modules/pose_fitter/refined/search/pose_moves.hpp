#pragma once

#include <array>
#include <vector>

#include "modules/pose_fitter/refined/search/arm_search.hpp"
#include "modules/pose_fitter/refined/search/solver.hpp"

namespace limbcast::pose_fitter::refined {

struct PoseCandidate {
  Real cost = 0.0;
  BodyState body;
};

/// Least cost first; of equal costs the one that came first.
void sort_by_cost(std::vector<PoseCandidate>& poses);

/// Fits bodies from where they are told to start, and tries what leaves a wrong minimum. Holds
/// buffers: one for each thread.
class PoseMoves {
 public:
  PoseMoves(const Observation& observation, const RefinedParams& params);

  static const SearchEffort& effort_for(const Observation& observation,
                                        const RefinedParams& params);

  /// The body with the arms that fit it best, fitted to all points.
  PoseCandidate with_arms(const BodyState& start);
  /// Front for back, other legs and arms, as long as the cost falls. Bodies facing the other way
  /// that lost are added to `rejected`.
  void move(PoseCandidate& pose, std::vector<PoseCandidate>& rejected);
  /// Other legs and arms.
  void move_limbs(PoseCandidate& pose);
  /// Takes a bent arm for a straight and raised one where that costs little more.
  void straighten_arm(PoseCandidate& pose, int side);
  /// Other arms of a side, everything else staying; cost: what they add to the present arm's.
  std::vector<PoseCandidate> other_arms(const PoseCandidate& pose, int side);

  Solver& solver() { return solver_; }
  /// All points, all parts, the final spread of the surface.
  FitStage final_stage() const;

 private:
  PoseCandidate flipped(const BodyState& body);
  bool try_legs(PoseCandidate& pose);
  bool try_arm(PoseCandidate& pose, int side);
  /// Fits of the arm of `side` alone to what the `explained` parts leave, best first.
  const std::vector<PoseCandidate>& fit_arms(const BodyState& body, int side, unsigned explained,
                                             int postures);
  /// The best `count` of them that differ.
  std::vector<BodyState> fitted_arms(const BodyState& body, int side, unsigned explained,
                                     int postures, int count);
  bool accept(BodyState body, int iterations, PoseCandidate& pose);

  /// What was fitted to a side last: the arms of a body whose moves fail are asked for once more as
  /// evidence.
  struct FittedArms {
    BodyState body;
    unsigned explained = 0;
    int postures = 0;
    std::vector<PoseCandidate> fits;
  };

  const Observation& observation_;
  const RefinedParams& params_;
  const SearchEffort& effort_;
  Solver solver_;
  ArmSearch arms_;
  std::array<FittedArms, 2> fitted_arms_;  ///< of each side
};

}  // namespace limbcast::pose_fitter::refined
