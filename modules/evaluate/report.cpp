#include "modules/evaluate/report.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::evaluate {
namespace {

Figure percent(const std::string& key, const std::string& title, const Share& share,
               const std::string& total_of, const std::string& goal = "") {
  Figure figure{key, title, {}, {}, share.count, share.total, total_of, goal};
  if (share.total > 0) figure.value = 100.0 * share.count / share.total;
  if (const auto interval = wilson_interval(share.count, share.total))
    figure.interval = Interval{100.0 * interval->low, 100.0 * interval->high};
  return figure;
}

Figure number(const std::string& key, const std::string& title, int count, int total,
              const std::string& total_of, const std::string& goal = "") {
  return {key, title, count, {}, count, total, total_of, goal};
}

Figure statistic(const std::string& key, const std::string& title,
                 const std::vector<std::vector<double>>& groups, const Statistic& function,
                 const std::string& total_of, const std::string& goal = "") {
  std::vector<double> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  return {key,
          title,
          function(all),
          bootstrap_interval(groups, function),
          0,
          static_cast<int>(all.size()),
          total_of,
          goal};
}

std::vector<std::vector<double>> singles(const std::vector<double>& values) {
  std::vector<std::vector<double>> groups;
  groups.reserve(values.size());
  for (const double value : values) groups.push_back({value});
  return groups;
}

std::vector<std::vector<double>> in_cm(std::vector<std::vector<double>> groups_m) {
  for (auto& group : groups_m)
    for (double& value : group) value *= 100.0;
  return groups_m;
}

const Statistic kMean = [](const std::vector<double>& values) { return mean(values); };
const Statistic kMedian = [](const std::vector<double>& values) { return quantile(values, 0.5); };
const Statistic kP90 = [](const std::vector<double>& values) { return quantile(values, 0.9); };

Share all_joints(const Tally& tally) {
  Share sum;
  for (const Share& share : tally.within_limit) {
    sum.count += share.count;
    sum.total += share.total;
  }
  return sum;
}

Share reported_joints(const Tally& tally) {
  Share sum;
  for (int i = 0; i < kJointCount; ++i) {
    sum.count += static_cast<int>(tally.joint_errors_m[i].size());
    sum.total += tally.within_limit[i].total;
  }
  return sum;
}

Share both_sides(const Tally& tally, Joint left) {
  const Share &l = tally.within_limit[index(left)], &r = tally.within_limit[index(left) + 1];
  return {l.count + r.count, l.total + r.total};
}

void add_pointing(const Tally& tally, std::vector<Figure>& figures) {
  figures.push_back(percent("pointing_right_percent", "postures right [%]", tally.pointing_right,
                            "visible pointing arms", ">= 98"));
  figures.push_back(percent("wrong_reported_percent", "wrong reported [%]",
                            {tally.wrong_reported(), tally.reported}, "reported persons",
                            "<= 0.1"));
  const int reported = tally.reported;
  figures.push_back(number("wrong_direction", "  direction off > 20 degrees", tally.wrong_direction,
                           tally.pointing_reported, "directions reported"));
  figures.push_back(number("wrong_side", "  wrong arm", tally.wrong_side, tally.pointing_reported,
                           "directions reported"));
  figures.push_back(
      number("invented", "  person where none is", tally.invented, reported, "reported persons"));
  figures.push_back(
      number("twice", "  person reported twice", tally.twice, reported, "reported persons"));
  const auto direction = [&](const std::string& key, const std::string& title,
                             const std::vector<double>& errors, const std::string& goal_median,
                             const std::string& goal_p90) {
    const std::string total_of = "directions reported";
    figures.push_back(statistic(key + "_median_deg", title + " median [degrees]", singles(errors),
                                kMedian, total_of, goal_median));
    figures.push_back(statistic(key + "_p90_deg", title + " p90 [degrees]", singles(errors), kP90,
                                total_of, goal_p90));
  };
  direction("pointing", "pointing, arm axis", tally.pointing_errors_deg, "<= 1.5", "<= 4");
  direction("forearm", "pointing, forearm", tally.forearm_errors_deg, "", "");
  direction("head_hand", "pointing, head to hand", tally.head_hand_errors_deg, "", "");
  figures.push_back(percent("said_to_point_percent", "not pointing but said to [%]",
                            tally.said_to_point, "found persons with resting arms", "<= 1"));
  figures.push_back(percent("told_arms_off_percent", "told arms that are elsewhere [%]",
                            tally.told_arms_off, "directions told of known arms"));
}

void add_joints(const Tally& tally, std::vector<Figure>& figures) {
  const std::string visible = "visible joints";
  figures.push_back(percent("joints_within_10cm_percent", "joints within 10 cm [%]",
                            all_joints(tally), visible, ">= 95"));
  figures.push_back(percent("elbows_within_10cm_percent", "  elbows [%]",
                            both_sides(tally, Joint::kElbowLeft), visible, ">= 92"));
  figures.push_back(percent("wrists_within_10cm_percent", "  wrists [%]",
                            both_sides(tally, Joint::kWristLeft), visible, ">= 90"));
  figures.push_back(
      percent("joints_reported_percent", "joints reported [%]", reported_joints(tally), visible));
  figures.push_back(statistic("joint_error_mean_cm", "mean error of joints [cm]",
                              in_cm(tally.joint_errors_by_person_m), kMean,
                              "reported visible joints", "<= 4 stereo, <= 2.5 depth"));
}

void add_people(const Tally& tally, std::vector<Figure>& figures) {
  figures.push_back(percent("people_found_percent", "people found [%]", tally.found,
                            "people with 3 or more visible joints", ">= 97"));
  figures.push_back(number("invented_in_empty_frames", "poses in frames without people",
                           tally.invented_in_empty_frames, tally.empty_frames,
                           "frames without people", "0"));
}

template <class Measured>
std::vector<CalibrationBand> bands(const std::vector<Stated>& values,
                                   const std::vector<double>& limits, const Measured& measured) {
  std::vector<CalibrationBand> result;
  for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
    CalibrationBand band{limits[i], limits[i + 1], 0, 0.0, 0.0};
    const bool last = i + 2 == limits.size();
    std::vector<Stated> inside;
    for (const Stated& value : values) {
      if (value.stated >= band.from &&
          (value.stated < band.to || (last && value.stated <= band.to)))
        inside.push_back(value);
    }
    if (inside.empty()) continue;
    band.count = static_cast<int>(inside.size());
    for (const Stated& value : inside) band.stated += value.stated / band.count;
    band.measured = measured(inside);
    result.push_back(band);
  }
  return result;
}

}  // namespace

std::vector<CalibrationBand> probability_bands(const std::vector<Stated>& values,
                                               const std::vector<double>& limits) {
  return bands(values, limits, [](const std::vector<Stated>& inside) {
    double sum = 0.0;
    for (const Stated& value : inside) sum += value.measured;
    return sum / static_cast<double>(inside.size());
  });
}

std::vector<CalibrationBand> sigma_bands(const std::vector<Stated>& values,
                                         const std::vector<double>& limits) {
  return bands(values, limits, [](const std::vector<Stated>& inside) {
    double sum = 0.0;
    for (const Stated& value : inside) sum += value.measured * value.measured;
    return std::sqrt(sum / static_cast<double>(inside.size()));
  });
}

Report make_report(const Tally& tally) {
  Report report;
  add_pointing(tally, report.figures);
  add_joints(tally, report.figures);
  add_people(tally, report.figures);
  for (int i = 0; i < kJointCount; ++i) {
    const std::string name(kJointNames[i]);
    report.joints_within.push_back(percent(name, name, tally.within_limit[i], "visible joints"));
    report.joints_error.push_back(statistic(name, name, in_cm(singles(tally.joint_errors_m[i])),
                                            kMean, "reported visible joints"));
  }
  const std::vector<double> shares = {0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 1.0};
  const double no_limit = 1e9;
  const auto add = [&report](const std::string& key, const std::string& title,
                             std::vector<CalibrationBand> found) {
    if (!found.empty()) report.calibration.push_back({key, title, std::move(found)});
  };
  add("joint_confidence", "joints: stated probability of 10 cm, share within",
      probability_bands(tally.joint_confidences, shares));
  add("joint_sigma_m", "joints: stated sigma [m], root mean square error",
      sigma_bands(tally.joint_sigmas, {0.0, 0.01, 0.02, 0.03, 0.05, 0.1, no_limit}));
  add("pointing_confidence", "pointing: stated probability, share right",
      probability_bands(tally.pointing_confidences, shares));
  add("pointing_sigma_deg", "pointing: stated sigma [degrees], root mean square error",
      sigma_bands(tally.pointing_sigmas, {0.0, 1.0, 2.0, 3.0, 5.0, 10.0, no_limit}));
  return report;
}

}  // namespace limbcast::evaluate
