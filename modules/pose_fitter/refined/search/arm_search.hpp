#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "modules/pose_fitter/refined/cost/cost.hpp"
#include "modules/pose_fitter/refined/search/arm_samples.hpp"

namespace limbcast::pose_fitter::refined {

struct ArmPosture {
  Real cost = 0.0;
  Vec3 elbow, wrist;
};

/// Looks for postures of one arm all around, where the solver would only find the nearest: by
/// directions of upper arm and forearm, and by reaching for the points (those first that no other
/// part explains).
class ArmSearch {
 public:
  ArmSearch(const Observation& observation, const RefinedParams& params);

  /// The best `count` postures that differ from one another, for the arm of `side` of `body`;
  /// points near the body's `explained` parts are taken as theirs.
  std::vector<ArmPosture> postures(const BodyState& body, int side, unsigned explained, int count);

 private:
  struct SeenArm;
  struct Frame;
  /// What each network says against a joint at a point.
  using ImageCosts = std::array<Real, kImageNetworkCount>;

  void mark_unexplained(const BodyState& body, unsigned explained);
  void look_at_samples();
  Real sample_cost(const Vec3& center, Real radius);
  ImageCosts image_costs(const Frame& arm, int joint, const Vec3& point) const;
  static Real sum(const ImageCosts& of_elbow, const ImageCosts& of_wrist);
  void by_directions(const Frame& arm, std::vector<ArmPosture>& found);
  void add_forearms(const Frame& arm, const Vec3& upper_direction, const Vec3& elbow,
                    Real half_cost, std::vector<ArmPosture>& found);
  void by_reaching(const Frame& arm, std::vector<ArmPosture>& found);
  void reach_seen_wrist(const Frame& arm, const SeenJoint& seen, std::vector<ArmPosture>& found);
  void reach(const Frame& arm, const Vec3& wrist_surface, std::vector<ArmPosture>& found);
  /// Those of `tried_` that are possible.
  void add_reaching(const Frame& arm, const Vec3& shoulder, const Vec3& wrist,
                    std::vector<ArmPosture>& found);

  const Observation& observation_;
  const RefinedParams& params_;
  std::vector<Vec3> directions_;
  std::vector<std::pair<Real, Real>> swivels_;  ///< cosine and sine
  int cell_px_ = 1, grid_width_ = 0, grid_height_ = 0;
  std::vector<int> columns_, row_starts_;  ///< of the cells, by pixel
  PointColumns grid_points_;               ///< own points, one of each cell
  std::vector<int> grid_cells_;            ///< their cells
  std::vector<float> unexplained_;         ///< by cell, 0 to 1
  /// For which these are marked: both arms of a start are looked for beside the same parts.
  std::optional<BodyState> marked_body_;
  unsigned marked_parts_ = 0;
  NearestCones nearest_;
  ArmSamples samples_;
  std::vector<ArmPosture> tried_;  ///< with what the elbow's place costs
};

void set_arm(BodyState& body, int side, const ArmPosture& posture);

}  // namespace limbcast::pose_fitter::refined
