#pragma once

#include <cstdint>
#include <vector>

namespace limbcast::lcm_io {

/// A message as it goes over the network and into logs.
template <class Message>
std::vector<std::uint8_t> encode(const Message& message) {
  std::vector<std::uint8_t> bytes(message.getEncodedSize());
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace limbcast::lcm_io
