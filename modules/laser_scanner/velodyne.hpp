#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limbcast::laser_scanner {

/// Length of a data packet [bytes]; packets of other lengths (position) are none.
inline constexpr std::size_t kVelodynePacketBytes = 1206;
inline constexpr int kVelodynePort = 2368;
/// Half a turn at the usual 10 turns/s [us]; packets come each 0.6 to 1.3 ms, so that those few
/// that a network loses do not end a turn.
inline constexpr std::int64_t kLongestGap_us = 50'000;

enum class VelodyneModel { kVlp16, kHdl32 };

/// Tells from a scanner's first packets which model sends them. A last byte of 0x22 is a VLP-16's;
/// 0x21 is an HDL-32E's, but early VLP-16 send it too. So the time from packet to packet on the
/// scanner's own clock decides: 24 firings of a VLP-16 take 1327 us, 12 of an HDL-32E 553 us.
class VelodyneModelFinder {
 public:
  /// The model, as soon as the packets tell it. Where kPackets have told no times (a clock that
  /// stands, packets lost all the time), the last byte decides.
  std::optional<VelodyneModel> add(const std::vector<std::uint8_t>& packet);
  /// So many packets were seen that later ones will not tell the model either.
  bool gave_up() const { return num_packets_ >= kPackets; }
  std::int64_t num_packets() const { return num_packets_; }

 private:
  static constexpr std::int64_t kPackets = 20;

  std::int64_t num_packets_ = 0;
  std::optional<std::int64_t> last_clock_us_;
};

/// One turn of the scanner.
struct Sweep {
  std::int64_t utime = 0;  ///< middle of its packets [us]
  /// In the scanner's frame: x right, y forward, z up [m]. Lasers that got no return are left out.
  std::vector<Eigen::Vector3f> points_m;
  std::vector<float> intensities;    ///< calibrated reflectivity of each point, 0 to 255
  std::vector<std::uint16_t> rings;  ///< laser of each point, from the lowest one, 0, upwards
};

/// Puts the packets of a Velodyne together to whole turns (User's Manual VLP-16, 63-9243, chapter
/// 9; HDL-32E, 63-9113, appendix): 12 blocks of 32 returns each, in units of 2 mm and 0.01 degrees.
/// A turn is cut behind the scanner, so that nobody in front is. The first, incomplete one is left
/// out, and so is one during which no packet came for kLongestGap_us: people have moved meanwhile.
/// Packets that others overtook on the network are put where they belong.
class VelodyneDecoder {
 public:
  explicit VelodyneDecoder(VelodyneModel model) : model_(model) {}

  /// Takes a packet that came at `utime`. The turn that it ends, if it ends one. Packets that are
  /// none are counted and dropped.
  std::optional<Sweep> add(const std::vector<std::uint8_t>& packet, std::int64_t utime);
  std::int64_t num_malformed() const { return num_malformed_; }

 private:
  bool was_overtaken(const std::vector<std::uint8_t>& packet) const;
  void add_block(const std::uint8_t* returns, double azimuth_deg, double turn_deg);

  VelodyneModel model_;
  Sweep sweep_;
  std::int64_t first_utime_ = 0, last_utime_ = 0;
  bool started_ = false;  ///< the first, incomplete turn is over
  double last_azimuth_deg_ = -1.0;
  std::optional<std::int64_t> newest_clock_us_;  ///< the scanner's, of a packet none overtook
  std::int64_t num_malformed_ = 0;
};

}  // namespace limbcast::laser_scanner
