#include "common/lcm_io/pace.hpp"

#include <gtest/gtest.h>

#include <limbcast/image_t.hpp>
#include <limbcast/mounting_t.hpp>

#include "common/lcm_io/bus.hpp"

namespace limbcast::lcm_io {
namespace {

using std::chrono::milliseconds;

/// A stage whose results are answered or not, and a clock that goes on when told.
class PaceOfAStage : public ::testing::Test {
 protected:
  void publish(std::int64_t utime, const std::string& sensor = "front") {
    pace_.published(sensor, utime, now_);
  }
  bool may_go_on() { return pace_.may_go_on(now_); }

  Pace pace_;
  Pace::Time now_;
};

TEST_F(PaceOfAStage, IsThatOfTheFramesWhereNobodyAnswers) {
  for (int utime = 0; utime < 1000; ++utime) {
    publish(utime);
    EXPECT_TRUE(may_go_on());
  }
}

TEST_F(PaceOfAStage, KeepsOneResultReadyBesideTheOneThatIsWorkedOn) {
  publish(1);
  pace_.answered("front", 1);
  publish(2);
  EXPECT_TRUE(may_go_on()) << "the next stage will want another one";
  publish(3);
  EXPECT_FALSE(may_go_on()) << "it works on 2, and 3 is ready";
  pace_.answered("front", 2);
  EXPECT_TRUE(may_go_on());
}

TEST_F(PaceOfAStage, CountsWhatTheNextStageSkippedAsDone) {
  publish(1);
  pace_.answered("front", 1);
  publish(2);
  publish(3);
  pace_.answered("front", 3);
  publish(4);
  EXPECT_TRUE(may_go_on());
}

TEST_F(PaceOfAStage, TellsSensorsApart) {
  publish(1, "front");
  pace_.answered("front", 1);
  publish(2, "front");
  publish(2, "rear");
  pace_.answered("left", 2);
  EXPECT_FALSE(may_go_on());
  pace_.answered("rear", 2);
  EXPECT_TRUE(may_go_on());
}

TEST_F(PaceOfAStage, IsFreeAgainOnceTheNextStageHasBeenAwayForLong) {
  publish(1);
  pace_.answered("front", 1);
  publish(2);
  publish(3);
  now_ += Pace::kPatience;
  EXPECT_FALSE(may_go_on());
  now_ += milliseconds(1);
  EXPECT_TRUE(may_go_on());
  for (int utime = 4; utime < 10; ++utime) {
    publish(utime);
    EXPECT_TRUE(may_go_on());
  }
  pace_.answered("front", 8);
  publish(10);
  EXPECT_FALSE(may_go_on()) << "it is back";
}

TEST(BusWithAGate, HoldsTheNewestBackAndHandlesTheRest) {
  /// Ends a test whose message never comes; not a time the test waits otherwise.
  constexpr milliseconds kNever{30000}, kAtOnce{0};
  Bus bus("memq://");
  bool open = false, marker = false;
  int newest = 0;
  bus.set_gate([&] { return open; });
  bus.subscribe<image_t>("IMAGE", Keep::kNewest,
                         [&](const image_t& message) { newest = message.width; });
  bus.subscribe<mounting_t>("MARKER", Keep::kAll, [&](const mounting_t&) { marker = true; });
  for (int i = 1; i <= 3; ++i) {
    image_t message{};
    message.width = i;
    bus.publish("IMAGE", message);
  }
  bus.publish("MARKER", mounting_t{});
  ASSERT_TRUE(bus.handle(kNever));
  EXPECT_TRUE(marker) << "the first that is handled, though the images came before";
  EXPECT_FALSE(bus.handle(kAtOnce));
  EXPECT_EQ(newest, 0);
  open = true;
  ASSERT_TRUE(bus.handle(kNever));
  EXPECT_EQ(newest, 3);
  EXPECT_EQ(bus.skipped(), 2);
}

}  // namespace
}  // namespace limbcast::lcm_io
