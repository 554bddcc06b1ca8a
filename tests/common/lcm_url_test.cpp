#include "common/lcm_io/lcm_url.hpp"

#include <gtest/gtest.h>

namespace limbcast::lcm_io {
namespace {

TEST(ParseMulticastUrl, ReadsAddressPortAndArguments) {
  const auto url = parse_multicast_url("udpm://239.1.2.3:7000?ttl=1&recv_buf_size=4000000");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->address, "239.1.2.3");
  EXPECT_EQ(url->port, 7000);
  EXPECT_EQ(url->ttl, 1);
  EXPECT_EQ(url->recv_buf_size, 4000000);
}

TEST(ParseMulticastUrl, TakesLcmsDefaultsForWhatIsLeftOut) {
  const auto url = parse_multicast_url("udpm://");
  ASSERT_TRUE(url);
  EXPECT_EQ(url->address, "239.255.76.67");
  EXPECT_EQ(url->port, 7667);
  EXPECT_EQ(url->ttl, 0);
}

TEST(ParseMulticastUrl, RefusesWhatIsNoMulticastUrl) {
  for (const char* text : {"memq://", "file:///tmp/run.log", "udpm://host:7667",
                           "udpm://239.1.2.3:99999", "udpm://239.1.2.3:7667?ttl=-1", "nonsense"})
    EXPECT_FALSE(parse_multicast_url(text)) << text;
}

TEST(WithReceiveBuffer, AsksForSeveralImagesWhereAMulticastUrlNamesNoBuffer) {
  EXPECT_EQ(with_receive_buffer("udpm://239.1.2.3:7000?ttl=1"),
            "udpm://239.1.2.3:7000?ttl=1&recv_buf_size=4000000");
  EXPECT_EQ(with_receive_buffer("udpm://"), "udpm://?recv_buf_size=4000000");
  EXPECT_EQ(with_receive_buffer("udpm://?"), "udpm://?recv_buf_size=4000000");
  for (const char* url : {"udpm://239.1.2.3:7000?recv_buf_size=2000000", "memq://", "nonsense"})
    EXPECT_EQ(with_receive_buffer(url), url);
}

TEST(WithReceiveBufferOfAtMost, AsksForNoMoreThanTheKernelGives) {
  const std::string url = "udpm://239.1.2.3:7000?recv_buf_size=4000000&ttl=1";
  EXPECT_EQ(with_receive_buffer_of_at_most(212'992, url),
            "udpm://239.1.2.3:7000?recv_buf_size=212992&ttl=1");
  EXPECT_EQ(with_receive_buffer_of_at_most(4'000'000, url), url);
  EXPECT_EQ(with_receive_buffer_of_at_most(1, "udpm://239.1.2.3:7000?ttl=1"),
            "udpm://239.1.2.3:7000?ttl=1");
  EXPECT_EQ(with_receive_buffer_of_at_most(1, "memq://"), "memq://");
}

TEST(WhyUnreachable, IsEmptyWhereThereIsARoute) {
  MulticastUrl this_host;
  this_host.address = "127.0.0.1";
  EXPECT_EQ(why_unreachable(this_host), "");
}

}  // namespace
}  // namespace limbcast::lcm_io
