#include "modules/evaluate/tracking.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "common/units.hpp"
#include "modules/evaluate/matching.hpp"
#include "modules/evaluate/reported_frames.hpp"
#include "modules/evaluate/statistics.hpp"

namespace limbcast::evaluate {
namespace {

using Eigen::Vector3f;

/// A true person in one frame and what was told of it.
struct Moment {
  std::int64_t utime;
  const BodyPose* truth;
  const BodyPose* untracked;  ///< null: not found
  const BodyPose* tracked;    ///< null: not found
};
/// One true person from frame to frame.
using Life = std::vector<Moment>;

double seconds_between(const Moment& a, const Moment& b) {
  return static_cast<double>(b.utime - a.utime) / kMicrosecondsPerSecond<double>;
}

/// What tells true persons of a frame apart.
std::vector<int> identities(const std::vector<BodyPose>& persons) {
  std::vector<int> by_id, by_place;
  std::set<int> different;
  for (std::size_t i = 0; i < persons.size(); ++i) {
    by_id.push_back(persons[i].id);
    by_place.push_back(static_cast<int>(i));
    different.insert(persons[i].id);
  }
  return different.size() == persons.size() ? by_id : by_place;
}

class Lives {
 public:
  explicit Lives(const TrackingParams& params) : params_(params) {}

  void add(const BodyPoses& truth, const BodyPoses* untracked, const BodyPoses* tracked) {
    const auto in_untracked = reports_of(truth, untracked);
    const auto in_tracked = reports_of(truth, tracked);
    const std::vector<int> who = identities(truth.persons);
    for (std::size_t i = 0; i < truth.persons.size(); ++i) {
      const Moment moment{truth.stamp.utime, &truth.persons[i], in_untracked[i], in_tracked[i]};
      Life& life = present_[{truth.stamp.sensor, who[i]}];
      if (!life.empty() && is_cut(life.back(), moment)) finish(life);
      life.push_back(moment);
    }
  }

  std::vector<Life> take() {
    for (auto& [who, life] : present_) finish(life);
    return std::move(finished_);
  }

 private:
  std::vector<const BodyPose*> reports_of(const BodyPoses& truth, const BodyPoses* told) const {
    std::vector<const BodyPose*> reports(truth.persons.size(), nullptr);
    if (told == nullptr) return reports;
    const Matching matching = match_persons(truth.persons, told->persons, params_.match_distance_m);
    for (std::size_t i = 0; i < reports.size(); ++i)
      if (matching.report_of_truth[i]) reports[i] = &told->persons[*matching.report_of_truth[i]];
    return reports;
  }

  bool is_cut(const Moment& before, const Moment& now) const {
    const auto moved_m = person_distance_m(*before.truth, *now.truth);
    return moved_m && *moved_m > params_.scene_cut_speed_m_s * seconds_between(before, now);
  }

  void finish(Life& life) {
    finished_.push_back(std::move(life));
    life.clear();
  }

  const TrackingParams& params_;
  std::map<std::pair<std::string, int>, Life> present_;  ///< by sensor and person
  std::vector<Life> finished_;
};

void count_switches(const Life& life, TrackingTally& tally) {
  std::optional<std::int32_t> last_id;
  for (const Moment& moment : life) {
    if (moment.tracked == nullptr) continue;
    ++tally.followed;
    if (last_id && *last_id != moment.tracked->id) ++tally.identity_switches;
    last_id = moment.tracked->id;
  }
}

/// A quantity of a person, nothing where it is not known.
using Quantity = std::function<std::optional<Vector3f>(const BodyPose&)>;

/// Calls `visit(begin, end)` for each longest run of moments between which the true quantity rests.
template <class Visit>
void for_each_rest(const Life& life, const Quantity& quantity, double rest_speed,
                   const Visit& visit) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= life.size(); ++i) {
    bool rests = false;
    if (i < life.size()) {
      const auto before = quantity(*life[i - 1].truth), now = quantity(*life[i].truth);
      rests = before && now &&
              (*now - *before).norm() <= rest_speed * seconds_between(life[i - 1], life[i]);
    }
    if (rests) continue;
    visit(begin, i);
    begin = i;
  }
}

/// The value in the middle, each coordinate by itself: a few jumps do not move it.
Vector3f middle(const std::vector<Vector3f>& values) {
  Vector3f result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const Vector3f& value : values) coordinates.push_back(value[axis]);
    result[axis] = static_cast<float>(*quantile(coordinates, 0.5));
  }
  return result;
}

std::vector<double> deviations(const std::vector<Vector3f>& values) {
  const Vector3f center = middle(values);
  std::vector<double> result;
  for (const Vector3f& value : values) result.push_back((value - center).norm());
  return result;
}

std::vector<double> steps(const std::vector<Vector3f>& values) {
  std::vector<double> result;
  for (std::size_t i = 1; i < values.size(); ++i)
    result.push_back((values[i] - values[i - 1]).norm());
  return result;
}

/// What a rest's values tell of their restlessness.
using Restlessness = std::function<std::vector<double>(const std::vector<Vector3f>&)>;

/// Of errors, not of places: nobody stands still to the millimetre.
void add_rests(const Life& life, const Quantity& quantity, double rest_speed, int min_frames,
               const Restlessness& restlessness, TrackingTally::Groups& untracked,
               TrackingTally::Groups& tracked) {
  for_each_rest(life, quantity, rest_speed, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector3f> errors_untracked, errors_tracked;
    for (std::size_t i = begin; i < end; ++i) {
      if (life[i].untracked == nullptr || life[i].tracked == nullptr) continue;
      const auto truth = quantity(*life[i].truth);
      const auto before = quantity(*life[i].untracked), after = quantity(*life[i].tracked);
      if (!truth || !before || !after) continue;
      errors_untracked.push_back(*before - *truth);
      errors_tracked.push_back(*after - *truth);
    }
    if (static_cast<int>(errors_tracked.size()) < min_frames) return;
    untracked.push_back(restlessness(errors_untracked));
    tracked.push_back(restlessness(errors_tracked));
  });
}

Quantity position_mm(int joint_index) {
  return [joint_index](const BodyPose& pose) -> std::optional<Vector3f> {
    const JointEstimate& joint = pose.joints[joint_index];
    if (!joint.valid) return std::nullopt;
    return Vector3f(joint.position_m * kMillimetersPerMeter<float>);
  };
}

/// In degrees: the distance of two near directions is their angle.
Quantity pointing_direction_deg(Side side) {
  return [side](const BodyPose& pose) -> std::optional<Vector3f> {
    for (const Pointing& pointing : pose.pointing)
      if (pointing.side == side && !pointing.direction.isZero())
        return Vector3f(pointing.direction * kDegreesPerRadian<float>);
    return std::nullopt;
  };
}

/// How many frames the tracked joint is behind the untracked one, along the true motion of a frame.
std::vector<double> lags(const Life& life, const Quantity& position, double moving_speed_mm_s) {
  std::vector<double> frames;
  for (std::size_t i = 1; i + 1 < life.size(); ++i) {
    const auto before = position(*life[i - 1].truth), after = position(*life[i + 1].truth);
    if (!before || !after || life[i].untracked == nullptr || life[i].tracked == nullptr) continue;
    const auto untracked = position(*life[i].untracked), tracked = position(*life[i].tracked);
    if (!untracked || !tracked) continue;
    const Vector3f motion = *after - *before;
    if (motion.norm() < moving_speed_mm_s * seconds_between(life[i - 1], life[i + 1])) continue;
    const Vector3f motion_a_frame = 0.5F * motion;
    frames.push_back((*untracked - *tracked).dot(motion_a_frame) / motion_a_frame.squaredNorm());
  }
  return frames;
}

void add_life(const Life& life, const TrackingParams& params, TrackingTally& tally) {
  count_switches(life, tally);
  for (int joint = 0; joint < kJointCount; ++joint) {
    const Quantity position = position_mm(joint);
    const double rest_speed_mm_s = params.rest_speed_m_s * kMillimetersPerMeter<float>;
    add_rests(life, position, rest_speed_mm_s, params.min_rest_frames, deviations,
              tally.untracked_joints_mm, tally.tracked_joints_mm);
    add_rests(life, position, rest_speed_mm_s, params.min_rest_frames, steps,
              tally.untracked_steps_mm, tally.tracked_steps_mm);
    auto lags_frames = lags(life, position, params.moving_speed_m_s * kMillimetersPerMeter<float>);
    if (!lags_frames.empty()) tally.lags_frames.push_back(std::move(lags_frames));
  }
  for (const Side side : {Side::kLeft, Side::kRight})
    add_rests(life, pointing_direction_deg(side), params.rest_speed_deg_s, params.min_rest_frames,
              deviations, tally.untracked_directions_deg, tally.tracked_directions_deg);
}

std::optional<double> median(const std::vector<double>& values) { return quantile(values, 0.5); }

std::optional<double> root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  if (values.empty()) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<double> flattened(const TrackingTally::Groups& groups) {
  std::vector<double> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

Figure figure(const std::string& key, const std::string& title, const TrackingTally::Groups& groups,
              const Statistic& statistic, const std::string& total_of, const std::string& goal) {
  const std::vector<double> all = flattened(groups);
  return {key,
          title,
          statistic(all),
          bootstrap_interval(groups, statistic),
          0,
          static_cast<int>(all.size()),
          total_of,
          goal};
}

/// Untracked, tracked, and what tracking leaves of it.
void add_jitter(const std::string& key, const std::string& unit, const std::string& title,
                const TrackingTally::Groups& untracked, const TrackingTally::Groups& tracked,
                const Statistic& statistic, const std::string& total_of,
                std::vector<Figure>& figures) {
  figures.push_back(figure(key + "_untracked_" + unit, title + " [" + unit + "]", untracked,
                           statistic, total_of, ""));
  figures.push_back(figure(key + "_tracked_" + unit, "  tracked [" + unit + "]", tracked, statistic,
                           total_of, ""));
  Figure left{key + "_left", "  left of it [in 100]", {}, {}, 0, figures.back().total, total_of,
              "<= 50"};
  const auto before = statistic(flattened(untracked)), after = statistic(flattened(tracked));
  if (before && *before > 0.0) left.value = 100.0 * *after / *before;
  figures.push_back(left);
}

}  // namespace

TrackingTally evaluate_tracking(const std::vector<TruthFrame>& truth,
                                const std::vector<BodyPoses>& untracked,
                                const std::vector<BodyPoses>& tracked,
                                const TrackingParams& params) {
  const ReportedFrames untracked_frames(untracked), tracked_frames(tracked);
  Lives lives(params);
  for (const TruthFrame& frame : truth)
    lives.add(frame.poses, untracked_frames.at(frame.poses.stamp),
              tracked_frames.at(frame.poses.stamp));
  TrackingTally tally;
  for (const Life& life : lives.take()) add_life(life, params, tally);
  return tally;
}

std::vector<Figure> tracking_figures(const TrackingTally& tally) {
  const std::string joints = "resting joints", directions = "resting directions";
  std::vector<Figure> figures = {{"identity_switches",
                                  "identity switches",
                                  tally.identity_switches,
                                  {},
                                  tally.identity_switches,
                                  tally.followed,
                                  "persons followed",
                                  "0"}};
  add_jitter("jitter_median", "mm", "resting joints, jitter median", tally.untracked_joints_mm,
             tally.tracked_joints_mm, median, joints, figures);
  add_jitter("jitter_rms", "mm", "resting joints, jitter RMS", tally.untracked_joints_mm,
             tally.tracked_joints_mm, root_mean_square, joints, figures);
  add_jitter("jitter_step_rms", "mm", "resting joints, step RMS", tally.untracked_steps_mm,
             tally.tracked_steps_mm, root_mean_square, joints, figures);
  add_jitter("pointing_jitter_rms", "degrees", "resting arms, jitter RMS",
             tally.untracked_directions_deg, tally.tracked_directions_deg, root_mean_square,
             directions, figures);
  figures.push_back(figure("lag_median_frames", "moving joints, lag median [frames]",
                           tally.lags_frames, median, "moving joints", "<= 1"));
  figures.push_back(figure(
      "lag_p90_frames", "  p90 [frames]", tally.lags_frames,
      [](const std::vector<double>& values) { return quantile(values, 0.9); }, "moving joints",
      ""));
  return figures;
}

}  // namespace limbcast::evaluate
