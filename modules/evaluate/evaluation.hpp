#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/human_model/body_pose.hpp"

namespace limbcast::evaluate {

/// What counts as what. Origin of all: DESIGN "What counts" and data/README.
struct EvaluationParams {
  float match_distance_m = 0.5F;      ///< head and trunk of a report and the true person, at most
  float joint_limit_m = 0.10F;        ///< a joint this near is right
  float right_direction_deg = 15.0F;  ///< a direction this near is right
  float wrong_direction_deg = 20.0F;  ///< a direction farther off is wrong, not only inexact
  float bent_elbow_deg = 60.0F;       ///< an elbow bent by more: that arm does not point
  float hanging_deg = 35.0F;  ///< an arm nearer to the trunk's direction hangs: it does not point
  /// Persons with fewer visible joints need not be found (finding them is no fault either).
  int min_visible_joints = 3;
};

/// One true frame. Conventions as on GROUND_TRUTH: confidence of a joint 1 visible, 0 hidden; of
/// pointing 1 to be judged, 0 hidden arm or untrustworthy label.
struct TruthFrame {
  BodyPoses poses;
  /// One for each person: false leaves it out of all figures (body filter). Empty: all count.
  std::vector<bool> counts;
};

/// count of total.
struct Share {
  int count = 0, total = 0;
  void add(bool counts) {
    count += counts ? 1 : 0;
    ++total;
  }
};

/// A stated certainty and what came of it.
struct Stated {
  double stated = 0.0, measured = 0.0;
};

/// One thing that is wrong, to look at.
struct Finding {
  std::int64_t utime = 0;
  int report = -1;  ///< place of the reported person in its frame, -1 = none
  int truth = -1;   ///< place of the true person in its frame, -1 = none
  std::string what;
  double figure = 0.0;  ///< degrees where `what` is about a direction, metres for a joint, else 0
};

/// Sums of all frames.
struct Tally {
  int frames = 0, frames_not_reported = 0, empty_frames = 0;
  Share found;  ///< true persons that count and are visible enough
  int reported = 0, invented = 0, twice = 0;
  int invented_in_empty_frames = 0;
  Share pointing_right;       ///< of visible pointing arms
  int pointing_reported = 0;  ///< reported arms of true persons whose arm can be judged
  int wrong_direction = 0, wrong_side = 0;
  Share said_to_point;  ///< of found persons whose arms are both bent or hanging
  Share told_arms_off;  ///< of all directions told of arms that the truth knows, hidden ones too
  /// Errors of the directions reported for visible pointing arms, right side [degrees].
  std::vector<double> pointing_errors_deg, forearm_errors_deg, head_hand_errors_deg;
  std::array<Share, kJointCount>
      within_limit;  ///< of the visible joints, missing ones count as off
  std::array<std::vector<double>, kJointCount> joint_errors_m;  ///< of the reported visible joints
  std::vector<std::vector<double>> joint_errors_by_person_m;
  std::vector<Stated>
      joint_confidences;             ///< stated: probability; measured: 1 within the limit, else 0
  std::vector<Stated> joint_sigmas;  ///< [m]
  std::vector<Stated> pointing_confidences;
  std::vector<Stated> pointing_sigmas;  ///< [degrees]
  std::vector<Finding> findings;        ///< in order of frames

  /// Persons reported where none is or twice, directions that are off or on the wrong side.
  int wrong_reported() const { return wrong_direction + wrong_side + invented + twice; }
};

/// True where data/README says that a person does not point: both arms are known, and each is bent
/// or hangs.
bool surely_not_pointing(const BodyPose& truth, const EvaluationParams& params = {});

/// From the shoulder to the wrist, also of a hidden arm, not of unit length; nothing where the
/// truth does not know the arm or its label cannot be trusted.
std::optional<Eigen::Vector3f> true_arm_axis(const BodyPose& truth, Side side);

/// Compares reported poses with the truth, frame by frame. Only visible joints count.
class Evaluation {
 public:
  explicit Evaluation(const EvaluationParams& params = {}) : params_(params) {}

  /// `reported`: null where the frame was not reported at all (counts as nobody reported).
  void add(const TruthFrame& truth, const BodyPoses* reported);

  const EvaluationParams& params() const { return params_; }
  const Tally& tally() const { return tally_; }

 private:
  struct Subject;
  void add_reports(const TruthFrame& truth, const std::vector<BodyPose>& reported,
                   const struct Matching& matching);
  void add_person(const Subject& subject);
  void add_joints(const Subject& subject);
  void add_pointing(const Subject& subject);
  void add_told_arms(const Subject& subject);
  void add_judged_arm(const Subject& subject, const Pointing& truth, const Pointing* said);
  void add_directions(const Pointing& truth, const Pointing& said);
  void note(const Subject& subject, const std::string& what, double figure = 0.0);

  EvaluationParams params_;
  Tally tally_;
};

/// Pairs truth and reports by utime and sensor. Reports without truth are left out.
Tally evaluate(const std::vector<TruthFrame>& truth, const std::vector<BodyPoses>& reported,
               const EvaluationParams& params = {});

}  // namespace limbcast::evaluate
