#include "modules/pose_fitter/pose_fitter.hpp"

#include <gtest/gtest.h>

#include "modules/pose_fitter/company.hpp"
#include "modules/pose_fitter/same_person.hpp"
#include "tests/pose_fitter/synthetic_figure.hpp"

namespace limbcast::pose_fitter {
namespace {

BodyPose body_at(std::int32_t id, float x_m, float confidence) {
  BodyPose body;
  body.id = id;
  body.confidence = confidence;
  const std::pair<Joint, Eigen::Vector3f> joints[] = {
      {Joint::kNeck, {x_m, -0.4F, 3.0F}},
      {Joint::kPelvis, {x_m, 0.2F, 3.0F}},
      {Joint::kShoulderLeft, {x_m + 0.2F, -0.3F, 3.0F}},
      {Joint::kShoulderRight, {x_m - 0.2F, -0.3F, 3.0F}}};
  for (const auto& [joint, position] : joints) {
    body[joint].valid = true;
    body[joint].position_m = position;
  }
  return body;
}

std::vector<std::int32_t> ids(const std::vector<BodyPose>& persons) {
  std::vector<std::int32_t> found;
  for (const BodyPose& person : persons) found.push_back(person.id);
  return found;
}

TEST(DoubtfulPeople, AreToldBesideASurePersonOnly) {
  const PersonCandidate doubtful{body_at(1, 0.0F, 0.6F), true};
  const PersonCandidate sure{body_at(2, 1.0F, 0.95F)}, hardly{body_at(3, 1.0F, 0.8F)};
  EXPECT_EQ(ids(leave_out_doubtful({doubtful, sure})), (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(ids(leave_out_doubtful({doubtful, hardly})), (std::vector<std::int32_t>{3}));
  EXPECT_TRUE(leave_out_doubtful({doubtful, doubtful}).empty());
}

TEST(DoubleReports, KeepTheMoreConfidentOfTwoInOnePlace) {
  std::vector<BodyPose> persons = {body_at(1, 0.0F, 0.5F), body_at(2, 0.1F, 0.9F),
                                   body_at(3, 1.0F, 0.2F)};
  remove_double_reports(persons);
  EXPECT_EQ(ids(persons), (std::vector<std::int32_t>{2, 3}));
}

TEST(DoubleReports, KeepPeopleWhoStandSideBySide) {
  std::vector<BodyPose> persons = {body_at(1, 0.0F, 0.5F), body_at(2, 0.4F, 0.9F)};
  remove_double_reports(persons);
  EXPECT_EQ(persons.size(), 2U);
}

TEST(DoubleReports, KnowABodyThatWasFittedBackToFront) {
  BodyPose flipped = body_at(2, 0.0F, 0.4F);
  std::swap(flipped[Joint::kShoulderLeft], flipped[Joint::kShoulderRight]);
  EXPECT_TRUE(same_place(body_at(1, 0.0F, 0.5F), flipped));
}

TEST(DoubleReports, KnowABodyThatShrankToAHeadAndAnArm) {
  BodyPose shrunk = body_at(2, 0.15F, 0.6F);
  shrunk[Joint::kNeck].position_m = {0.15F, -0.1F, 3.0F};
  shrunk[Joint::kPelvis].position_m = {0.3F, 0.0F, 3.0F};
  EXPECT_TRUE(same_place(body_at(1, 0.0F, 0.99F), shrunk));
  EXPECT_TRUE(same_place(shrunk, body_at(1, 0.0F, 0.99F)));
}

TEST(DoubleReports, KnowALapThatWasTakenForSomebody) {
  BodyPose lap = body_at(2, 0.0F, 0.45F);
  lap[Joint::kNeck].position_m = {0.0F, 0.15F, 2.8F};
  lap[Joint::kChest].valid = true;
  lap[Joint::kChest].position_m = {0.0F, 0.25F, 2.67F};
  lap[Joint::kPelvis].position_m = {0.0F, 0.4F, 2.57F};
  EXPECT_TRUE(same_place(body_at(1, 0.0F, 0.99F), lap));
}

TEST(DoubleReports, KeepAChildBeforeAnAdult) {
  BodyPose child = body_at(2, 0.0F, 0.9F);
  for (JointEstimate& joint : child.joints) joint.position_m += Eigen::Vector3f(0.0F, 0.4F, -0.4F);
  EXPECT_FALSE(same_place(body_at(1, 0.0F, 0.9F), child));
}

TEST(DoubleReports, CompareHeadsWhereNoTrunkIsShared) {
  BodyPose a, b;
  a[Joint::kHead].valid = b[Joint::kHead].valid = true;
  b[Joint::kHead].position_m.x() = 0.1F;
  EXPECT_TRUE(same_place(a, b));
  b[Joint::kHead].position_m.x() = 0.5F;
  EXPECT_FALSE(same_place(a, b));
}

TEST(PoseFitter, FitsEachValidSegmentOnceInTheirOrder) {
  PoseFitterOptions options;
  options.method = "paper";
  const HumanModel model = load_human_model();
  Segments segments;
  for (const float x_m : {0.8F, -0.8F}) {
    FigureOptions figure_options;
    figure_options.head_m.x() = x_m;
    Figure figure = make_figure(model, 0, figure_options);
    figure.segment.id = static_cast<std::int32_t>(segments.segments.size()) + 5;
    segments.stamp = figure.stamp;
    segments.segments.push_back(figure.segment);
  }
  Segment twice = segments.segments[0];
  twice.id = 7;
  Segment rejected = segments.segments[1];
  rejected.rejected_by = SegmentFilter::kTooSparse;
  segments.segments.push_back(twice);
  segments.segments.push_back(rejected);
  EXPECT_EQ(ids(PoseFitter(options).fit(segments).persons), (std::vector<std::int32_t>{5, 6}));
}

TEST(PoseFitter, FindsNobodyWhereNoSegmentIs) { EXPECT_TRUE(PoseFitter().fit({}).persons.empty()); }

}  // namespace
}  // namespace limbcast::pose_fitter
