#include "modules/laser_scanner/velodyne.hpp"

#include <algorithm>
#include <cmath>

namespace limbcast::laser_scanner {
namespace {

constexpr int kBlocks = 12;
constexpr std::size_t kBlockBytes = 100;
constexpr int kReturns = 32;
constexpr std::size_t kReturnBytes = 3;
constexpr double kDistanceUnit_m = 0.002;
constexpr double kAzimuthUnit_deg = 0.01;
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr std::uint8_t kDualReturn = 0x39;
constexpr std::uint8_t kVlp16Byte = 0x22, kHdl32Byte = 0x21;
constexpr std::size_t kClockAt = kBlocks * kBlockBytes;
/// The clock counts whole microseconds, which count twice with two returns a laser, and drifts.
constexpr double kClockTolerance_us = 5.0;
/// The clock begins again with each hour.
constexpr double kClockPeriod_us = 3.6e9;

/// Elevations in the order of firing [degrees].
constexpr std::array<double, 16> kVlp16Elevations = {-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                     -7,  9, -5,  11, -3,  13, -1, 15};
constexpr std::array<double, 32> kHdl32Elevations = {
    -30.67, -9.33,  -29.33, -8.00,  -28.00, -6.67,  -26.67, -5.33,  -25.33, -4.00,  -24.00,
    -2.67,  -22.67, -1.33,  -21.33, 0.00,   -20.00, 1.33,   -18.67, 2.67,   -17.33, 4.00,
    -16.00, 5.33,   -14.67, 6.67,   -13.33, 8.00,   -12.00, 9.33,   -10.67, 10.67};

/// What a block takes [us]. VLP-16: two firings of 16 lasers, 2.304 us a laser and 55.296 us a
/// firing; HDL-32E: one firing, 1.152 us a laser and 46.08 us in all.
double block_us(VelodyneModel model) { return model == VelodyneModel::kHdl32 ? 46.08 : 110.592; }

/// How far the scanner has turned at a return, as a share of the turn from block to block.
double share_of_block(VelodyneModel model, int index) {
  const double return_us = model == VelodyneModel::kHdl32
                               ? 1.152 * index
                               : 2.304 * (index % 16) + (index < 16 ? 0.0 : 55.296);
  return return_us / block_us(model);
}

double elevation_deg(VelodyneModel model, int index) {
  return model == VelodyneModel::kHdl32 ? kHdl32Elevations[static_cast<std::size_t>(index)]
                                        : kVlp16Elevations[static_cast<std::size_t>(index % 16)];
}

/// Rank of the laser's elevation among all.
template <std::size_t kLasers>
std::array<std::uint16_t, kLasers> rings_of(const std::array<double, kLasers>& elevations) {
  std::array<std::uint16_t, kLasers> rings{};
  for (std::size_t i = 0; i < kLasers; ++i) {
    rings[i] = static_cast<std::uint16_t>(
        std::count_if(elevations.begin(), elevations.end(),
                      [&](double elevation) { return elevation < elevations[i]; }));
  }
  return rings;
}

std::uint16_t ring(VelodyneModel model, int index) {
  static const auto kVlp16Rings = rings_of(kVlp16Elevations);
  static const auto kHdl32Rings = rings_of(kHdl32Elevations);
  return model == VelodyneModel::kHdl32 ? kHdl32Rings[static_cast<std::size_t>(index)]
                                        : kVlp16Rings[static_cast<std::size_t>(index % 16)];
}

int number_16(const std::uint8_t* bytes) { return bytes[0] | bytes[1] << 8; }
std::int64_t number_32(const std::uint8_t* bytes) {
  return number_16(bytes) + std::int64_t{65536} * number_16(bytes + 2);
}

/// Azimuth from behind the scanner on, where turns are cut [degrees, 0 to 360).
double from_behind_deg(double azimuth_deg) { return std::fmod(azimuth_deg + 180.0, 360.0); }

bool is_data(const std::vector<std::uint8_t>& packet) {
  if (packet.size() != kVelodynePacketBytes) return false;
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const std::uint8_t* bytes = packet.data() + block * kBlockBytes;
    if (bytes[0] != 0xFF || bytes[1] != 0xEE || number_16(bytes + 2) >= 36000) return false;
  }
  return true;
}

/// Two returns a laser: blocks come in pairs of the same azimuth, the last return, then the
/// strongest.
bool is_dual(const std::vector<std::uint8_t>& packet) {
  return packet[kVelodynePacketBytes - 2] == kDualReturn;
}

double azimuth_deg(const std::vector<std::uint8_t>& packet, int block) {
  return kAzimuthUnit_deg *
         number_16(packet.data() + static_cast<std::size_t>(block) * kBlockBytes + 2);
}

/// The scanner's clock when it sent the packet [us since the full hour].
std::int64_t clock_us(const std::vector<std::uint8_t>& packet) {
  return number_32(packet.data() + kClockAt);
}

}  // namespace

std::optional<VelodyneModel> VelodyneModelFinder::add(const std::vector<std::uint8_t>& packet) {
  if (!is_data(packet)) return std::nullopt;
  ++num_packets_;
  if (packet.back() == kVlp16Byte) return VelodyneModel::kVlp16;
  const std::int64_t now_us = clock_us(packet);
  // With two returns a laser, a packet holds half as many firings.
  const double packets_of_all_firings = is_dual(packet) ? 2.0 : 1.0;
  if (last_clock_us_) {
    const double all_firings_us =
        packets_of_all_firings * static_cast<double>(now_us - *last_clock_us_);
    for (const VelodyneModel model : {VelodyneModel::kVlp16, VelodyneModel::kHdl32}) {
      if (std::abs(all_firings_us - kBlocks * block_us(model)) < kClockTolerance_us) return model;
    }
  }
  last_clock_us_ = now_us;
  if (gave_up() && packet.back() == kHdl32Byte) return VelodyneModel::kHdl32;
  return std::nullopt;
}

// Told by the clock, not by a small step back of the azimuth: that is a new turn where the scanner
// is set to a narrow field of view.
bool VelodyneDecoder::was_overtaken(const std::vector<std::uint8_t>& packet) const {
  if (!newest_clock_us_) return false;
  const auto behind_us = static_cast<double>(*newest_clock_us_ - clock_us(packet));
  const double in_period_us = std::remainder(behind_us, kClockPeriod_us);
  // A clock that steps back farther was set anew.
  return in_period_us > 0.0 && in_period_us < kLongestGap_us;
}

std::optional<Sweep> VelodyneDecoder::add(const std::vector<std::uint8_t>& packet,
                                          std::int64_t utime) {
  if (!is_data(packet)) {
    ++num_malformed_;
    return std::nullopt;
  }
  if (started_ && utime - last_utime_ > kLongestGap_us) {
    sweep_ = {};
    started_ = false;
    last_azimuth_deg_ = -1.0;
  }
  const bool overtaken = was_overtaken(packet);
  if (!overtaken) newest_clock_us_ = clock_us(packet);
  const int step = is_dual(packet) ? 2 : 1;
  std::optional<Sweep> whole;
  double turn_deg = 0.0;
  for (int block = step - 1; block < kBlocks; block += step) {
    const double azimuth = azimuth_deg(packet, block);
    if (block + step < kBlocks) {
      turn_deg = std::fmod(azimuth_deg(packet, block + step) - azimuth + 360.0, 360.0);
    }
    const double from_behind = from_behind_deg(azimuth);
    // Of the turn before, which was given out.
    if (overtaken && from_behind > last_azimuth_deg_) continue;
    if (!overtaken && from_behind < last_azimuth_deg_) {
      sweep_.utime = first_utime_ + (last_utime_ - first_utime_) / 2;
      if (started_) whole = std::move(sweep_);
      started_ = true;
      sweep_ = {};
    }
    if (!overtaken) last_azimuth_deg_ = from_behind;
    if (sweep_.points_m.empty()) first_utime_ = utime;
    last_utime_ = utime;
    add_block(packet.data() + static_cast<std::size_t>(block) * kBlockBytes + 4, azimuth, turn_deg);
  }
  return whole;
}

void VelodyneDecoder::add_block(const std::uint8_t* returns, double azimuth_deg, double turn_deg) {
  for (int i = 0; i < kReturns; ++i) {
    const std::uint8_t* bytes = returns + static_cast<std::size_t>(i) * kReturnBytes;
    const int distance = number_16(bytes);
    if (distance == 0) continue;
    const double range_m = kDistanceUnit_m * distance;
    const double azimuth = kRadiansPerDegree * (azimuth_deg + turn_deg * share_of_block(model_, i));
    const double elevation = kRadiansPerDegree * elevation_deg(model_, i);
    const double level_m = range_m * std::cos(elevation);
    sweep_.points_m.emplace_back(static_cast<float>(level_m * std::sin(azimuth)),
                                 static_cast<float>(level_m * std::cos(azimuth)),
                                 static_cast<float>(range_m * std::sin(elevation)));
    sweep_.intensities.push_back(bytes[2]);
    sweep_.rings.push_back(ring(model_, i));
  }
}

}  // namespace limbcast::laser_scanner
