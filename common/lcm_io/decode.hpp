#pragma once

#include <cstdint>
#include <limbcast/stamp_t.hpp>
#include <new>
#include <string>
#include <vector>

#include "common/lcm_io/message_error.hpp"

namespace limbcast::lcm_io {

/// What LCM puts before each message to tell its type; 0 where there are too few bytes for it.
inline std::int64_t fingerprint_of(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t fingerprint = 0;
  if (bytes.size() < sizeof(fingerprint)) return 0;
  for (std::size_t i = 0; i < sizeof(fingerprint); ++i) fingerprint = fingerprint << 8 | bytes[i];
  return static_cast<std::int64_t>(fingerprint);
}

/// Name of the sensor of a frame, whose messages begin with their stamp; empty where none is told.
inline std::string sensor_of(const std::vector<std::uint8_t>& bytes) {
  constexpr int kFingerprint_bytes = sizeof(std::int64_t);
  const int rest_bytes = static_cast<int>(bytes.size()) - kFingerprint_bytes;
  stamp_t stamp{};
  if (rest_bytes <= 0 || stamp._decodeNoHash(bytes.data(), kFingerprint_bytes, rest_bytes) < 0)
    return {};
  return stamp.sensor;
}

/// The message that these bytes hold. Throws MessageError where they are of another type,
/// truncated, or claim more elements than memory holds (generated decoders allocate before they
/// read).
template <class Message>
Message decode(const std::vector<std::uint8_t>& bytes) {
  Message message{};
  try {
    require(message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) >= 0,
            "not a message of this type, or truncated");
  } catch (const std::bad_alloc&) {
    throw MessageError("claims more elements than memory holds");
  }
  return message;
}

}  // namespace limbcast::lcm_io
