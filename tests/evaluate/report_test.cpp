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
