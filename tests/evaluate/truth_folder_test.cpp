#include "modules/evaluate/truth_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::evaluate {
namespace {

using ::testing::ElementsAre;

constexpr const char* kTwoPeople = R"({"utime":20,"persons":[
  {"body":"D1_man","joints":{"head":[0,0,2]},"visible":{"head":true}},
  {"body":"D4_woman","joints":{"head":[1,0,2]},"visible":{"head":true}}]})";

TEST(TruthFolder, IsReadInOrderOfTime) {
  const limbcast::test::TemporaryFolder folder;
  folder.write("a_gt.json", kTwoPeople);
  folder.write("b_gt.json", R"({"utime":10,"persons":[]})");
  const auto frames = read_truth_folders({folder.path()});
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].poses.stamp.utime, 10);
  EXPECT_TRUE(frames[1].counts.empty());
}

TEST(TruthFolder, CountsOnlyTheBodiesThatAreAskedFor) {
  const limbcast::test::TemporaryFolder folder;
  folder.write("a_gt.json", kTwoPeople);
  EXPECT_THAT(read_truth_folders({folder.path()}, {"D4", "D5"}).at(0).counts,
              ElementsAre(false, true));
  EXPECT_THROW(read_truth_folders({folder.path()}, {"D9"}), InputError);
}

TEST(TruthFolder, WithoutTruthIsAnError) {
  const limbcast::test::TemporaryFolder folder;
  EXPECT_THROW(read_truth_folders({folder.path()}), InputError);
  EXPECT_THROW(read_truth_folders({folder.path() + "/none"}), InputError);
  folder.write("a_gt.json", "{");
  EXPECT_THROW(read_truth_folders({folder.path()}), InputError);
}

TEST(TruthFolder, WhoseTimesAreAnothersIsRefused) {
  const limbcast::test::TemporaryFolder folder;
  folder.write("a/1_gt.json", R"({"utime":10,"persons":[]})");
  folder.write("b/1_gt.json", R"({"utime":20,"persons":[]})");
  folder.write("b/2_gt.json", R"({"utime":10,"persons":[]})");
  const std::string a = folder.path() + "/a", b = folder.path() + "/b";
  EXPECT_EQ(limbcast::test::error_of<InputError>([&] {
              read_truth_folders({a, b});
            }),
            b + "/2_gt.json: has the same utime (10) as " + a +
                "/1_gt.json, so that one report would count twice; leave out one of the folders or "
                "files");
  EXPECT_THROW(read_truth_folders({a, a}), InputError);
}

TEST(SplitList, DropsEmptyParts) {
  EXPECT_THAT(split_list("a,,b,"), ElementsAre("a", "b"));
  EXPECT_TRUE(split_list("").empty());
}

int judged_arms(const std::string& set, const std::vector<std::string>& bodies) {
  int arms = 0;
  for (const TruthFrame& frame :
       read_truth_folders({LIMBCAST_DATA_DIR "/stereo_dev/" + set}, bodies)) {
    for (std::size_t i = 0; i < frame.poses.persons.size(); ++i) {
      if (frame.counts.empty() || frame.counts[i])
        arms += static_cast<int>(frame.poses.persons[i].pointing.size());
    }
  }
  return arms;
}

TEST(TruthFolder, OfTheRenderedPointingFramesSplitsByBody) {
  if (!std::filesystem::exists(LIMBCAST_DATA_DIR "/stereo_dev/pointing"))
    GTEST_SKIP() << LIMBCAST_DATA_DIR "/stereo_dev/pointing is not there";
  EXPECT_EQ(judged_arms("pointing", {}), 60);  // data/README.md
  EXPECT_EQ(judged_arms("pointing", {"D1", "D2", "D3"}) + judged_arms("pointing", {"D4", "D5"}),
            60);
}

}  // namespace
}  // namespace limbcast::evaluate
