#include "modules/reconstructor/calibration_wait.hpp"

#include <gtest/gtest.h>

namespace limbcast::reconstructor {
namespace {

using namespace std::chrono_literals;

TEST(CalibrationWait, IsTooLongWhereNoneCameThreeTimesForOneCamera) {
  const CalibrationWait::Clock::time_point start{};
  CalibrationWait wait;
  EXPECT_FALSE(wait.is_too_long("front", start));
  EXPECT_FALSE(wait.is_too_long("front", start + 2900ms));
  EXPECT_TRUE(wait.is_too_long("front", start + 3100ms));
  EXPECT_FALSE(wait.is_too_long("back", start + 3100ms));
}

}  // namespace
}  // namespace limbcast::reconstructor
