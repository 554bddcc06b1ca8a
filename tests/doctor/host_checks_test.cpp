#include "modules/doctor/host_checks.hpp"

#include <gtest/gtest.h>

namespace limbcast::doctor {
namespace {

const UrlFacts kThisHost{"udpm://239.255.76.67:7667?ttl=0", "239.255.76.67", 0, 4'000'000, false};
const UrlFacts kNetwork{"udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4000000", "239.255.76.67", 1,
                        4'000'000, true};

/// With the settings of modules/launch and one link.
HostFacts good_host() {
  HostFacts host;
  host.multicast_route = Route{"eth0", 4};
  host.default_interface = "eth0";
  host.interfaces = {{"eth0", true, true, true}, {"lo", true, false, true}};
  host.rmem_max = 4'194'304;
  host.rmem_default = 212'992;
  host.ipfrag_time_s = 2;
  host.ipfrag_high_thresh = 64 << 20;
  return host;
}

/// The command of the only problem; empty where there is none, or more.
std::string mend(const Findings& findings) {
  std::string command;
  int problems = 0;
  for (const Finding& finding : findings) {
    if (finding.level != Level::kProblem) continue;
    ++problems;
    command = finding.command;
  }
  return problems == 1 ? command : "";
}

TEST(CheckRoute, SendsToThisHostAloneByLo) {
  HostFacts host = good_host();
  host.multicast_route.reset();
  EXPECT_EQ(mend(check_route(host, kThisHost)), "ip route replace 224.0.0.0/4 dev lo");
  host.multicast_route = Route{"lo", 4};
  EXPECT_EQ(check_route(host, kThisHost).front().level, Level::kGood);
}

TEST(CheckRoute, SendsToOtherHostsByTheDeviceThatLeadsThere) {
  HostFacts host = good_host();
  EXPECT_EQ(check_route(host, kNetwork).front().level, Level::kGood);
  host.multicast_route = Route{"lo", 4};
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip route replace 224.0.0.0/4 dev eth0");
  host.multicast_route.reset();
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip route replace 224.0.0.0/4 dev eth0");
}

TEST(CheckRoute, ProposesNoDeviceThatTheHostHasNot) {
  HostFacts host = good_host();
  host.multicast_route = Route{"lo", 4};
  host.default_interface.clear();
  host.interfaces = {{"lo", true, false, true}, {"wlan0", true, true, false}};
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip route replace 224.0.0.0/4 dev wlan0");
  host.interfaces.push_back({"usb0", true, true, true});
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip route replace 224.0.0.0/4 dev usb0");
  host.interfaces.resize(1);
  const Finding finding = check_route(host, kNetwork).front();
  EXPECT_EQ(finding.level, Level::kProblem);
  EXPECT_EQ(finding.text,
            "by lo: nothing leaves this host although ttl=1, and this host has no network device "
            "but lo: add one");
  EXPECT_EQ(finding.command, "");
}

TEST(CheckRoute, NamesADeviceThatIsDownOrTakesNoMulticastOrHasNoLink) {
  HostFacts host = good_host();
  host.interfaces[0].up = false;
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip link set eth0 up");
  host.interfaces[0] = {"eth0", true, false, true};
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip link set eth0 multicast on");
  host.interfaces[0] = {"eth0", true, true, false};
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip -statistics link show eth0");
}

TEST(CheckRoute, WantsOneDeviceNamedWhereSeveralAreConnected) {
  HostFacts host = good_host();
  host.interfaces.push_back({"wlan0", true, true, true});
  EXPECT_EQ(check_route(host, kNetwork).front().level, Level::kGood);
  host.multicast_route = Route{"eth0", 0};
  EXPECT_EQ(mend(check_route(host, kNetwork)), "ip route replace 224.0.0.0/4 dev eth0");
}

TEST(CheckTtl, RefusesToLeaveTheLocalNetwork) {
  EXPECT_EQ(check_ttl(kThisHost).front().level, Level::kNote);
  EXPECT_EQ(check_ttl(kNetwork).front().level, Level::kGood);
  UrlFacts far = kNetwork;
  far.ttl = 2;
  EXPECT_EQ(mend(check_ttl(far)),
            "export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4000000'");
}

TEST(CheckReceiveBuffer, WantsRoomForFourOfTheLargestMessage) {
  HostFacts host = good_host();
  EXPECT_EQ(check_receive_buffer(host, kNetwork, 200'000).front().level, Level::kGood);
  // 4 x 1.5 MB, rounded up to the next million.
  const Findings findings = check_receive_buffer(host, kNetwork, 1'500'000);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].command, "sysctl -w net.core.rmem_max=7000000");
  EXPECT_EQ(findings[1].command,
            "export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=1&recv_buf_size=7000000'");
}

TEST(CheckReceiveBuffer, WantsTheKernelToAllowWhatTheUrlAsksFor) {
  HostFacts host = good_host();
  host.rmem_max = 212'992;
  EXPECT_EQ(mend(check_receive_buffer(host, kNetwork, 200'000)),
            "sysctl -w net.core.rmem_max=4000000");
}

TEST(CheckReceiveBuffer, IsContentWithLessThanTheUrlAsksForWhereItSuffices) {
  HostFacts host = good_host();
  host.rmem_max = 1'500'000;
  const Findings findings = check_receive_buffer(host, kNetwork, 200'000);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].level, Level::kGood);
  EXPECT_EQ(findings[0].text, "1500 kB for messages of up to 200 kB");
}

TEST(CheckReceiveBuffer, CountsSmallMessagesInBytes) {
  EXPECT_EQ(check_receive_buffer(good_host(), kNetwork, 900).front().text,
            "4000 kB for messages of up to 900 bytes");
}

TEST(CheckReceiveBuffer, NotesThatOtherProgramsGetLittleWhereTheUrlNamesNone) {
  const Findings findings = check_receive_buffer(good_host(), kThisHost, 0);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].level, Level::kGood);
  EXPECT_EQ(findings[1].level, Level::kNote);
  EXPECT_EQ(findings[1].command,
            "export LCM_DEFAULT_URL='udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4000000'");
}

TEST(CheckReassembly, WantsIncompletePacketsDroppedInTimeOnANetwork) {
  HostFacts host = good_host();
  EXPECT_EQ(check_reassembly(host, kNetwork).front().level, Level::kGood);
  host.ipfrag_time_s = 30;
  EXPECT_EQ(mend(check_reassembly(host, kNetwork)),
            "sysctl -w net.ipv4.ipfrag_time=2 net.ipv4.ipfrag_high_thresh=67108864");
  EXPECT_TRUE(check_reassembly(host, kThisHost).empty());
}

TEST(CheckDrops, TellsBuffersThatOverflowFromPacketsThatAreLost) {
  HostFacts before = good_host(), after = good_host();
  EXPECT_EQ(check_drops(before, after).front().level, Level::kGood);
  after.full_buffer_drops = 5;
  EXPECT_EQ(check_drops(before, after).front().check, "dropped packets");
  EXPECT_EQ(check_drops(before, after).front().level, Level::kProblem);
  before.full_buffer_drops = 5;
  after.failed_reassemblies = 1;
  EXPECT_EQ(check_drops(before, after).front().check, "lost packets");
}

TEST(CheckCpu, WantsThePerformanceGovernorOnEveryProcessor) {
  HostFacts host = good_host();
  EXPECT_EQ(check_cpu(host).front().level, Level::kGood);
  host.cpu_governors = {"performance", "powersave"};
  EXPECT_EQ(mend(check_cpu(host)),
            "echo performance | tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor");
}

}  // namespace
}  // namespace limbcast::doctor
