#include "common/lcm_io/bus.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/depth_images_t.hpp>
#include <limbcast/image_t.hpp>
#include <limbcast/mounting_t.hpp>
#include <limbcast/point_cloud_t.hpp>
#include <limbcast/segments_t.hpp>
#include <limbcast/stereo_images_t.hpp>

#include "common/bounded_map.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/lcm_url.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::lcm_io {
namespace {

using std::chrono::milliseconds;

/// Ends a test whose message never comes; not a time the test waits otherwise.
constexpr milliseconds kNever{30000};

image_t numbered(int number) {
  image_t message{};
  message.width = number;
  return message;
}

TEST(Bus, HandsAMessageToItsSubscriber) {
  Bus bus("memq://");
  int got = 0;
  bus.subscribe<image_t>("IMAGE", Keep::kAll, [&](const image_t& message) { got = message.width; });
  bus.publish("IMAGE", numbered(7));
  EXPECT_TRUE(bus.handle(kNever));
  EXPECT_EQ(got, 7);
}

TEST(Bus, KeepsEveryMessageInOrderWhereAsked) {
  Bus bus("memq://");
  std::vector<int> got;
  bus.subscribe<image_t>("IMAGE", Keep::kAll,
                         [&](const image_t& message) { got.push_back(message.width); });
  for (int i = 0; i < 20; ++i) bus.publish("IMAGE", numbered(i));
  while (got.size() < 20) ASSERT_TRUE(bus.handle(kNever));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(got[i], i);
}

TEST(Bus, KeepsTheNewestAndCountsTheSkipped) {
  Bus bus("memq://");
  std::vector<int> got;
  bus.subscribe<image_t>("IMAGE", Keep::kNewest,
                         [&](const image_t& message) { got.push_back(message.width); });
  // The marker comes last: once it is handled, all before it have arrived.
  bool marker = false;
  bus.subscribe<mounting_t>("MARKER", Keep::kAll, [&](const mounting_t&) { marker = true; });
  for (int i = 0; i < 20; ++i) bus.publish("IMAGE", numbered(i));
  bus.publish("MARKER", mounting_t{});
  while (!marker || got.empty() || got.back() != 19) ASSERT_TRUE(bus.handle(kNever));
  EXPECT_EQ(static_cast<int>(got.size()) + bus.skipped(), 20);
}

point_cloud_t cloud_of(const std::string& sensor, int number) {
  point_cloud_t message{};
  message.stamp.sensor = sensor;
  message.stamp.sequence = number;
  return message;
}

/// The clouds that wait, by sensor, while nobody handles them: `publish` sends them.
std::vector<std::string> kept(const std::function<void(Bus&)>& publish) {
  Bus bus("memq://");
  bool open = false;
  std::vector<std::string> got;
  bus.set_gate([&] { return open; });
  bus.subscribe<point_cloud_t>(
      "CLOUD", Keep::kNewest,
      [&](const point_cloud_t& message) {
        got.push_back(message.stamp.sensor + " " + std::to_string(message.stamp.sequence));
      },
      &sensor_of);
  // The marker comes last: once it is handled, all before it have arrived.
  bool marker = false;
  bus.subscribe<mounting_t>("MARKER", Keep::kAll, [&](const mounting_t&) { marker = true; });
  publish(bus);
  bus.publish("MARKER", mounting_t{});
  while (!marker) EXPECT_TRUE(bus.handle(kNever));
  open = true;
  while (bus.handle(milliseconds(0))) continue;
  return got;
}

TEST(Bus, KeepsTheNewestOfEachSensorAndHandlesTheLongestWaitingFirst) {
  const auto got = kept([](Bus& bus) {
    bus.publish("CLOUD", cloud_of("front", 1));
    bus.publish("CLOUD", cloud_of("rear", 1));
    bus.publish("CLOUD", cloud_of("rear", 2));
    bus.publish("CLOUD", cloud_of("front", 2));
  });
  EXPECT_EQ(got, (std::vector<std::string>{"rear 2", "front 2"}));
}

TEST(Bus, KeepsAsManySensorsAsARobotHasWhateverNamesComeIn) {
  const auto got = kept([](Bus& bus) {
    for (int i = 0; i < 1000; ++i) bus.publish("CLOUD", cloud_of(std::to_string(i), 0));
  });
  ASSERT_EQ(got.size(), kMostSensors);
  EXPECT_EQ(got.back(), "999 0");
}

TEST(SensorOfAFrame, IsReadFromItsStamp) {
  const auto read = [](auto message) {
    message.stamp.sensor = "front";
    return sensor_of(encode(message));
  };
  EXPECT_EQ(read(stereo_images_t{}), "front");
  EXPECT_EQ(read(depth_images_t{}), "front");
  EXPECT_EQ(read(point_cloud_t{}), "front");
  EXPECT_EQ(read(segments_t{}), "front");
  EXPECT_EQ(read(body_poses_t{}), "front");
  EXPECT_EQ(sensor_of({}), "");
  EXPECT_EQ(sensor_of(std::vector<std::uint8_t>(40, 255)), "");
}

TEST(Bus, ReportsAForeignMessageAndGoesOn) {
  Bus bus("memq://");
  std::string reported;
  int got = 0;
  bus.set_on_malformed([&](const std::string& channel, const std::string&) { reported = channel; });
  bus.subscribe<image_t>("IMAGE", Keep::kAll, [&](const image_t& message) { got = message.width; });
  bus.publish("IMAGE", mounting_t{});
  bus.publish("IMAGE", numbered(5));
  while (got == 0) ASSERT_TRUE(bus.handle(kNever));
  EXPECT_EQ(reported, "IMAGE");
}

/// Sends bytes that LCM did not make to the group of the URL.
void send_raw(const std::string& url, const std::string& packet) {
  const int sender = socket(AF_INET, SOCK_DGRAM, 0);
  const unsigned char ttl = 0;
  setsockopt(sender, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof(ttl));
  const sockaddr_in group = parse_multicast_url(url)->socket_address();
  EXPECT_EQ(sendto(sender, packet.data(), packet.size(), 0,
                   reinterpret_cast<const sockaddr*>(&group), sizeof(group)),
            static_cast<ssize_t>(packet.size()));
  close(sender);
}

TEST(Bus, SurvivesAPacketThatEndsWithinItsChannelsName) {
  const std::string url = test::private_lcm_url();
  Bus bus(url);
  std::string reported;
  int got = 0;
  bus.set_on_malformed([&](const std::string& channel, const std::string&) { reported = channel; });
  bus.subscribe<image_t>("IMAGE", Keep::kAll, [&](const image_t& message) { got = message.width; });
  const std::string magic_and_number("LC02\0\0\0\0", 8);
  // LCM receives both into the same memory, so zeros follow the name's last letter.
  send_raw(url, magic_and_number + std::string(64, '\0'));
  send_raw(url, magic_and_number + "IMAGE");
  bus.publish("IMAGE", numbered(5));
  while (got == 0) ASSERT_TRUE(bus.handle(kNever));
  EXPECT_EQ(reported, "IMAGE");
}

TEST(Bus, PassesOnWhatAHandlerThrows) {
  Bus bus("memq://");
  bus.subscribe<image_t>("IMAGE", Keep::kAll,
                         [](const image_t&) { throw std::runtime_error("broken"); });
  bus.publish("IMAGE", numbered(1));
  EXPECT_THROW(while (!bus.handle(kNever)){}, std::runtime_error);
}

TEST(Bus, SaysThatAUrlIsUnusable) { EXPECT_THROW(Bus("nonsense://"), config::UsageError); }

TEST(Bus, SaysThatAFileIsNotLiveAndWhatPlaysOne) {
  // Also of a log that is there and could be read: what is published would go nowhere.
  ::testing::internal::CaptureStderr();
  for (const std::string url : {"file:///none/run.log?speed=0", "file:///tmp/new.log?mode=w"})
    EXPECT_EQ(test::error_of<config::UsageError>([&] { Bus bus(url); }),
              "lcm-url '" + url +
                  "': is a file, no live URL; play a log with lcm-logplayer beside the modules, or "
                  "give it to limbcast-replay");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Bus, DoesNotGiveSuccessAsTheReasonWhyAMessageIsNotSent) {
  // Refused by LCM itself, so that no call of the system has failed.
  const std::string too_long_for_lcm(100, 'C');
  Bus bus(test::private_lcm_url());
  EXPECT_EQ(bus.publish(too_long_for_lcm, numbered(1)), "LCM does not say why");
}

TEST(Bus, SaysThatNoServerAnswers) {
  // Nobody serves LCM on the port of the "discard" service.
  const std::string error = test::error_of<config::UsageError>([] { Bus("tcpq://127.0.0.1:9"); });
  EXPECT_NE(error.find("lcm-tcpq-server"), std::string::npos) << error;
}

TEST(Bus, SaysInOneLineThatTheKernelGivesASmallerBufferAndWorks) {
  ::testing::internal::CaptureStderr();
  Bus bus(test::private_lcm_url() + "&recv_buf_size=999000000");
  const std::string told = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_NE(told.find("WARNING the kernel gives sockets"), std::string::npos) << told;
  int got = 0;
  bus.subscribe<image_t>("IMAGE", Keep::kAll, [&](const image_t& message) { got = message.width; });
  bus.publish("IMAGE", numbered(5));
  while (got == 0) ASSERT_TRUE(bus.handle(kNever));
  EXPECT_EQ(got, 5);
}

TEST(DefaultUrl, StaysOnThisHost) {
  const auto url = parse_multicast_url(kDefaultUrl);
  ASSERT_TRUE(url);
  EXPECT_EQ(url->ttl, 0);
}

/// What is told of a URL of the option, or of the environment where the option is empty.
std::string refusal_of(const std::string& option) {
  return test::error_of<config::UsageError>([&] { chosen_url(option); });
}

TEST(ChosenUrl, IsRefusedWhereItIsMalformedAndNamesWhoGaveIt) {
  const std::string reason =
      "'udpm://239.1.2.3': has no port; write it like udpm://239.255.76.67:7667?ttl=1";
  EXPECT_EQ(refusal_of("udpm://239.1.2.3"), "lcm-url " + reason);
  setenv("LCM_DEFAULT_URL", "udpm://239.1.2.3", 1);
  EXPECT_EQ(refusal_of(""), "LCM_DEFAULT_URL " + reason);
  unsetenv("LCM_DEFAULT_URL");
}

TEST(EffectiveUrl, HasRoomForSeveralImagesWhereTheChosenUrlNamesNoBuffer) {
  const auto url = parse_multicast_url(effective_url("udpm://239.255.76.67:7667?ttl=1"));
  ASSERT_TRUE(url);
  EXPECT_EQ(url->ttl, 1);
  constexpr int kImagePair = 200'000;  // VGA, JPEG [byte]
  EXPECT_GE(url->recv_buf_size, 10 * kImagePair);
}

}  // namespace
}  // namespace limbcast::lcm_io
