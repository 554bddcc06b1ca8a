#pragma once

#include <cstdint>
#include <new>
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
