#include "common/lcm_io/status_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace limbcast::lcm_io {
namespace {

TEST(StatusCounter, CountsGapsInTheSequenceOfEachSensor) {
  StatusCounter counter;
  counter.received("front", 1);
  counter.received("back", 10);
  counter.received("front", 2);
  counter.received("front", 5);
  counter.received("back", 11);
  EXPECT_EQ(counter.num_received(), 5);
  EXPECT_EQ(counter.num_gaps(), 2);
}

TEST(StatusCounter, KeepsTheCountOfASensorAmongManyMadeUpNames) {
  StatusCounter counter;
  counter.received("front", 1);
  for (int i = 0; i < 1000; ++i) {
    counter.received("made up " + std::to_string(i), 1);
    if (i % 10 == 0) counter.received("front", 2 + i / 10);
  }
  counter.received("front", 105);  // after 101
  EXPECT_EQ(counter.num_gaps(), 3);
}

TEST(StatusCounter, TakesASequenceThatGoesBackAsARestart) {
  StatusCounter counter;
  counter.received("front", 1000);
  counter.received("front", 0);
  counter.received("front", 1);
  EXPECT_EQ(counter.num_gaps(), 0);
}

TEST(StatusCounter, TakesAFrameThatWasOvertakenAsLateNotLost) {
  StatusCounter counter;
  EXPECT_TRUE(counter.received("front", 5));
  EXPECT_TRUE(counter.received("front", 8));
  EXPECT_EQ(counter.num_gaps(), 2);
  EXPECT_FALSE(counter.received("front", 6));
  EXPECT_TRUE(counter.received("front", 9));
  EXPECT_EQ(counter.num_gaps(), 1);
  EXPECT_EQ(counter.num_late(), 1);
  EXPECT_EQ(counter.num_received(), 3);
}

TEST(StatusCounter, TakesNumbersOfARestartedSourceAsNewAlthoughOnceMissed) {
  StatusCounter counter;
  counter.received("front", 0);
  counter.received("front", 3);
  EXPECT_TRUE(counter.received("front", 0));
  EXPECT_TRUE(counter.received("front", 1));
  EXPECT_TRUE(counter.received("front", 2));
  EXPECT_EQ(counter.num_gaps(), 2);
  EXPECT_EQ(counter.num_late(), 0);
}

TEST(StatusCounter, CountsNoLossWhereTheNumbersAreAnotherSources) {
  StatusCounter counter;
  constexpr std::int64_t kSmallest = std::numeric_limits<std::int64_t>::min(),
                         kLargest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t sequence : {kSmallest, kSmallest + 2, kLargest, std::int64_t{5}})
    EXPECT_TRUE(counter.received("front", sequence));
  EXPECT_EQ(counter.num_gaps(), 1);
  EXPECT_EQ(counter.num_received(), 4);
}

TEST(StatusCounter, TellsRatesAndPercentilesOfThePeriod) {
  constexpr std::int64_t kFrame_us = 1'768'870'000'000'000;
  StatusCounter counter;
  for (int i = 1; i <= 100; ++i) {
    counter.received("front", i);
    counter.published(kFrame_us, kFrame_us + i * 1000);
  }
  EXPECT_EQ(counter.num_published(), 100);
  const StatusCounter::Period period = counter.finish_period(2.0);
  EXPECT_FLOAT_EQ(period.rate_in_hz, 50.0F);
  EXPECT_FLOAT_EQ(period.rate_out_hz, 50.0F);
  EXPECT_FLOAT_EQ(period.latency_p50_ms, 50.0F);
  EXPECT_FLOAT_EQ(period.latency_p99_ms, 99.0F);
  EXPECT_FLOAT_EQ(period.latency_max_ms, 100.0F);
}

TEST(StatusCounter, StartsAfreshWithEachPeriod) {
  StatusCounter counter;
  counter.published(0, 5000);
  counter.failed("camera unplugged");
  EXPECT_TRUE(counter.finish_period(1.0).failing);
  const StatusCounter::Period period = counter.finish_period(1.0);
  EXPECT_FALSE(period.failing);
  EXPECT_FLOAT_EQ(period.rate_out_hz, 0.0F);
  EXPECT_TRUE(std::isnan(period.latency_p50_ms));
  EXPECT_EQ(counter.last_error(), "camera unplugged");
}

}  // namespace
}  // namespace limbcast::lcm_io
