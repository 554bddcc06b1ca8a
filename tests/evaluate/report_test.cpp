#include "modules/evaluate/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "modules/evaluate/picture.hpp"
#include "tests/evaluate/figure.hpp"

namespace limbcast::evaluate {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

const Figure& figure(const Report& report, const std::string& key) {
  const auto found = std::find_if(report.figures.begin(), report.figures.end(),
                                  [&key](const Figure& candidate) { return candidate.key == key; });
  if (found == report.figures.end()) throw std::out_of_range(key);
  return *found;
}

/// Ten pointing people: eight exact, one 17 and one 30 degrees off.
Tally ten_people() {
  std::vector<TruthFrame> truth;
  std::vector<BodyPoses> reported;
  for (int i = 0; i < 10; ++i) {
    truth.push_back({frame({pointing_figure()}, i), {}});
    const float off_deg = i == 8 ? 17.0F : i == 9 ? 30.0F : 0.0F;
    reported.push_back(frame({pointing_figure(off_deg)}, i));
  }
  return evaluate(truth, reported);
}

TEST(Report, TellsSharesWithTheirBasis) {
  const Report report = make_report(ten_people());
  const Figure& right = figure(report, "pointing_right_percent");
  EXPECT_DOUBLE_EQ(*right.value, 80.0);
  EXPECT_EQ(right.count, 8);
  EXPECT_EQ(right.total, 10);
  EXPECT_LT(right.interval->low, 80.0);
  EXPECT_GT(right.interval->high, 80.0);
  EXPECT_DOUBLE_EQ(*figure(report, "wrong_reported_percent").value, 10.0);
  EXPECT_DOUBLE_EQ(*figure(report, "joints_within_10cm_percent").value, 100.0);
  EXPECT_EQ(figure(report, "joints_within_10cm_percent").total, 160);
}

TEST(Report, TellsMedianAndP90) {
  const Report report = make_report(ten_people());
  EXPECT_NEAR(*figure(report, "pointing_median_deg").value, 0.0, 1e-4);
  EXPECT_NEAR(*figure(report, "pointing_p90_deg").value, 18.3, 1e-3);  // 17 + 0.1 * (30 - 17)
}

TEST(Report, HasNoValueWhereNothingWasMeasured) {
  const Tally nothing = evaluate({}, {});
  const Report report = make_report(nothing);
  EXPECT_FALSE(figure(report, "pointing_right_percent").value);
  EXPECT_FALSE(figure(report, "pointing_median_deg").value);
  EXPECT_THAT(report_text(report, nothing, 10), HasSubstr("0 frames with truth"));
  const auto json = nlohmann::json::parse(report_json(report, nothing));
  EXPECT_TRUE(json["figures"]["pointing_median_deg"]["value"].is_null());
}

TEST(Report, ShowsTheWorstFindingsFirst) {
  const Tally tally = ten_people();
  const std::string text = report_text(make_report(tally), tally, 1);
  EXPECT_THAT(text, HasSubstr("direction off 30.00"));
  EXPECT_THAT(text, Not(HasSubstr("direction inexact")));
}

TEST(Report, HoldsTheSameInJson) {
  const Tally tally = ten_people();
  const auto json = nlohmann::json::parse(report_json(make_report(tally), tally));
  EXPECT_EQ(json["frames"], 10);
  EXPECT_EQ(json["figures"]["pointing_right_percent"]["value"], 80.0);
  EXPECT_EQ(json["joints"]["head"]["within_10cm_percent"]["total"], 10);
  EXPECT_EQ(json["findings"].size(), 2U);
}

/// Every figure by hand, none like another.
Tally known_tally() {
  Tally tally;
  tally.frames = 4;
  tally.frames_not_reported = 1;
  tally.empty_frames = 2;
  tally.found = {3, 4};
  tally.reported = 8;
  tally.invented = 1;
  tally.twice = 2;
  tally.invented_in_empty_frames = 1;
  tally.pointing_right = {1, 2};
  tally.pointing_reported = 9;
  tally.wrong_direction = 4;
  tally.wrong_side = 0;
  tally.said_to_point = {1, 5};
  tally.told_arms_off = {1, 8};
  tally.pointing_errors_deg = {1.0, 3.0};
  tally.forearm_errors_deg = {6.0};
  tally.head_hand_errors_deg = {7.0};
  tally.within_limit[index(Joint::kElbowLeft)] = {1, 3};
  tally.within_limit[index(Joint::kElbowRight)] = {1, 1};
  tally.joint_errors_m[index(Joint::kElbowLeft)] = {0.05, 0.15};
  tally.joint_errors_m[index(Joint::kElbowRight)] = {0.02};
  tally.joint_errors_by_person_m = {{0.05, 0.02}, {0.15}};
  tally.joint_confidences = {{0.92, 1.0}};
  tally.findings = {{5, 1, 2, "direction inexact", 12.0},
                    {6, -1, 0, "not found", 0.0},
                    {7, 3, -1, "invented", 0.0},
                    {8, 0, 0, "direction off", 25.0},
                    {9, 0, 0, "direction off", 40.0}};
  return tally;
}

TEST(Report, HasTheValuesOfTheTally) {
  const Report report = make_report(known_tally());
  const auto expect = [&](const std::string& key, double value, int count, int total) {
    const Figure& found = figure(report, key);
    ASSERT_TRUE(found.value) << key;
    EXPECT_NEAR(*found.value, value, 1e-9) << key;
    EXPECT_EQ(found.count, count) << key;
    EXPECT_EQ(found.total, total) << key;
  };
  expect("pointing_right_percent", 50.0, 1, 2);
  expect("wrong_reported_percent", 87.5, 7, 8);
  expect("wrong_direction", 4.0, 4, 9);
  expect("wrong_side", 0.0, 0, 9);
  expect("invented", 1.0, 1, 8);
  expect("twice", 2.0, 2, 8);
  expect("pointing_median_deg", 2.0, 0, 2);
  expect("pointing_p90_deg", 2.8, 0, 2);
  expect("forearm_median_deg", 6.0, 0, 1);
  expect("head_hand_p90_deg", 7.0, 0, 1);
  expect("said_to_point_percent", 20.0, 1, 5);
  expect("told_arms_off_percent", 12.5, 1, 8);
  expect("joints_within_10cm_percent", 50.0, 2, 4);
  expect("elbows_within_10cm_percent", 50.0, 2, 4);
  expect("joints_reported_percent", 75.0, 3, 4);
  expect("joint_error_mean_cm", 22.0 / 3.0, 0, 3);
  expect("people_found_percent", 75.0, 3, 4);
  expect("invented_in_empty_frames", 1.0, 1, 2);
  EXPECT_NEAR(*report.joints_error[index(Joint::kElbowLeft)].value, 10.0, 1e-9);
  EXPECT_NEAR(*report.joints_error[index(Joint::kElbowRight)].value, 2.0, 1e-9);
}

TEST(Report, ReadsAsATable) {
  const Tally tally = known_tally();
  const std::string text = report_text(make_report(tally), tally, 10);
  EXPECT_THAT(text, HasSubstr("4 frames with truth, 1 of them not reported\n"));
  EXPECT_THAT(text, ContainsRegex("postures right \\[%\\] +50.0 +9.5 to 90.5 +>= 98 +"
                                  "1 of 2 visible pointing arms\n"));
  EXPECT_THAT(text, ContainsRegex("direction off > 20 degrees +4 +9 directions reported\n"));
  EXPECT_THAT(text, ContainsRegex("pointing, arm axis median \\[degrees\\] +2.0 +1.0 to 3.0 +"
                                  "<= 1.5 +2 directions reported\n"));
  EXPECT_THAT(text, ContainsRegex("\njoint +within 10 cm +mean error +visible\n"));
  EXPECT_THAT(text, ContainsRegex("\nelbow_left +33.3 % +10.0 cm +3\n"));
  EXPECT_THAT(text, ContainsRegex("\nhead +- % +- cm +0\n"));
  EXPECT_THAT(text, ContainsRegex("share within\n  stated +0.920  measured +1.000  \\(1\\)\n"));
}

TEST(Report, ListsFirstWhatARobotWouldActOnWrongly) {
  const Tally tally = known_tally();
  EXPECT_THAT(report_text(make_report(tally), tally, 10),
              HasSubstr("degrees or metres)\n"
                        "  7  -1   3  invented 0.00\n"
                        "  9   0   0  direction off 40.00\n"
                        "  8   0   0  direction off 25.00\n"
                        "  6   0  -1  not found 0.00\n"
                        "  5   2   1  direction inexact 12.00\n"));
  EXPECT_THAT(report_text(make_report(tally), tally, 0), Not(HasSubstr("worst findings")));
}

TEST(Report, HoldsIntervalsBandsAndFindingsInJson) {
  const Tally tally = known_tally();
  const auto json = nlohmann::json::parse(report_json(make_report(tally), tally));
  const auto& right = json["figures"]["pointing_right_percent"];
  EXPECT_NEAR(right["low"].get<double>(), 9.45, 0.01);
  EXPECT_NEAR(right["high"].get<double>(), 90.55, 0.01);
  EXPECT_EQ(right["count"], 1);
  EXPECT_EQ(right["total_of"], "visible pointing arms");
  EXPECT_TRUE(json["figures"]["wrong_side"]["low"].is_null());
  EXPECT_EQ(json["calibration"]["joint_confidence"],
            nlohmann::json::parse(
                R"([{"from": 0.9, "to": 0.95, "count": 1, "stated": 0.92, "measured": 1.0}])"));
  EXPECT_EQ(json["findings"][0], nlohmann::json::parse(R"({"utime": 5, "truth": 2, "report": 1,
                                      "what": "direction inexact", "figure": 12.0})"));
}

TEST(ProbabilityBands, CompareStatedWithWhatCameTrue) {
  const std::vector<Stated> values = {{0.9, 1.0}, {0.94, 1.0}, {0.92, 0.0}, {0.2, 0.0}, {1.0, 1.0}};
  const auto bands = probability_bands(values, {0.0, 0.5, 0.9, 0.95, 1.0});
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[1].count, 3);
  EXPECT_NEAR(bands[1].stated, 0.92, 1e-9);
  EXPECT_NEAR(bands[1].measured, 2.0 / 3.0, 1e-9);
  EXPECT_EQ(bands[2].count, 1);  // 1 itself belongs to the last band
}

TEST(SigmaBands, CompareStatedWithTheRootMeanSquare) {
  const auto bands = sigma_bands({{2.0, 3.0}, {2.0, 1.0}}, {0.0, 1.0, 5.0});
  ASSERT_EQ(bands.size(), 1U);
  EXPECT_NEAR(bands[0].measured, std::sqrt(5.0), 1e-9);
}

TEST(ErrorDistribution, IsDrawnInColourAlsoForNothing) {
  const cv::Mat nothing = draw_error_distribution(evaluate({}, {}));
  const cv::Mat something = draw_error_distribution(ten_people());
  EXPECT_EQ(something.type(), CV_8UC3);
  EXPECT_EQ(something.size(), nothing.size());
  EXPECT_GT(cv::norm(something, nothing), 0.0);
}

}  // namespace
}  // namespace limbcast::evaluate
