#include "common/bounded_map.hpp"

#include <gtest/gtest.h>

#include <string>

namespace limbcast {
namespace {

TEST(BoundedMap, ForgetsWhatWasNotAskedForTheLongest) {
  BoundedMap<int> map(2);
  map.get("front") = 1;
  map.get("back") = 2;
  map.get("front");
  map.get("left") = 3;
  EXPECT_EQ(map.find("back"), nullptr);
  ASSERT_NE(map.find("front"), nullptr);
  EXPECT_EQ(*map.find("front"), 1);
  EXPECT_EQ(map.get("back"), 0) << "begins anew";
}

TEST(BoundedMap, HoldsNoMoreThanItsMostWhateverNamesCome) {
  BoundedMap<int> map;
  for (int i = 0; i < 1000; ++i) map.get("made up " + std::to_string(i), i);
  std::size_t held = 0;
  map.for_each([&held](const std::string& /*name*/, int value) {
    EXPECT_GE(value, 1000 - static_cast<int>(kMostSensors));
    ++held;
  });
  EXPECT_EQ(held, kMostSensors);
}

}  // namespace
}  // namespace limbcast
