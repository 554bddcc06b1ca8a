#include "modules/laser_scanner/cloud_source.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/input_error.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "modules/laser_scanner/packet_source.hpp"
#include "tests/laser_scanner/velodyne_packets.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::laser_scanner {
namespace {

using test::error_of;
using ::testing::HasSubstr;

std::string bytes_of(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

class Recorded : public ::testing::Test {
 protected:
  CloudSourceParams params(const std::string& source) const {
    CloudSourceParams params;
    params.source = source;
    params.model = "auto";
    params.sensor = "roof";
    params.frame = "roof/scan";
    params.max_points = lcm_io::kMaxPoints;
    return params;
  }
  test::TemporaryFolder folder_;
};

TEST_F(Recorded, PcapGivesTurnsInOurFrame) {
  const std::string path = folder_.write("a.pcap", pcap_of(vlp16_turns(3, 4.0)));
  const auto source = open_cloud_source(params(path));

  const auto frame = source->next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->cloud.points.size(), kReturnsOfATurn);
  // The first laser at azimuth 0 looks ahead and down: z forward, y down.
  const Eigen::Vector3f ahead = frame->cloud.points[450 * 32];
  EXPECT_NEAR(ahead.z(), 4.0 * std::cos(15.0 * M_PI / 180.0), 1e-4);
  EXPECT_NEAR(ahead.y(), 4.0 * std::sin(15.0 * M_PI / 180.0), 1e-4);
  // Packets 38 to 112 make the first turn; their middle is packet 75, 75 ms after the first.
  EXPECT_NEAR(static_cast<double>(frame->stamp.utime), 1'000'075'000.0, 1'000.0);
  EXPECT_EQ(frame->stamp.sensor, "roof");
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
  EXPECT_TRUE(source->ended());
}

TEST_F(Recorded, PcapOfAVirtualNetworkIsRead) {
  const std::string path =
      folder_.write("a.PCAP", pcap_of(vlp16_turns(2, 4.0), kPcapMicroseconds, kVlan));
  EXPECT_EQ(open_cloud_source(params(path))->next()->cloud.points.size(), kReturnsOfATurn);
}

TEST_F(Recorded, PcapOfTwoScannersGivesTheFirstOnesTurnsAndSaysSo) {
  // Both turn alike; one sees a wall in 4 m, the other in 9 m.
  std::vector<std::vector<std::uint8_t>> packets;
  const auto other = vlp16_turns(2, 9.0);
  for (const auto& packet : vlp16_turns(2, 4.0)) {
    packets.push_back(packet);
    packets.push_back(other[packets.size() / 2]);
  }
  const std::string path =
      folder_.write("a.pcap", pcap_of(packets, kPcapMicroseconds, kEthernet, 2));
  const auto source = open_cloud_source(params(path));

  const auto frame = source->next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->cloud.points.size(), kReturnsOfATurn);
  for (const Eigen::Vector3f& point : frame->cloud.points) EXPECT_NEAR(point.norm(), 4.0F, 1e-3F);
  EXPECT_EQ(source->problem(), path +
                                   ": packets of 0.0.0.1 are left out, as those of 0.0.0.0 came "
                                   "first; give each scanner a port and a recording of its own");
}

TEST_F(Recorded, PcapThatIsTornGivesWhatIsWhole) {
  std::string bytes = pcap_of(vlp16_turns(3, 4.0), 0xA1B2C3D4);
  bytes.resize(bytes.size() * 3 / 5);
  const auto source = open_cloud_source(params(folder_.write("a.pcap", bytes)));
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
  EXPECT_TRUE(source->ended());
}

/// The problem of a recording of two turns, without so many of its last bytes, when it was read.
std::string problem_without_last(std::size_t bytes_missing, const CloudSourceParams& params) {
  std::string bytes = pcap_of(vlp16_turns(2, 4.0));
  bytes.resize(bytes.size() - bytes_missing);
  std::ofstream(params.source, std::ios::binary) << bytes;
  const auto source = open_cloud_source(params);
  while (source->next()) EXPECT_EQ(source->problem(), "");
  return source->problem();
}

TEST_F(Recorded, PcapThatIsTornSaysSoWhenItWasRead) {
  const std::string path = folder_ / "a.pcap";
  // A record: 16 bytes, then the frame: 42 bytes of Ethernet, IP and UDP, then the packet.
  constexpr std::size_t kHeaderBytes = 16;
  constexpr std::size_t kRecordBytes = kHeaderBytes + 42 + kVelodynePacketBytes;
  EXPECT_EQ(problem_without_last(0, params(path)), "");
  EXPECT_EQ(problem_without_last(kRecordBytes, params(path)), "");
  EXPECT_EQ(problem_without_last(5, params(path)),
            path + ": is torn, its last " + std::to_string(kRecordBytes - 5) +
                " bytes are no whole packet and were left out");
  EXPECT_THAT(problem_without_last(kRecordBytes - kHeaderBytes, params(path)),
              HasSubstr("its last 16 bytes"));
  EXPECT_THAT(problem_without_last(kRecordBytes - 3, params(path)), HasSubstr("its last 3 bytes"));
}

TEST_F(Recorded, PcapThatCannotBeUsedIsNamed) {
  const auto error = [this](const std::string& bytes) {
    const std::string path = folder_.write("a.pcap", bytes);
    return error_of<InputError>([&] { open_cloud_source(params(path))->next(); });
  };
  EXPECT_THAT(error("short"), HasSubstr("a.pcap: cannot be read as a pcap file"));
  EXPECT_THAT(error(pcap_of({}, 0x0A0D0D0A)), HasSubstr("is no pcap file"));
  EXPECT_THAT(error(pcap_of({})), HasSubstr("holds no whole turn"));
  EXPECT_THAT(error(pcap_of({vlp16_packet(0.0, 1.0, 0x99)})), HasSubstr("give --velodyne-model"));
}

TEST_F(Recorded, FolderGivesCloudsWithTimesGravityAndTruth) {
  const std::vector<float> row = {5.0F, -1.0F, 0.5F, 0.25F, 90.0F, 0.0F, 0.0F, 0.75F};
  const std::string bytes = bytes_of(row);
  folder_.write("a.bin", bytes);
  folder_.write("timestamps.csv", "name,utime,down_x,down_y,down_z\na,77,0,0.8,0.6\n");
  folder_.write("a_gt.json", R"({"utime": 77, "persons": []})");

  const auto source = open_cloud_source(params(folder_.path()));
  const auto frame = source->next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 77);
  EXPECT_EQ(frame->stamp.gravity.source, GravitySource::kRecording);
  EXPECT_TRUE(frame->truth);
  // KITTI: 5 m ahead, 1 m to the right, 0.5 m up; the point at 90 m is beyond the far limit.
  ASSERT_EQ(frame->cloud.points.size(), 1U);
  EXPECT_EQ(frame->cloud.points[0], Eigen::Vector3f(1.0F, -0.5F, 5.0F));
  EXPECT_EQ(frame->cloud.intensities, std::vector<float>{0.25F});
  EXPECT_TRUE(source->ended());
}

TEST_F(Recorded, FolderOfSeveralKindsTurnsEachFileAsItsKindDoes) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "DATA ascii\n";
  const std::vector<float> row = {5.0F, -1.0F, 0.5F, 0.25F};
  const std::string bytes = bytes_of(row);
  for (const char* kitti : {"a.bin", "c.bin"}) folder_.write(kitti, bytes);
  folder_.write("b.pcd", header + "1 -0.5 5\n");
  const auto source = open_cloud_source(params(folder_.path()));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(source->next().value().cloud.points.at(0), Eigen::Vector3f(1.0F, -0.5F, 5.0F)) << i;
}

TEST_F(Recorded, FolderGivesCloudsOfNamesInCapitalsAndNoFolders) {
  const std::string row(16, '\0');
  for (const char* name : {"a.bin", "b.BIN", "c.Bin"}) folder_.write(name, row);
  std::filesystem::create_directory(folder_ / "d.bin");
  const auto source = open_cloud_source(params(folder_.path()));
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
}

TEST_F(Recorded, CloudWithoutPointsWithinTheLimitsSaysWhy) {
  const auto fault = [this](const std::string& rows, double unit_m = 1.0) {
    const std::string path = folder_.write(
        "a.pcd",
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 2\nDATA ascii\n" + rows);
    CloudSourceParams of_cloud = params(path);
    of_cloud.unit_m = unit_m;
    return open_cloud_source(of_cloud)->next()->fault;
  };
  EXPECT_EQ(fault("0 0 2000\n0 0 1000\n"), folder_ / "a.pcd" +
                                               ": none of 2 points lies within 0.3 to 30 m; "
                                               "give --unit-m 0.001 where they are in millimetres");
  EXPECT_THAT(fault("0 0 2\n0 0 1\n", 0.001), HasSubstr("is --unit-m right?"));
  EXPECT_THAT(fault("nan nan nan\nnan nan nan\n"), HasSubstr("a.pcd: has no finite points"));
  EXPECT_EQ(fault("0 0 2\n0 0 1000\n"), "");
}

TEST_F(Recorded, SourcesThatCannotBeOpenedAreNamed) {
  const auto error = [this](const std::string& source) {
    return error_of<InputError>([&] { open_cloud_source(params(source)); });
  };
  EXPECT_THAT(error("/nowhere"), HasSubstr("/nowhere: does not exist"));
  EXPECT_THAT(error(folder_.path()), HasSubstr("has no files of .pcd .ply .bin"));
  EXPECT_THAT(error("velodyne:99999"), HasSubstr("'99999' is no UDP port"));
}

sockaddr_in address_of(const char* host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  inet_pton(AF_INET, host, &address.sin_addr);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

/// Sends packets from an address of this host to one of its ports.
class Scanner {
 public:
  Scanner(const char* host, int port) : receiver_(address_of("127.0.0.1", port)) {
    const sockaddr_in own = address_of(host, 0);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof(own)), 0);
  }
  ~Scanner() { close(socket_); }
  Scanner(const Scanner&) = delete;
  Scanner& operator=(const Scanner&) = delete;
  void send(const std::vector<std::uint8_t>& packet) const {
    sendto(socket_, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&receiver_),
           sizeof(receiver_));
  }

 private:
  int socket_ = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in receiver_;
};

/// Some port of this process's own.
int own_port() { return 20000 + getpid() % 40000; }

TEST_F(Recorded, LiveScannerIsHeardOnItsPort) {
  const auto source = open_cloud_source(params("velodyne:" + std::to_string(own_port())));
  EXPECT_TRUE(source->live());
  const Scanner scanner("127.0.0.1", own_port());
  for (const auto& packet : vlp16_turns(2, 3.0)) scanner.send(packet);

  const auto frame = source->next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->cloud.points.size(), kReturnsOfATurn);
  EXPECT_FALSE(source->next());
  EXPECT_FALSE(source->ended());
}

TEST_F(Recorded, LiveScannersOnOnePortAreNotMixed) {
  const auto source = open_cloud_source(params("velodyne:" + std::to_string(own_port())));
  const Scanner first("127.0.0.1", own_port());
  const Scanner second("127.0.0.2", own_port());
  const auto others = vlp16_turns(2, 9.0);
  const auto packets = vlp16_turns(2, 3.0);
  // One whole turn of each, as the system holds no more for a receiver.
  for (std::size_t i = 37; i <= 112; ++i) {
    first.send(packets[i]);
    second.send(others[i]);
  }

  const auto frame = source->next();

  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->cloud.points.size(), kReturnsOfATurn);
  for (const Eigen::Vector3f& point : frame->cloud.points) EXPECT_NEAR(point.norm(), 3.0F, 1e-3F);
  EXPECT_THAT(source->problem(),
              HasSubstr(": packets of 127.0.0.2 are left out, as those of 127.0.0.1 came first"));
}

TEST_F(Recorded, LiveScannerThatSendsNothingIsTold) {
  CloudSourceParams live = params("velodyne:" + std::to_string(own_port()));
  EXPECT_EQ(open_cloud_source(live)->problem(), "");
  live.stall_timeout_s = 0.0;
  EXPECT_THAT(open_cloud_source(live)->problem(),
              HasSubstr(": no packets for 0 s; is the scanner on"));
}

TEST_F(Recorded, LiveScannersPortIsNotSharedWithAnotherReader) {
  const CloudSourceParams live = params("velodyne:" + std::to_string(own_port()));
  const auto error = [&live] { return error_of<InputError>([&] { open_cloud_source(live); }); };
  const auto is_taken = HasSubstr("UDP port " + std::to_string(own_port()) +
                                  " is taken by another process; end it (ss -lunp sport = :" +
                                  std::to_string(own_port()) + " names it)");
  {
    const auto source = open_cloud_source(live);
    EXPECT_THAT(error(), is_taken);
  }
  // Another program that would share its port, as PCL's grabbers do.
  const int other = socket(AF_INET, SOCK_DGRAM, 0);
  const int yes = 1;
  for (const int option : {SO_REUSEADDR, SO_REUSEPORT})
    setsockopt(other, SOL_SOCKET, option, &yes, sizeof(yes));
  const sockaddr_in address = address_of("0.0.0.0", own_port());
  ASSERT_EQ(bind(other, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_THAT(error(), is_taken);
  close(other);
}

TEST_F(Recorded, ScansOfTheDataAreRead) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!std::filesystem::exists(data)) GTEST_SKIP() << data << " is absent";
  const auto laser = open_cloud_source(params(data + "/laser_dev"));
  int frames = 0;
  while (const auto frame = laser->next()) {
    ++frames;
    EXPECT_TRUE(frame->truth);
    EXPECT_GT(frame->cloud.points.size(), 30'000U);
  }
  EXPECT_EQ(frames, 20);
  // binary_compressed, organised, with colours.
  const auto kinect = open_cloud_source(params(data + "/clouds/five_people.pcd"))->next();
  EXPECT_GT(kinect->cloud.points.size(), 200'000U);
  EXPECT_EQ(kinect->cloud.colors.size(), kinect->cloud.points.size());
}

}  // namespace
}  // namespace limbcast::laser_scanner
