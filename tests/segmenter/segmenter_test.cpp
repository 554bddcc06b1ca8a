#include "modules/segmenter/segmenter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/segmenter/recorded_frames.hpp"

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

}  // namespace
}  // namespace limbcast::segmenter
