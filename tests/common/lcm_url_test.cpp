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
  for (const char* text :
       {"memq://", "file:///tmp/run.log", "udpm://host:7667", "udpm://239.1.2.3:99999",
        "udpm://239.1.2.3:7667?ttl=-1", "udpm://239.1.2.3", "nonsense"})
    EXPECT_FALSE(parse_multicast_url(text)) << text;
}

TEST(UrlFault, IsNoneOfWhatLcmUnderstands) {
  for (const char* url : {"udpm://", "udpm://?ttl=1", "udpm://239.255.76.67:7667",
                          "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4000000", "memq://",
                          "tcpq://robot:7700", "mpudpm://239.1.2.3:7667"})
    EXPECT_EQ(url_fault(url), "") << url;
}

TEST(UrlFault, NamesThePartThatIsWrong) {
  EXPECT_EQ(url_fault("udpm://239.255.76.67"), "has no port");
  EXPECT_EQ(url_fault("udpm://239.255.76.67?ttl=1"), "has no port");
  EXPECT_EQ(url_fault("udpm://239.1.2.3:0"), "'0' is no port (1 to 65535)");
  EXPECT_EQ(url_fault("udpm://239.1.2.3:99999"), "'99999' is no port (1 to 65535)");
  EXPECT_EQ(url_fault("udpm://host:7667"), "'host' is no IPv4 address");
  EXPECT_EQ(url_fault("udpm://:7667"), "'' is no IPv4 address");
  EXPECT_EQ(url_fault("udpm://10.0.0.1:7667"),
            "'10.0.0.1' is no multicast address (224.0.0.0 to 239.255.255.255)");
  for (const std::string argument :
       {"ttl", "ttl=", "ttl=-1", "ttl=256", "tll=1", "ttl=1,a=2", "=1"})
    EXPECT_EQ(url_fault("udpm://239.1.2.3:7667?" + argument),
              "'" + argument + "' is neither ttl=0 to 255 nor recv_buf_size=BYTES");
  for (const char* url : {"nonsense", "upd://239.1.2.3:7667", "239.1.2.3:7667"})
    EXPECT_EQ(url_fault(url), "does not begin with udpm://") << url;
}

TEST(UrlFault, IsThatAFileIsNotLive) {
  for (const char* url : {"file:///tmp/run.log", "file:///tmp/run.log?speed=0",
                          "file:///tmp/new.log?mode=w", "file://"})
    EXPECT_EQ(url_fault(url), "is a file, no live URL") << url;
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
