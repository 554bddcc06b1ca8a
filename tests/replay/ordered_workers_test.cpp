#include "modules/replay/ordered_workers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace limbcast::replay {
namespace {

TEST(OrderedWorkers, HandBackResultsInTheOrderOfTheTasks) {
  OrderedWorkers<int> workers(3);
  std::promise<void> go;
  const std::shared_future<void> gone(go.get_future());
  // The first task ends last.
  workers.add([gone] {
    gone.wait();
    return 0;
  });
  std::promise<void> second_done;
  workers.add([&] {
    second_done.set_value();
    return 1;
  });
  second_done.get_future().wait();
  go.set_value();
  for (int i = 2; i < 100; ++i) workers.add([i] { return i; });
  EXPECT_EQ(workers.pending(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(workers.take(), i);
  EXPECT_EQ(workers.pending(), 0U);
}

TEST(OrderedWorkers, ThrowWhatATaskThrew) {
  OrderedWorkers<int> workers(1);
  workers.add([]() -> int { throw std::runtime_error("no"); });
  workers.add([] { return 7; });
  EXPECT_THROW(workers.take(), std::runtime_error);
  EXPECT_EQ(workers.take(), 7);
}

TEST(OrderedWorkers, EndWithTasksLeft) {
  OrderedWorkers<int> workers(2);
  for (int i = 0; i < 50; ++i) workers.add([i] { return i; });
}

}  // namespace
}  // namespace limbcast::replay
