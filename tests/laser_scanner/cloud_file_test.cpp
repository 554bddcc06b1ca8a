#include "modules/laser_scanner/cloud_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "common/input_error.hpp"
#include "modules/laser_scanner/axes.hpp"
#include "modules/laser_scanner/lzf.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::laser_scanner {
namespace {

using test::error_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t kMaxPoints = 5;

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string pcd_header(const std::string& data, int points) {
  const std::string count = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 "
         "4 4 4\n"
         "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " +
         count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " + data + "\n";
}

class CloudFile : public ::testing::Test {
 protected:
  RawCloud read(const std::string& name, const std::string& bytes) {
    return read_cloud_file(folder_.write(name, bytes), kMaxPoints);
  }
  std::string error(const std::string& name, const std::string& bytes) {
    return error_of<InputError>([&] { read(name, bytes); });
  }
  test::TemporaryFolder folder_;
  const float nan_ = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> two_points_ = {{1.5F, -2.0F, 3.0F}, {4.0F, 5.0F, -6.25F}};
  const std::vector<float> rows_ = {1.5F, -2.0F, 3.0F, 9.0F, 4.0F, 5.0F, -6.25F, 9.0F};
};

TEST_F(CloudFile, OfPcdIsReadAsText) {
  EXPECT_EQ(read("a.pcd", pcd_header("ascii", 2) + "1.5 -2 3 9\n4 5 -6.25 9\n").points,
            two_points_);
}

TEST_F(CloudFile, OfPcdIsReadAsNumbers) {
  EXPECT_EQ(read("a.pcd", pcd_header("binary", 2) + bytes_of(rows_)).points, two_points_);
}

TEST_F(CloudFile, OfPcdIsReadPacked) {
  // Column after column; one run of literal bytes: 32 of them.
  const std::vector<float> columns = {1.5F, 4.0F, -2.0F, 5.0F, 3.0F, -6.25F, 9.0F, 9.0F};
  const std::string packed = std::string(1, '\x1F') + bytes_of(columns);
  const std::string sizes =
      bytes_of<std::uint32_t>({static_cast<std::uint32_t>(packed.size()), 32});
  EXPECT_EQ(read("a.pcd", pcd_header("binary_compressed", 2) + sizes + packed).points, two_points_);
}

TEST_F(CloudFile, OfKittiIsReadWithIntensities) {
  const RawCloud cloud = read("a.bin", bytes_of(rows_));
  EXPECT_EQ(cloud.points, two_points_);
  EXPECT_THAT(cloud.intensities, ElementsAre(9.0F, 9.0F));
  EXPECT_TRUE(cloud.rings.empty());
}

TEST_F(CloudFile, KeepsIntensitiesAndRingsOfThePointsThatAreThere) {
  const std::string header =
      "VERSION 0.7\nFIELDS x y z intensity ring\nSIZE 4 4 4 4 2\nTYPE F F F F U\n"
      "COUNT 1 1 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n";
  const RawCloud cloud = read("a.pcd", header + "1 2 3 0.25 7\nnan nan nan 5 8\n4 5 6 nan 65535\n");
  EXPECT_EQ(cloud.points.size(), 2U);
  EXPECT_THAT(cloud.intensities, ElementsAre(0.25F, 0.0F));
  EXPECT_THAT(cloud.rings, ElementsAre(7, 65535));
}

TEST_F(CloudFile, KeepsIntensitiesAndRingsOfPlyByTheirOtherNames) {
  const RawCloud cloud =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nproperty float scalar_Intensity\nproperty uchar scalar_ring\n"
           "end_header\n1 2 3 0.5 12\n");
  EXPECT_THAT(cloud.intensities, ElementsAre(0.5F));
  EXPECT_THAT(cloud.rings, ElementsAre(12));
}

TEST_F(CloudFile, WithRingsThatAreNoneIsNamed) {
  const auto ring_error = [this](const std::string& ring) {
    return error("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float ring\nend_header\n1 2 3 " +
                     ring + "\n");
  };
  EXPECT_THAT(ring_error("-1"), HasSubstr("a.ply: its column 'ring' holds -1"));
  EXPECT_THAT(ring_error("65536"), HasSubstr("no number of a ring"));
  EXPECT_THAT(ring_error("2.5"), HasSubstr("no number of a ring"));
}

TEST_F(CloudFile, OfTextHasNoNumberThatWouldBeWrapped) {
  const auto with_ring = [](const std::string& type, const std::string& ring) {
    return "VERSION 0.7\nFIELDS x y z ring\nSIZE 4 4 4 " + type.substr(1) + "\nTYPE F F F " +
           type.substr(0, 1) + "\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 " +
           ring + "\n";
  };
  EXPECT_THAT(error("a.pcd", with_ring("U2", "65537")),
              HasSubstr("a.pcd: row 1: 'ring' is 65537, its header tells whole numbers of 2 bytes "
                        "without a sign; correct one of them"));
  EXPECT_THAT(error("a.pcd", with_ring("U1", "-1")), HasSubstr("'ring' is -1"));
  EXPECT_THAT(error("a.pcd", with_ring("I1", "128")), HasSubstr("'ring' is 128"));
  EXPECT_THAT(error("a.pcd", with_ring("U4", "99999999999")), HasSubstr("'ring' is 99999999999"));
  for (const char* type : {"U2", "I4", "U8"})
    EXPECT_EQ(read("a.pcd", with_ring(type, "65535")).rings, std::vector<std::uint16_t>{65535});
}

TEST_F(CloudFile, OfTextMayHoldWhatDoesNotFitWherePointsHaveNoUseForIt) {
  const RawCloud of_pcd = read("a.pcd",
                               "VERSION 0.7\nFIELDS x label y z rgb red ring\nSIZE 4 1 4 4 4 1 2\n"
                               "TYPE F U F F U U U\nCOUNT 1 2 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\n"
                               "POINTS 1\nDATA ascii\n1 -1 1e300 2 3 255 nan 7\n");
  EXPECT_THAT(of_pcd.points, ElementsAre(Eigen::Vector3f(1, 2, 3)));
  EXPECT_THAT(of_pcd.rings, ElementsAre(7));
  ASSERT_EQ(of_pcd.colors.size(), 1U);
  EXPECT_EQ(of_pcd.colors[0].b, 255) << "the packed colour is taken, not 'red'";
  const RawCloud of_ply = read("a.ply",
                               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                               "property float y\nproperty char class\nproperty float z\n"
                               "end_header\n1 2 200 3\n");
  EXPECT_THAT(of_ply.points, ElementsAre(Eigen::Vector3f(1, 2, 3)));
}

TEST_F(CloudFile, KeepsNoRingsWhereAPointHasNone) {
  const RawCloud cloud = read(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty float scalar_ring\nend_header\n1 2 3 4\n5 6 7 nan\n8 9 1 2\n");
  EXPECT_EQ(cloud.points.size(), 3U);
  EXPECT_TRUE(cloud.rings.empty());
}

TEST_F(CloudFile, OfPlyIsReadWithColors) {
  const std::string properties =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nelement face 0\nend_header\n";
  const RawCloud text = read(
      "a.ply", "ply\nformat ascii 1.0\n" + properties + "1.5 -2 3 10 20 30\n4 5 -6.25 1 2 3\n");
  EXPECT_EQ(text.points, two_points_);
  ASSERT_EQ(text.colors.size(), 2U);
  EXPECT_EQ(text.colors[0].r, 10);
  EXPECT_EQ(text.colors[0].b, 30);

  const std::string rows = bytes_of<float>({1.5F, -2.0F, 3.0F}) + "\x0A\x14\x1E" +
                           bytes_of<float>({4.0F, 5.0F, -6.25F}) + "\x01\x02\x03";
  const RawCloud binary =
      read("b.ply", "ply\nformat binary_little_endian 1.0\n" + properties + rows);
  EXPECT_EQ(binary.points, two_points_);
  EXPECT_EQ(binary.colors[1].g, 2);
}

TEST_F(CloudFile, OfPlyIsReadWithColorsOfWhateverType) {
  const auto first_color = [this](const std::string& type, const std::string& color) {
    const std::string property = "property " + type + " ";
    const RawCloud cloud =
        read("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
             "property float z\n" +
                 property + "red\n" + property + "green\n" + property + "blue\nend_header\n1 2 3 " +
                 color + "\n");
    const Bgr bgr = cloud.colors.at(0);
    return std::vector<int>{bgr.r, bgr.g, bgr.b};
  };
  EXPECT_THAT(first_color("int", "10 20 300"), ElementsAre(10, 20, 255));
  EXPECT_THAT(first_color("ushort", "65535 2570 0"), ElementsAre(255, 10, 0));
  EXPECT_THAT(first_color("float", "1 0.2 nan"), ElementsAre(255, 51, 0));
}

TEST_F(CloudFile, LeavesOutWhatIsNotFinite) {
  const std::vector<float> rows = {nan_, nan_, nan_, 0.0F, 1.0F, 2.0F, 3.0F, 0.0F};
  EXPECT_THAT(read("a.pcd", pcd_header("binary", 2) + bytes_of(rows)).points,
              ElementsAre(Eigen::Vector3f(1.0F, 2.0F, 3.0F)));
}

TEST_F(CloudFile, WithNumbersOf8BytesIsRead) {
  const std::string header =
      "VERSION 0.7\nFIELDS timestamp x y z\nSIZE 8 4 4 8\nTYPE U F F I\nCOUNT 1 1 1 1\n"
      "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ";
  const std::vector<Eigen::Vector3f> points = {{1.5F, -2.0F, 3.0F}, {4.0F, 5.0F, -6.0F}};
  EXPECT_EQ(
      read("a.pcd", header + "ascii\n1700000000000000000 1.5 -2 3\n1700000000000000001 4 5 -6\n")
          .points,
      points);
  const std::string rows = bytes_of<std::uint64_t>({1'700'000'000'000'000'000}) +
                           bytes_of<float>({1.5F, -2.0F}) + bytes_of<std::int64_t>({3}) +
                           bytes_of<std::uint64_t>({1'700'000'000'000'000'001}) +
                           bytes_of<float>({4.0F, 5.0F}) + bytes_of<std::int64_t>({-6});
  EXPECT_EQ(read("a.pcd", header + "binary\n" + rows).points, points);
}

TEST_F(CloudFile, WithFloatsOf1Or2BytesIsNamed) {
  for (const std::string size : {"1", "2"}) {
    const std::string header = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 " + size +
                               "\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 1\nDATA binary\n";
    EXPECT_THAT(
        error("a.pcd", header + std::string(12, '\0')),
        HasSubstr("a.pcd: its field 'z' is a float of " + size + " bytes; write it with 4"));
  }
}

TEST_F(CloudFile, WithoutPointsLineHasWidthTimesHeight) {
  const std::string start = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  const std::string rows = "DATA ascii\n1 2 3\n4 5 6\n7 8 9\n1 1 1\n";
  EXPECT_EQ(read("a.pcd", start + "WIDTH 2\nHEIGHT 2\n" + rows).points.size(), 4U);
  EXPECT_THAT(error("a.pcd", start + rows), HasSubstr("does not tell how many points"));
}

TEST_F(CloudFile, WithOtherPointsThanWidthTimesHeightIsNamed) {
  const auto pcd = [](const std::string& lattice, int points) {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + lattice +
           "POINTS " + std::to_string(points) + "\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\n1 1 1\n";
  };
  for (const int points : {3, 5})
    EXPECT_THAT(error("a.pcd", pcd("WIDTH 2\nHEIGHT 2\n", points)),
                HasSubstr("a.pcd: its header tells POINTS " + std::to_string(points) +
                          " but WIDTH 2 x HEIGHT 2; write it again or correct its header"));
  for (const char* lattice : {"WIDTH 2\nHEIGHT 2\n", "WIDTH 4\n", "WIDTH 4\nHEIGHT 0\n", ""})
    EXPECT_EQ(read("a.pcd", pcd(lattice, 4)).points.size(), 4U) << lattice;
}

TEST_F(CloudFile, WithMorePointsThanCanBeSentIsNamed) {
  const std::string text = "holds 6 points, more than the 5 that can be sent; thin it out";
  EXPECT_THAT(error("a.pcd", pcd_header("binary", 6) + std::string(96, '\0')), HasSubstr(text));
  EXPECT_THAT(error("a.bin", std::string(96, '\0')), HasSubstr("a.bin: " + text));
  EXPECT_THAT(
      error("a.ply", "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nend_header\n"),
      HasSubstr(text));
  EXPECT_EQ(read("a.bin", std::string(80, '\0')).points.size(), 5U);
  // Their product has more than 64 bits.
  EXPECT_THAT(error("a.pcd",
                    "VERSION 0.7\nFIELDS x\nSIZE 4\nTYPE F\nCOUNT 1\n"
                    "WIDTH 9223372036854775808\nHEIGHT 2\nDATA ascii\n"),
              HasSubstr("tells '9223372036854775808' points"));
}

TEST_F(CloudFile, OfTextMustHaveAsManyNumbersInARowAsItsHeaderTells) {
  EXPECT_THAT(error("a.pcd", pcd_header("ascii", 2) + "1 2 3 4 5\n1 2 3 4 5\n"),
              HasSubstr("a.pcd: row 1 holds 5 numbers, its header tells 4"));
  EXPECT_THAT(error("a.pcd", pcd_header("ascii", 3) + "1 2 3 4\n\n1 2 3\n1 2 3 4\n4\n"),
              HasSubstr("row 2 holds 3 numbers"));
  EXPECT_THAT(error("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                    "property float y\nproperty float z\nend_header\n1 2 3 4\n"),
              HasSubstr("a.ply: row 1 holds 4 numbers, its header tells 3"));
}

TEST_F(CloudFile, OfNuScenesIsNotTakenForKittis) {
  EXPECT_THAT(error("a.pcd.bin", std::string(80, '\0')), HasSubstr("nuScenes"));
  // Four rows of five numbers are as long as five of four.
  const std::vector<float> rows = {5.0F, -2.0F, 0.5F, 9.0F, 0.0F, 5.0F, -2.0F, 0.4F, 9.0F, 1.0F,
                                   5.0F, -2.0F, 0.3F, 9.0F, 2.0F, 5.0F, -2.0F, 0.2F, 9.0F, 3.0F};
  EXPECT_THAT(error("a.bin", bytes_of(rows)), HasSubstr("a.bin: is not KITTI's"));
}

TEST_F(CloudFile, ThatCannotBeUsedIsNamed) {
  EXPECT_THAT(error("a.pcd", ""), HasSubstr("a.pcd: is empty"));
  EXPECT_THAT(error("a.pcd", "not a cloud"), HasSubstr("is neither PCD, PLY nor KITTI"));
  EXPECT_THAT(error("a.pcd", "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z"),
              HasSubstr("its header does not end"));
  EXPECT_THAT(error("a.pcd", pcd_header("binary", 3) + bytes_of(rows_)), HasSubstr("is torn"));
  EXPECT_THAT(error("a.pcd", pcd_header("ascii", 3) + "1 2 3 4\n1 2"), HasSubstr("is torn"));
  EXPECT_THAT(error("a.pcd", pcd_header("ascii", 1) + "1 two 3 4\n"),
              HasSubstr("'two' is no number"));
  EXPECT_THAT(error("a.pcd", pcd_header("zipped", 1)), HasSubstr("its data are 'zipped'"));
  EXPECT_THAT(error("a.pcd", pcd_header("binary", -5)), HasSubstr("tells '-5' points"));
  EXPECT_THAT(error("a.pcd", pcd_header("binary_compressed", 2) +
                                 bytes_of<std::uint32_t>({33, 32}) + std::string(33, '\xFF')),
              HasSubstr("compressed data are torn"));
  EXPECT_THAT(error("a.bin", std::string(17, 'x')), HasSubstr("no multiple of 16 bytes"));
  EXPECT_THAT(error("a.ply",
                    "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\n"
                    "end_header\n"),
              HasSubstr("its format is 'binary_big_endian'"));
  EXPECT_THAT(
      error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float u\nend_header\n1\n"),
      HasSubstr("has no x, y and z"));
}

TEST(Lzf, RepeatsWhatStoodBefore) {
  // "ab" as it is, then 6 bytes from 2 before: it overlaps itself.
  const std::vector<std::uint8_t> packed = {0x01, 'a', 'b', 0x80, 0x01};
  const auto unpacked = unpack_lzf(packed.data(), packed.size(), 8);
  ASSERT_TRUE(unpacked);
  EXPECT_EQ(std::string(unpacked->begin(), unpacked->end()), "abababab");
}

/// Unpacks the first `given` bytes of `packed`, which are to give `size` bytes.
bool unpacks(const std::vector<std::uint8_t>& packed, std::size_t given, std::size_t size) {
  return unpack_lzf(packed.data(), given, size).has_value();
}

// What is refused would give just as many bytes as are wanted if it were read on, so that the size
// alone tells nothing.

TEST(Lzf, RefusesWhatPointsBeforeTheBegin) {
  // "a", then 3 bytes from 1 before, and from 2 before.
  EXPECT_TRUE(unpacks({0x00, 'a', 0x20, 0x00}, 4, 4));
  EXPECT_FALSE(unpacks({0x00, 'a', 0x20, 0x01}, 4, 4));
}

TEST(Lzf, RefusesWhatEndsEarly) {
  const std::vector<std::uint8_t> literal = {0x02, 'a', 'b', 'c'};
  EXPECT_TRUE(unpacks(literal, 4, 3));
  EXPECT_FALSE(unpacks(literal, 3, 3)) << "within bytes as they are";
  const std::vector<std::uint8_t> repeated = {0x00, 'a', 0x20, 0x00};
  EXPECT_FALSE(unpacks(repeated, 3, 4)) << "before the distance";
  const std::vector<std::uint8_t> long_repeated = {0x00, 'a', 0xE0, 0x00, 0x00};
  EXPECT_TRUE(unpacks(long_repeated, 5, 10));
  EXPECT_FALSE(unpacks(long_repeated, 4, 10)) << "before the distance of a long one";
  EXPECT_FALSE(unpacks(long_repeated, 3, 10)) << "before the length";
}

TEST(Lzf, RefusesWhatGivesTooManyOrTooFewBytes) {
  EXPECT_FALSE(unpacks({0x02, 'a', 'b', 'c'}, 4, 2));
  EXPECT_FALSE(unpacks({0x02, 'a', 'b', 'c'}, 4, 4));
  EXPECT_FALSE(unpacks({0x00, 'a', 0x20, 0x00}, 4, 3));
}

TEST(AxesTest, TurnIntoOurFrame) {
  const Eigen::Vector3f forward_left_up{3.0F, 1.0F, 2.0F};  // 3 ahead, 1 to the left, 2 up
  EXPECT_EQ(Axes("-y,-z,x", 1.0)(forward_left_up), Eigen::Vector3f(-1.0F, -2.0F, 3.0F));
  EXPECT_EQ(Axes("x,y,z", 0.001)(Eigen::Vector3f(1000.0F, 0.0F, 500.0F)),
            Eigen::Vector3f(1.0F, 0.0F, 0.5F));
}

TEST(AxesTest, ThatNameNoRightHandedFrameAreRefused) {
  for (const char* text : {"y,-z,x", "x,x,z", "x,y", "x,y,z,x", "a,b,c", "", "x,-y,z"}) {
    EXPECT_THROW(Axes(text, 1.0), InputError) << text;
  }
}

}  // namespace
}  // namespace limbcast::laser_scanner
