// Fits the coefficients of the refined fitter's confidences and writes
// modules/pose_fitter/refined/confidence/confidence_coefficients.inc:
// limbcast-train-confidences OUT.inc FOLDER... runs the chain on each folder's frames and asks the
// truth of what was fitted. Frames that show bodies D4 or D5 are left out: they are for checking.
// train.sh makes the simulated folders and runs it on all that the coefficients were fitted to.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/units.hpp"
#include "modules/evaluate/evaluation.hpp"
#include "modules/pose_fitter/refined/confidence/assessment.hpp"
#include "modules/pose_fitter/refined/confidence/confidence.hpp"
#include "tests/pose_fitter/refined/confidence/fitted_frames.hpp"
#include "tests/pose_fitter/refined/confidence/logistic_regression.hpp"
#include "tests/pose_fitter/refined/confidence/reliability.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::pose_fitter;
using refined::FittedBody;

const evaluate::EvaluationParams kRules;

/// What came of one or more frames.
struct Outcomes {
  std::vector<Outcome> joints, facings, directions;
  std::vector<double> direction_errors_in_spreads;  ///< of right directions
};

template <class T>
void append(std::vector<T>&& from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

void append(Outcomes&& from, Outcomes& to) {
  append(std::move(from.joints), to.joints);
  append(std::move(from.facings), to.facings);
  append(std::move(from.directions), to.directions);
  append(std::move(from.direction_errors_in_spreads), to.direction_errors_in_spreads);
}

bool is_visible(const JointEstimate& truth) { return truth.valid && truth.confidence > 0.5F; }

void add_joints(const FittedBody& fitted, const BodyPose& pose, const BodyPose& truth,
                Outcomes& outcomes) {
  for (int i = 0; i < kJointCount; ++i) {
    if (!is_visible(truth.joints[i])) continue;
    const float error_m = (pose.joints[i].position_m - truth.joints[i].position_m).norm();
    outcomes.joints.push_back(
        {refined::joint_features(fitted.evidence, i), error_m <= kRules.joint_limit_m});
  }
}

/// Which way somebody faces who stands upright, not of unit length; nothing where it is not known.
std::optional<Eigen::Vector3f> front_of(const BodyPose& pose, const Eigen::Vector3f& down) {
  Eigen::Vector3f leftwards = Eigen::Vector3f::Zero();
  for (const Joint left : {Joint::kShoulderLeft, Joint::kHipLeft}) {
    const JointEstimate& from = pose[on_side(left, Side::kRight)];
    const JointEstimate& to = pose[left];
    if (!from.valid || !to.valid) return std::nullopt;
    leftwards += to.position_m - from.position_m;
  }
  return down.cross(leftwards);
}

/// Whether a body faces the way that it does in truth.
std::optional<bool> faces_right(const BodyPose& pose, const BodyPose& truth,
                                const Eigen::Vector3f& down) {
  const auto front = front_of(pose, down), true_front = front_of(truth, down);
  if (!front || !true_front) return std::nullopt;
  return front->dot(*true_front) > 0.0F;
}

/// Only arms that point by the rule are asked how sure they are. Hidden ones count too: what is
/// told of them is nearly always another thing that was taken for an arm.
void add_directions(const FittedBody& fitted, const BodyPose& pose, const BodyPose& truth,
                    const Stamp& stamp, Outcomes& outcomes) {
  for (const Pointing& pointing : find_pointing(pose, stamp.gravity.down, refined::kPointingRule)) {
    const auto axis = evaluate::true_arm_axis(truth, pointing.side);
    if (!axis) continue;
    const int side = static_cast<int>(pointing.side);
    const double error_rad = std::atan2(pointing.direction.cross(*axis).norm(),  //
                                        pointing.direction.dot(*axis));
    const bool right = error_rad <= radians(kRules.right_direction_deg);
    outcomes.directions.push_back(
        {refined::direction_features(fitted.body, side, fitted.evidence), right});
    if (right)
      outcomes.direction_errors_in_spreads.push_back(error_rad /
                                                     fitted.evidence.arms[side].sigma_rad);
  }
}

Outcomes ask(const FittedFrame& frame) {
  Outcomes outcomes;
  for (std::size_t i = 0; i < frame.truth.size(); ++i) {
    if (!frame.matching.report_of_truth[i]) continue;
    const std::size_t k = *frame.matching.report_of_truth[i];
    add_joints(frame.bodies[k], frame.poses[k], frame.truth[i], outcomes);
    const std::optional<bool> facing =
        faces_right(frame.poses[k], frame.truth[i], frame.stamp.gravity.down);
    if (!facing) continue;
    outcomes.facings.push_back({refined::facing_features(frame.bodies[k].evidence), *facing});
    if (*facing)
      add_directions(frame.bodies[k], frame.poses[k], frame.truth[i], frame.stamp, outcomes);
  }
  return outcomes;
}

std::vector<Told> told_of(const Eigen::VectorXd& coefficients,
                          const std::vector<Outcome>& outcomes) {
  std::vector<Told> told;
  for (const Outcome& outcome : outcomes)
    told.push_back({probability(coefficients, outcome.features), outcome.positive});
  return told;
}

Eigen::VectorXd fit(const char* what, const std::vector<Outcome>& fitted_to,
                    const std::vector<Outcome>& checked_on) {
  if (fitted_to.empty()) throw std::runtime_error(std::string("no ") + what + " in these folders");
  Eigen::VectorXd coefficients = fit_logistic(fitted_to);
  print_reliability((std::string(what) + ", fitted to").c_str(), told_of(coefficients, fitted_to));
  print_reliability((std::string(what) + ", not fitted to").c_str(),
                    told_of(coefficients, checked_on));
  return coefficients;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

void write_coefficients(const char* name, const Eigen::VectorXd& coefficients, std::ostream& file) {
  file << "constexpr Real " << name << "[] = {";
  for (Eigen::Index i = 0; i < coefficients.size(); ++i)
    file << (i == 0 ? "" : ", ") << coefficients[i];
  file << "};\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-train-confidences OUT.inc FOLDER...\n");
    return 2;
  }
  Outcomes fitted_to, checked_on;
  for (int k = 2; k < argc; ++k) {
    fit_frames(argv[k], segmenter::Params{}, [&](const FittedFrame& frame, std::size_t i) {
      append(ask(frame), is_checked_on(i) ? checked_on : fitted_to);
    });
    std::printf("%s: %zu directions so far\n", argv[k],
                fitted_to.directions.size() + checked_on.directions.size());
    std::fflush(stdout);
  }
  const double spread_scale = root_mean_square(fitted_to.direction_errors_in_spreads);
  std::printf("error over spread of right directions: %.2f, not fitted to: %.2f\n", spread_scale,
              root_mean_square(checked_on.direction_errors_in_spreads));

  std::ofstream file(argv[1]);
  file.setf(std::ios::fixed);
  file.precision(4);
  file << "// Written by limbcast-train-confidences, which train.sh runs; not to be edited.\n"
          "// clang-format off\n";
  write_coefficients("kJointCoefficients", fit("joints", fitted_to.joints, checked_on.joints),
                     file);
  write_coefficients("kFacingCoefficients", fit("facings", fitted_to.facings, checked_on.facings),
                     file);
  write_coefficients("kDirectionCoefficients",
                     fit("directions", fitted_to.directions, checked_on.directions), file);
  file << "constexpr Real kSpreadScale = " << spread_scale << ";\n// clang-format on\n";
  if (!file) {
    std::fprintf(stderr, "limbcast-train-confidences: %s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
