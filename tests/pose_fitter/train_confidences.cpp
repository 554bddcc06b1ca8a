// Fits the coefficients of the refined fitter's confidences and writes
// modules/pose_fitter/refined/confidence_coefficients.inc:
// limbcast-train-confidences OUT.inc FOLDER... runs the chain on each folder's frames and asks the
// truth of what was fitted. Frames that show bodies D4 or D5 are left out: they are for checking.
// train.sh makes the simulated folders and runs it on all that the coefficients were fitted to.

#include <tbb/parallel_for.h>

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

#include "common/human_model/ground_truth_json.hpp"
#include "common/units.hpp"
#include "modules/evaluate/evaluation.hpp"
#include "modules/evaluate/matching.hpp"
#include "modules/pose_fitter/refined/assessment.hpp"
#include "modules/pose_fitter/refined/confidence.hpp"
#include "modules/pose_fitter/refined/fitted_body.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/pose_fitter/logistic_regression.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::pose_fitter;
using refined::FittedBody;
using segmenter::LoadedFrame;
using segmenter::TruePerson;

const evaluate::EvaluationParams kRules;

/// What came of one or more frames.
struct Outcomes {
  std::vector<Outcome> joints, directions, persons;
  std::vector<double> direction_errors_in_spreads;  ///< of right directions
};

/// Eight neighbouring frames go to one block; of four blocks the last tells how good the fit is.
struct Halves {
  static constexpr std::size_t kBlock = 8, kBlocks = 4;
  Outcomes fitted_to, checked_on;

  Outcomes& of_frame(std::size_t i) {
    return i / kBlock % kBlocks == kBlocks - 1 ? checked_on : fitted_to;
  }
};

template <class T>
void append(std::vector<T>&& from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

void append(Outcomes&& from, Outcomes& to) {
  append(std::move(from.joints), to.joints);
  append(std::move(from.directions), to.directions);
  append(std::move(from.persons), to.persons);
  append(std::move(from.direction_errors_in_spreads), to.direction_errors_in_spreads);
}

BodyPose fitted_pose(const FittedBody& fitted) {
  BodyPose pose;
  for (int i = 0; i < kJointCount; ++i) {
    pose.joints[i].valid = true;
    pose.joints[i].position_m =
        fitted.observation.frame_from_image * fitted.body.points[i].cast<float>();
  }
  return pose;
}

bool is_visible(const JointEstimate& truth) { return truth.valid && truth.confidence > 0.5F; }

/// An arm that points is in sight where the truth says so, though the hand may hide the elbow; any
/// other one where its joints are.
std::optional<Eigen::Vector3f> visible_arm_axis(const BodyPose& truth, Side side) {
  for (const Pointing& pointing : truth.pointing) {
    if (pointing.side != side) continue;
    return pointing.confidence > 0.5F ? std::optional(pointing.direction) : std::nullopt;
  }
  const JointEstimate& shoulder = truth[on_side(Joint::kShoulderLeft, side)];
  const JointEstimate& wrist = truth[on_side(Joint::kWristLeft, side)];
  if (!shoulder.valid || !is_visible(truth[on_side(Joint::kElbowLeft, side)]) || !is_visible(wrist))
    return std::nullopt;
  return wrist.position_m - shoulder.position_m;
}

void add_joints(const FittedBody& fitted, const BodyPose& pose, const BodyPose& truth,
                Outcomes& outcomes) {
  for (int i = 0; i < kJointCount; ++i) {
    if (!is_visible(truth.joints[i])) continue;
    const float error_m = (pose.joints[i].position_m - truth.joints[i].position_m).norm();
    outcomes.joints.push_back(
        {refined::joint_features(fitted.evidence, i), error_m <= kRules.joint_limit_m});
  }
}

/// Only arms that point by the rule are asked how sure they are.
void add_directions(const FittedBody& fitted, const BodyPose& pose, const BodyPose& truth,
                    const Stamp& stamp, Outcomes& outcomes) {
  for (const Pointing& pointing : find_pointing(pose, stamp.gravity.down, refined::kPointingRule)) {
    const auto axis = visible_arm_axis(truth, pointing.side);
    if (!axis) continue;
    const refined::ArmEvidence& arm = fitted.evidence.arms[pointing.side == Side::kLeft ? 0 : 1];
    const double error_rad = std::atan2(pointing.direction.cross(*axis).norm(),  //
                                        pointing.direction.dot(*axis));
    const bool right = error_rad <= radians(kRules.right_direction_deg);
    outcomes.directions.push_back(
        {refined::direction_features(fitted.body, arm, fitted.evidence), right});
    if (right) outcomes.direction_errors_in_spreads.push_back(error_rad / arm.sigma_rad);
  }
}

Outcomes ask(const LoadedFrame& frame, const std::vector<BodyPose>& truth,
             const segmenter::Segmenter& segmenter) {
  const Segments segments = segmenter.segment(frame.cloud);
  std::vector<FittedBody> fitted;
  std::vector<BodyPose> poses;
  for (const Segment& segment : segments.segments) {
    if (!segment.valid()) continue;
    auto body = refined::fit_body(segment, segments.stamp, RefinedParams{});
    if (!body) continue;
    poses.push_back(fitted_pose(*body));
    fitted.push_back(std::move(*body));
  }
  const auto matching = evaluate::match_persons(truth, poses, kRules.match_distance_m);

  Outcomes outcomes;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    outcomes.persons.push_back({refined::person_features(fitted[i].evidence),
                                matching.kinds[i] == evaluate::ReportKind::kMatched});
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!matching.report_of_truth[i]) continue;
    const std::size_t k = *matching.report_of_truth[i];
    add_joints(fitted[k], poses[k], truth[i], outcomes);
    add_directions(fitted[k], poses[k], truth[i], segments.stamp, outcomes);
  }
  return outcomes;
}

bool for_checking(const LoadedFrame& frame) {
  return std::any_of(frame.persons.begin(), frame.persons.end(),
                     [](const TruePerson& person) { return person.for_checking(); });
}

void add_folder(const std::string& folder, const segmenter::Segmenter& segmenter, Halves& halves) {
  const segmenter::FrameReader reader(folder, segmenter::DepthFrom::kReconstructor);
  std::vector<Outcomes> of_frames(reader.paths().size());
  tbb::parallel_for(std::size_t{0}, of_frames.size(), [&](std::size_t i) {
    const std::string& path = reader.paths()[i];
    const LoadedFrame frame = reader.read(path);
    if (!frame.labelled || for_checking(frame)) return;
    of_frames[i] = ask(frame, read_ground_truth(path + "_gt.json").persons, segmenter);
  });
  for (std::size_t i = 0; i < of_frames.size(); ++i)
    append(std::move(of_frames[i]), halves.of_frame(i));
}

/// How many of the cases came true that were told with about a probability.
void print_reliability(const char* what, const Eigen::VectorXd& coefficients,
                       const std::vector<Outcome>& outcomes) {
  constexpr double kEdges[] = {0.0, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 1.0};
  std::printf("%s\n     told   cases  mean told  came true\n", what);
  for (std::size_t k = 0; k + 1 < std::size(kEdges); ++k) {
    int count = 0, positive = 0;
    double sum = 0.0;
    for (const Outcome& outcome : outcomes) {
      const double told = probability(coefficients, outcome.features);
      if (told < kEdges[k] || told >= kEdges[k + 1]) continue;
      ++count;
      positive += outcome.positive ? 1 : 0;
      sum += told;
    }
    if (count == 0) continue;
    std::printf("%.2f-%.2f  %6d  %9.3f  %9.3f\n", kEdges[k], kEdges[k + 1], count, sum / count,
                static_cast<double>(positive) / count);
  }
}

Eigen::VectorXd fit(const char* what, const std::vector<Outcome>& fitted_to,
                    const std::vector<Outcome>& checked_on) {
  if (fitted_to.empty()) throw std::runtime_error(std::string("no ") + what + " in these folders");
  Eigen::VectorXd coefficients = fit_logistic(fitted_to);
  print_reliability((std::string(what) + ", fitted to").c_str(), coefficients, fitted_to);
  print_reliability((std::string(what) + ", not fitted to").c_str(), coefficients, checked_on);
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
  const segmenter::Segmenter segmenter;
  Halves halves;
  for (int k = 2; k < argc; ++k) {
    add_folder(argv[k], segmenter, halves);
    std::printf("%s: %zu people and things so far\n", argv[k],
                halves.fitted_to.persons.size() + halves.checked_on.persons.size());
    std::fflush(stdout);
  }
  const Outcomes &fitted_to = halves.fitted_to, &checked_on = halves.checked_on;
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
  write_coefficients("kDirectionCoefficients",
                     fit("directions", fitted_to.directions, checked_on.directions), file);
  write_coefficients("kPersonCoefficients", fit("persons", fitted_to.persons, checked_on.persons),
                     file);
  file << "constexpr Real kSpreadScale = " << spread_scale << ";\n// clang-format on\n";
  if (!file) {
    std::fprintf(stderr, "limbcast-train-confidences: %s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
