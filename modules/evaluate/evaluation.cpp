#include "modules/evaluate/evaluation.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "common/angle.hpp"
#include "common/units.hpp"
#include "modules/evaluate/matching.hpp"
#include "modules/evaluate/reported_frames.hpp"

namespace limbcast::evaluate {
namespace {

bool is_visible(const JointEstimate& truth) { return truth.valid && truth.confidence > 0.5F; }

int visible_joints(const BodyPose& truth) {
  return static_cast<int>(std::count_if(truth.joints.begin(), truth.joints.end(), is_visible));
}

/// Direction of the trunk downwards; zero where it is not known. Hand labels have no pelvis, but
/// hips.
Eigen::Vector3f trunk_direction(const BodyPose& truth) {
  const JointEstimate &neck = truth[Joint::kNeck], &pelvis = truth[Joint::kPelvis];
  const JointEstimate &left = truth[Joint::kHipLeft], &right = truth[Joint::kHipRight];
  if (!neck.valid) return Eigen::Vector3f::Zero();
  if (pelvis.valid) return pelvis.position_m - neck.position_m;
  if (left.valid && right.valid)
    return 0.5F * (left.position_m + right.position_m) - neck.position_m;
  return Eigen::Vector3f::Zero();
}

bool arm_rests(const BodyPose& truth, Side side, const EvaluationParams& params) {
  const JointEstimate& shoulder = truth[on_side(Joint::kShoulderLeft, side)];
  const JointEstimate& elbow = truth[on_side(Joint::kElbowLeft, side)];
  const JointEstimate& wrist = truth[on_side(Joint::kWristLeft, side)];
  if (!shoulder.valid || !elbow.valid || !wrist.valid) return false;
  const Eigen::Vector3f upper = elbow.position_m - shoulder.position_m;
  const Eigen::Vector3f lower = wrist.position_m - elbow.position_m;
  if (angle_deg(upper, lower) > params.bent_elbow_deg) return true;
  const Eigen::Vector3f trunk = trunk_direction(truth);
  return !trunk.isZero() &&
         angle_deg(wrist.position_m - shoulder.position_m, trunk) < params.hanging_deg;
}

/// The arm itself cannot be seen (a label that cannot be trusted has visible joints).
bool arm_is_hidden(const BodyPose& truth, Side side) {
  return !is_visible(truth[on_side(Joint::kElbowLeft, side)]) ||
         !is_visible(truth[on_side(Joint::kWristLeft, side)]);
}

/// A label that cannot be trusted proves nothing, right or wrong.
bool can_be_judged(const BodyPose& truth, const Pointing& pointing) {
  return !pointing.direction.isZero() &&
         (pointing.confidence > 0.5F || arm_is_hidden(truth, pointing.side));
}

}  // namespace

bool surely_not_pointing(const BodyPose& truth, const EvaluationParams& params) {
  return truth.pointing.empty() && arm_rests(truth, Side::kLeft, params) &&
         arm_rests(truth, Side::kRight, params);
}

std::optional<Eigen::Vector3f> true_arm_axis(const BodyPose& truth, Side side) {
  for (const Pointing& pointing : truth.pointing) {
    if (pointing.side == side)
      return can_be_judged(truth, pointing) ? std::optional(pointing.direction) : std::nullopt;
  }
  const JointEstimate& shoulder = truth[on_side(Joint::kShoulderLeft, side)];
  const JointEstimate& wrist = truth[on_side(Joint::kWristLeft, side)];
  if (!shoulder.valid || !wrist.valid) return std::nullopt;
  return wrist.position_m - shoulder.position_m;
}

/// A true person and what was reported for it.
struct Evaluation::Subject {
  std::int64_t utime;
  int truth_index, report_index;
  const BodyPose& truth;
  const BodyPose* reported;  ///< null: not found
};

void Evaluation::note(const Subject& subject, const std::string& what, double figure) {
  tally_.findings.push_back(
      {subject.utime, subject.report_index, subject.truth_index, what, figure});
}

void Evaluation::add(const TruthFrame& truth, const BodyPoses* reported) {
  static const std::vector<BodyPose> kNobody;
  const std::vector<BodyPose>& persons = truth.poses.persons;
  const std::vector<BodyPose>& reports = reported == nullptr ? kNobody : reported->persons;
  const auto counts = [&truth](std::size_t i) { return truth.counts.empty() || truth.counts[i]; };
  bool any_counts = persons.empty();
  for (std::size_t i = 0; i < persons.size(); ++i) any_counts = any_counts || counts(i);
  if (!any_counts) return;

  ++tally_.frames;
  if (reported == nullptr) ++tally_.frames_not_reported;
  if (persons.empty()) ++tally_.empty_frames;
  const Matching matching = match_persons(persons, reports, params_.match_distance_m);
  add_reports(truth, reports, matching);
  for (std::size_t i = 0; i < persons.size(); ++i) {
    if (!counts(i)) continue;
    const auto report = matching.report_of_truth[i];
    add_person({truth.poses.stamp.utime, static_cast<int>(i),
                report ? static_cast<int>(*report) : -1, persons[i],
                report ? &reports[*report] : nullptr});
  }
}

void Evaluation::add_reports(const TruthFrame& truth, const std::vector<BodyPose>& reported,
                             const Matching& matching) {
  std::vector<bool> left_out(reported.size(), false);
  for (std::size_t i = 0; i < truth.counts.size(); ++i) {
    if (!truth.counts[i] && matching.report_of_truth[i])
      left_out[*matching.report_of_truth[i]] = true;
  }
  for (std::size_t i = 0; i < reported.size(); ++i) {
    if (left_out[i]) continue;
    ++tally_.reported;
    const auto finding = [&](const char* what) {
      tally_.findings.push_back({truth.poses.stamp.utime, static_cast<int>(i), -1, what, 0.0});
    };
    if (matching.kinds[i] == ReportKind::kTwice) {
      ++tally_.twice;
      finding("reported twice");
    }
    if (matching.kinds[i] == ReportKind::kInvented) {
      ++tally_.invented;
      if (truth.poses.persons.empty()) ++tally_.invented_in_empty_frames;
      finding("invented");
    }
  }
}

void Evaluation::add_person(const Subject& subject) {
  if (visible_joints(subject.truth) >= params_.min_visible_joints) {
    tally_.found.add(subject.reported != nullptr);
    if (subject.reported == nullptr) note(subject, "not found");
  }
  add_joints(subject);
  add_pointing(subject);
}

void Evaluation::add_joints(const Subject& subject) {
  std::vector<double> errors_m;
  for (int i = 0; i < kJointCount; ++i) {
    const JointEstimate& truth = subject.truth.joints[i];
    if (!is_visible(truth)) continue;
    const bool has = subject.reported != nullptr && subject.reported->joints[i].valid;
    if (!has) {
      tally_.within_limit[i].add(false);
      continue;
    }
    const JointEstimate& joint = subject.reported->joints[i];
    const double error_m = (joint.position_m - truth.position_m).norm();
    const bool within = error_m <= params_.joint_limit_m;
    tally_.within_limit[i].add(within);
    tally_.joint_errors_m[i].push_back(error_m);
    errors_m.push_back(error_m);
    if (joint.confidence > 0.0F)
      tally_.joint_confidences.push_back({joint.confidence, within ? 1.0 : 0.0});
    if (joint.sigma_m > 0.0F) tally_.joint_sigmas.push_back({joint.sigma_m, error_m});
    if (!within) note(subject, std::string(kJointNames[i]) + " off", error_m);
  }
  tally_.joint_errors_by_person_m.push_back(std::move(errors_m));
}

void Evaluation::add_pointing(const Subject& subject) {
  const bool says = subject.reported != nullptr && !subject.reported->pointing.empty();
  const Pointing* said = says ? &subject.reported->pointing.front() : nullptr;
  if (!subject.truth.pointing.empty()) {
    add_judged_arm(subject, subject.truth.pointing.front(), said);
  } else if (subject.reported != nullptr && surely_not_pointing(subject.truth, params_)) {
    tally_.said_to_point.add(says);
    if (says) note(subject, "does not point but is said to");
  }
  if (says) add_told_arms(subject);
}

/// Also of people who point with another arm or with none, where nothing else asks whether what is
/// told of an arm is so.
void Evaluation::add_told_arms(const Subject& subject) {
  for (const Pointing& said : subject.reported->pointing) {
    const auto axis = true_arm_axis(subject.truth, said.side);
    if (!axis) continue;
    const double error_deg = angle_deg(said.direction, *axis);
    const bool off = error_deg > params_.wrong_direction_deg;
    tally_.told_arms_off.add(off);
    // Of the arm that points `add_judged_arm` says so.
    const auto& points = subject.truth.pointing;
    const bool is_judged = !points.empty() && points.front().side == said.side;
    if (off && !is_judged) note(subject, "arm is elsewhere than told", error_deg);
  }
}

void Evaluation::add_judged_arm(const Subject& subject, const Pointing& truth,
                                const Pointing* said) {
  if (!can_be_judged(subject.truth, truth)) return;
  const bool visible = truth.confidence > 0.5F;
  const bool right_side = said != nullptr && said->side == truth.side;
  const double error_deg = right_side ? angle_deg(said->direction, truth.direction) : 180.0;
  const bool right = right_side && error_deg <= params_.right_direction_deg;
  if (visible) {
    tally_.pointing_right.add(right);
    if (said == nullptr) note(subject, "points but no direction reported");
  }
  if (said == nullptr) return;
  ++tally_.pointing_reported;
  if (!right_side) {
    ++tally_.wrong_side;
    note(subject, "points with the other arm");
  } else if (error_deg > params_.wrong_direction_deg) {
    ++tally_.wrong_direction;
    note(subject, visible ? "direction off" : "direction of a hidden arm off", error_deg);
  } else if (!right) {
    note(subject, "direction inexact", error_deg);
  }
  if (visible && said->confidence > 0.0F)
    tally_.pointing_confidences.push_back({said->confidence, right ? 1.0 : 0.0});
  if (visible && right_side) add_directions(truth, *said);
}

void Evaluation::add_directions(const Pointing& truth, const Pointing& said) {
  const double error_deg = angle_deg(said.direction, truth.direction);
  tally_.pointing_errors_deg.push_back(error_deg);
  if (!truth.forearm.isZero() && !said.forearm.isZero())
    tally_.forearm_errors_deg.push_back(angle_deg(said.forearm, truth.forearm));
  if (!truth.head_hand.isZero() && !said.head_hand.isZero())
    tally_.head_hand_errors_deg.push_back(angle_deg(said.head_hand, truth.head_hand));
  if (said.sigma_rad > 0.0F)
    tally_.pointing_sigmas.push_back({said.sigma_rad * kDegreesPerRadian<double>, error_deg});
}

Tally evaluate(const std::vector<TruthFrame>& truth, const std::vector<BodyPoses>& reported,
               const EvaluationParams& params) {
  const ReportedFrames frames(reported);
  Evaluation evaluation(params);
  for (const TruthFrame& frame : truth) evaluation.add(frame, frames.at(frame.poses.stamp));
  return evaluation.tally();
}

}  // namespace limbcast::evaluate
