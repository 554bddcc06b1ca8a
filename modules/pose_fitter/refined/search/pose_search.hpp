#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <vector>

#include "modules/pose_fitter/refined/search/pose_moves.hpp"

namespace limbcast::pose_fitter::refined {

/// Finds the body of least cost: from trunk and legs alone at many rotations, over arm postures,
/// and from the body that the image shows, to moves that leave a wrong minimum. Starts are fitted
/// and moved side by side; the result does not depend on the number of threads.
class PoseSearch {
 public:
  PoseSearch(const Observation& observation, const RefinedParams& params);

  /// Candidates that were refined on all points, best first, with what `front_cost` adds to their
  /// cost; never empty.
  std::vector<PoseCandidate> run();
  /// This thread's.
  PoseMoves& moves() { return moves_.local(); }

 private:
  std::vector<PoseCandidate> trunk_starts();
  /// The trunk starts whose arms are to be searched.
  std::vector<PoseCandidate> kept_starts(std::vector<PoseCandidate> all) const;
  /// Fitted from the body that the image shows and from the same seen from the other side; its size
  /// as of `like`. Empty where no image shows it.
  std::vector<PoseCandidate> poses_in_image(const BodyState& like);
  /// Moves the best poses; adds what they rejected.
  void move_best(std::vector<PoseCandidate>& poses);
  void choose_by_front(std::vector<PoseCandidate>& poses);
  /// Fits each body, to be found in `poses`, from where it is: all at the same time.
  void minimize(std::vector<PoseCandidate>& poses, const FitStage& stage, int iterations);

  const Observation& observation_;
  const RefinedParams& params_;
  const SearchEffort& effort_;
  tbb::enumerable_thread_specific<PoseMoves> moves_;
};

}  // namespace limbcast::pose_fitter::refined
