#include "modules/doctor/host_facts.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/child_process.hpp"

namespace limbcast::doctor {
namespace {

namespace fs = std::filesystem;

/// A copy of /proc and /sys with the files that a test writes.
class ReadHostFacts : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  /// Destination, flags (1: up), metric and mask as the kernel writes them: hexadecimal, little end
  /// first.
  void write_routes(const std::string& lines) const {
    write("proc/net/route",
          "Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\t\tMTU\tWindow\tIRTT\n" +
              lines);
  }
  HostFacts read() const { return read_host_facts(root_, "239.255.76.67"); }

  const fs::path root_ = test::temporary_folder("root");
};

constexpr const char* kDefaultByEth0 =
    "eth0\t00000000\t010200C0\t0003\t0\t0\t100\t00000000\t0\t0\t0\n";

TEST_F(ReadHostFacts, FindsTheMulticastRouteBesideTheDefaultRoute) {
  write_routes(std::string(kDefaultByEth0) +
               "eth1\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n");
  const HostFacts facts = read();
  ASSERT_TRUE(facts.multicast_route);
  EXPECT_EQ(facts.multicast_route->interface, "eth1");
  EXPECT_EQ(facts.multicast_route->prefix_length, 4);
  EXPECT_EQ(facts.default_interface, "eth0");
}

TEST_F(ReadHostFacts, TakesTheDefaultRouteOfTheLowestMetricWhereThereIsNoOther) {
  write_routes("wlan0\t00000000\t010200C0\t0003\t0\t0\t600\t00000000\t0\t0\t0\n" +
               std::string(kDefaultByEth0));
  const HostFacts facts = read();
  ASSERT_TRUE(facts.multicast_route);
  EXPECT_EQ(facts.multicast_route->interface, "eth0");
  EXPECT_EQ(facts.multicast_route->prefix_length, 0);
}

TEST_F(ReadHostFacts, FindsNoRouteInAnEmptyTable) {
  write_routes("");
  EXPECT_FALSE(read().multicast_route);
}

TEST_F(ReadHostFacts, ReadsDevicesLimitsCountersAndGovernors) {
  write("sys/class/net/eth0/flags", "0x1003\n");
  write("sys/class/net/eth0/carrier", "1\n");
  write("sys/class/net/lo/flags", "0x9\n");
  write("proc/sys/net/core/rmem_max", "212992\n");
  write("proc/sys/net/ipv4/ipfrag_time", "30\n");
  write("proc/net/snmp",
        "Ip: Forwarding ReasmFails\nIp: 1 7\nUdp: InDatagrams RcvbufErrors\nUdp: 100 3\n");
  write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave\n");
  write("sys/devices/system/cpu/online", "0\n");
  const HostFacts facts = read();
  ASSERT_EQ(facts.interfaces.size(), 2U);
  EXPECT_EQ(facts.interfaces[0].name, "eth0");
  EXPECT_TRUE(facts.interfaces[0].up && facts.interfaces[0].multicast &&
              facts.interfaces[0].carrier);
  EXPECT_FALSE(facts.interfaces[1].multicast || facts.interfaces[1].carrier);
  EXPECT_EQ(facts.rmem_max, 212992);
  EXPECT_FALSE(facts.rmem_default);
  EXPECT_EQ(facts.ipfrag_time_s, 30);
  EXPECT_EQ(facts.failed_reassemblies, 7);
  EXPECT_EQ(facts.full_buffer_drops, 3);
  EXPECT_EQ(facts.cpu_governors, std::vector<std::string>{"powersave"});
}

}  // namespace
}  // namespace limbcast::doctor
