#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sources/capture_time.hpp"
#include "common/sources/pacer.hpp"
#include "common/sources/pair_matcher.hpp"

namespace limbcast {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

TEST(CaptureTime, UsesTheDriversStampByEitherClock) {
  const Clocks now{1'700'000'000'000'000, 5'000'000'000};
  EXPECT_EQ(capture_utime(now.monotonic_us - 30'000, now), now.utime - 30'000);
  EXPECT_EQ(capture_utime(now.utime - 30'000, now), now.utime - 30'000);
}

TEST(CaptureTime, IsTheMomentOfReadingWhereTheDriverTellsNonsense) {
  const Clocks now{1'700'000'000'000'000, 5'000'000'000};
  for (const std::int64_t driver_us : {std::int64_t{0}, now.monotonic_us + 50'000, now.utime + 1}) {
    EXPECT_EQ(capture_utime(driver_us, now), now.utime);
  }
}

class PairMatcherTest : public ::testing::Test {
 protected:
  void first_at(std::int64_t utime) { matcher_.add_first({utime, {}}); }
  void second_at(std::int64_t utime) { matcher_.add_second({utime, {}}); }
  std::vector<std::int64_t> pairs() {
    std::vector<std::int64_t> utimes;
    while (const auto pair = matcher_.take()) utimes.push_back(pair->utime);
    return utimes;
  }
  PairMatcher matcher_{10'000};
};

TEST_F(PairMatcherTest, PairsWhatWasTakenTogether) {
  for (const std::int64_t utime : {0, 33'000, 66'000}) {
    first_at(utime);
    second_at(utime + 2'000);
  }
  EXPECT_THAT(pairs(), ElementsAre(1'000, 34'000, 67'000));
  EXPECT_EQ(matcher_.unpaired(), 0);
}

TEST_F(PairMatcherTest, DropsAndCountsWhatHasNoPartner) {
  for (const std::int64_t utime : {0, 33'000, 66'000}) first_at(utime);
  for (const std::int64_t utime : {-40'000, 34'000, 64'000}) second_at(utime);
  EXPECT_THAT(pairs(), ElementsAre(33'500, 65'000));
  EXPECT_EQ(matcher_.unpaired(), 2);
}

TEST_F(PairMatcherTest, PrefersTheNearerOfTwoInTolerance) {
  first_at(0);
  first_at(9'000);
  second_at(8'000);
  EXPECT_THAT(pairs(), ElementsAre(8'500));
  EXPECT_EQ(matcher_.unpaired(), 1);
}

TEST_F(PairMatcherTest, WaitsForThePartner) {
  first_at(0);
  EXPECT_THAT(pairs(), ElementsAre());
  second_at(1'000);
  EXPECT_THAT(pairs(), ElementsAre(500));
}

TEST_F(PairMatcherTest, HoldsFewFramesWhereOneCameraIsSilent) {
  for (int i = 0; i < 1000; ++i) first_at(i);
  EXPECT_GT(matcher_.unpaired(), 900);
}

class PacerTest : public ::testing::Test {
 protected:
  Pacer::Clock::time_point start_ = Pacer::Clock::now();
};

TEST_F(PacerTest, KeepsTheRecordedPace) {
  Pacer pacer(0.0);
  EXPECT_EQ(pacer.due(1'000'000, start_), start_);
  EXPECT_EQ(pacer.due(1'100'000, start_), start_ + milliseconds(100));
  EXPECT_EQ(pacer.due(1'150'000, start_ + milliseconds(110)), start_ + milliseconds(150));
}

TEST_F(PacerTest, KeepsTheRateThatIsAskedFor) {
  Pacer pacer(4.0);
  pacer.due(0, start_);
  EXPECT_EQ(pacer.due(1, start_), start_ + milliseconds(250));
  EXPECT_EQ(pacer.due(2, start_), start_ + milliseconds(500));
}

TEST_F(PacerTest, DoesNotHurryAfterAFrameThatIsLate) {
  Pacer pacer(10.0);
  pacer.due(0, start_);
  EXPECT_EQ(pacer.due(1, start_ + milliseconds(700)), start_ + milliseconds(700));
  EXPECT_EQ(pacer.due(2, start_ + milliseconds(700)), start_ + milliseconds(800));
}

TEST_F(PacerTest, TakesALongPauseAsACut) {
  Pacer pacer(0.0);
  pacer.due(0, start_);
  EXPECT_EQ(pacer.due(3'600'000'000, start_), start_ + milliseconds(5000));
}

}  // namespace
}  // namespace limbcast
