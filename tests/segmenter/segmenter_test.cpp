#include "modules/segmenter/segmenter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/segmenter/recorded_frames.hpp"
#include "tests/segmenter/simulated_person.hpp"

namespace limbcast::segmenter {
namespace {

TEST(Segmenter, FindsNobodyInAnEmptyCloud) { EXPECT_TRUE(segment(Cloud{}).segments.empty()); }

TEST(Segmenter, CutsNobodyOutOfAnEmptyCloud) {
  EXPECT_TRUE(Segmenter().cut_out_people(Cloud{}, {{0.0F, 0.0F, 2.0F}}).segments.empty());
}

/// One person each, with a fist, a breast or a knee that is a candidate too.
class RecordedPerson : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string folder = LIMBCAST_DATA_DIR "/stereo_dev/pointing";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    frame_ = FrameReader(folder, DepthFrom::kReconstructor).read(folder + "/" + GetParam());
  }
  LoadedFrame frame_;
};

TEST_P(RecordedPerson, IsOneSegmentThatStartsAtTheHead) {
  const Segments found = segment(frame_.cloud);
  ASSERT_EQ(std::count_if(found.segments.begin(), found.segments.end(),
                          [](const Segment& s) { return s.valid(); }),
            1);
  const Eigen::Vector3f& head_m = frame_.persons.at(0).joints_m.at("head");
  EXPECT_LT((found.segments.front().seed_m - head_m).norm(), 0.20F);
}

TEST_P(RecordedPerson, IsCutOutFromTheHeadDown) {
  const TruePerson& person = frame_.persons.at(0);
  const Segments cut = Segmenter().cut_out_people(frame_.cloud, {person.joints_m.at("head")});
  ASSERT_EQ(cut.segments.size(), 1U);
  const auto truth = cv::countNonZero(frame_.mask == person.mask_index);
  // Nine tenths: the rest are holes of the matcher and the soles, which are cut with the ground.
  EXPECT_GT(static_cast<int>(cut.segments[0].points_m.size()), truth * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(PointingAtTheCamera, RecordedPerson,
                         ::testing::Values("pointing60_0004", "pointing60_0018", "pointing60_0024",
                                           "pointing60_0027"));

/// What a depth camera without colours sees of somebody whose arms are raised to the sides.
class PersonBeforeADepthCamera : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    const simulate::SimulatorParams params = person_in_sight(simulate::SensorKind::kDepth, "T");
    const simulate::SimulatedFrame frame = simulate::simulate_frame(params, GetParam(), 0);
    cloud_ = depth_cloud(params, frame);
    const auto& joints_m = frame.scenario.persons.at(0).skeleton.joints;
    elbow_m_ = joints_m[index(Joint::kElbowLeft)].cast<float>();
    wrist_m_ = joints_m[index(Joint::kWristLeft)].cast<float>();
  }
  /// Nothing is measured around the elbow.
  void part_forearm_from_body(float gap_m) {
    for (Eigen::Vector3f& point_m : cloud_.points_m) {
      if ((point_m - elbow_m_).norm() < gap_m) point_m.setZero();
    }
  }
  std::ptrdiff_t count_hand_points(const std::vector<Eigen::Vector3f>& points_m) const {
    return std::count_if(points_m.begin(), points_m.end(), [&](const Eigen::Vector3f& point_m) {
      return (point_m - wrist_m_).norm() < 0.08F;
    });
  }

  Cloud cloud_;
  Eigen::Vector3f elbow_m_, wrist_m_;
};

TEST_P(PersonBeforeADepthCamera, KeepsAForearmThatHangsInTheAir) {
  part_forearm_from_body(0.12F);
  const std::ptrdiff_t seen = count_hand_points(cloud_.points_m);
  ASSERT_GT(seen, 0);
  const Segments found = segment(cloud_);
  ASSERT_TRUE(found.segments.at(0).valid());
  EXPECT_GT(count_hand_points(found.segments[0].points_m), seen * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(Simulated, PersonBeforeADepthCamera, ::testing::Values(1, 3, 6));

}  // namespace
}  // namespace limbcast::segmenter
