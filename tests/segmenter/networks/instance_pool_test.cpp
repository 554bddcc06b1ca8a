#include "modules/segmenter/networks/instance_pool.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace limbcast::segmenter {
namespace {

TEST(InstancePool, ThrowsAtOnceWhatMakingThrows) {
  const auto make = []() -> std::unique_ptr<int> { throw std::runtime_error("unusable"); };
  EXPECT_THROW(InstancePool<int>{make}, std::runtime_error);
}

TEST(InstancePool, MakesTheFirstWhenItIsAskedForWhereItIsToldSo) {
  int num_made = 0;
  InstancePool<int> pool([&] { return std::make_unique<int>(num_made++); },
                         FirstInstance::kWhenAskedFor);
  EXPECT_EQ(num_made, 0);
  EXPECT_EQ(pool.with([](int number) { return number; }), 0);
  EXPECT_EQ(pool.with([](int number) { return number; }), 0);
}

TEST(InstancePool, MakesOneMoreOnlyWhereAllAreAtWork) {
  int num_made = 0;
  InstancePool<int> pool([&] { return std::make_unique<int>(num_made++); });
  const auto number = [](int instance) { return instance; };
  EXPECT_EQ(pool.with(number), 0);
  EXPECT_EQ(pool.with([&](int) { return pool.with(number); }), 1);
  pool.with(number);
  EXPECT_EQ(num_made, 2);
}

}  // namespace
}  // namespace limbcast::segmenter
