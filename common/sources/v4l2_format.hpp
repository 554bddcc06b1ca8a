#pragma once

#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/sources/picture.hpp"

namespace limbcast {

/// A format that a V4L2 device offers at the wanted size.
struct OfferedFormat {
  std::uint32_t fourcc = 0;
  bool has_size = true;     ///< the wanted size is one of its sizes
  double fastest_hz = 0.0;  ///< at that size; 0: the driver does not tell
};

/// "YUYV" as V4L2's number, and back. Shorter names are filled with spaces, as V4L2 does ("Z16 ").
std::uint32_t fourcc_of(const std::string& name);
std::string name_of(std::uint32_t fourcc);

/// Can its pictures be read: as colour or grey, or (`depth`) as 16-bit depth?
bool is_readable(std::uint32_t fourcc, bool depth);
/// Names of all that can be read, for messages.
std::string readable_formats(bool depth);

/// The format to read: one that has the wanted size, then the one whose rate comes nearest to
/// `wanted_hz`, then one without loss before motion JPEG (USB 2 carries VGA at 30 frames/s without
/// loss, larger pictures only as JPEG). Nothing: none can be read.
std::optional<std::uint32_t> choose_format(const std::vector<OfferedFormat>& offered,
                                           double wanted_hz, bool depth);

/// A buffer that the device filled, as a picture. Nothing: the buffer is damaged (too short, a torn
/// JPEG), as USB cameras leave it now and then.
std::optional<Picture> picture_from(const std::uint8_t* bytes, std::size_t num_bytes,
                                    const v4l2_pix_format& format);

}  // namespace limbcast
