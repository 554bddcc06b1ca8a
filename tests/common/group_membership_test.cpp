#include "common/lcm_io/group_membership.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <chrono>
#include <functional>
#include <limbcast/module_status_t.hpp>
#include <thread>

#include "common/lcm_io/bus.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::lcm_io {
namespace {

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=1";

void plug_in() {
  const auto result =
      test::run({"sh", "-c",
                 "ip link add eth1 type veth peer name far && ip address add 10.0.0.1/24 dev eth1 "
                 "&& ip link set eth1 up && ip route add 224.0.0.0/4 dev eth1"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
}

void unplug() { ASSERT_EQ(test::run({"ip", "link", "delete", "eth1"}).exit_code, 0); }

bool is_member() {
  return test::run({"sh", "-c", "ip maddress show dev eth1 | grep -q 239.255.76.67"}).exit_code ==
         0;
}

/// Tests in a network of their own, that of a thread.
class GroupMembership : public ::testing::Test {
 protected:
  static void on_a_host(const std::function<void()>& body) {
    bool possible = false;
    std::thread([&] {
      possible = unshare(CLONE_NEWNET) == 0;
      if (possible) body();
    }).join();
    if (!possible) GTEST_SKIP() << "needs root and network namespaces";
  }
};

TEST_F(GroupMembership, ComesBackWithItsDevice) {
  on_a_host([] {
    plug_in();
    lcm_io::GroupMembership membership(kUrl);
    membership.renew();
    EXPECT_TRUE(is_member());
    unplug();
    membership.renew();
    plug_in();
    EXPECT_FALSE(is_member());
    membership.renew();
    EXPECT_TRUE(is_member());
  });
}

TEST_F(GroupMembership, ComesBackHoweverOftenTheDeviceGoes) {
  on_a_host([] {
    lcm_io::GroupMembership membership(kUrl);
    constexpr int kMoreThanASocketHolds = 25;
    for (int i = 0; i < kMoreThanASocketHolds; ++i) {
      plug_in();
      membership.renew();
      ASSERT_TRUE(is_member()) << i;
      unplug();
    }
  });
}

TEST_F(GroupMembership, LetsGoOfItsGroupInTheEnd) {
  on_a_host([] {
    plug_in();
    {
      lcm_io::GroupMembership membership(kUrl);
      membership.renew();
      membership.renew();
      EXPECT_TRUE(is_member());
    }
    EXPECT_FALSE(is_member());
  });
}

TEST_F(GroupMembership, IsThatOfABusWhichHearsAgainOnceItsDeviceIsBack) {
  on_a_host([] {
    plug_in();
    Bus listener(kUrl), speaker(kUrl);
    int num_heard = 0;
    listener.subscribe<module_status_t>("STATUS", Keep::kAll,
                                        [&](const module_status_t&) { ++num_heard; });
    unplug();
    plug_in();
    constexpr int kMostMessages = 200;
    for (int i = 0; i < kMostMessages && num_heard == 0; ++i) {
      speaker.publish("STATUS", module_status_t{});
      listener.handle(std::chrono::milliseconds(50));
    }
    EXPECT_GT(num_heard, 0);
  });
}

}  // namespace
}  // namespace limbcast::lcm_io
