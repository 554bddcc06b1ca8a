#pragma once

#include <stdexcept>
#include <string>

namespace limbcast::lcm_io {

/// A message that cannot be used: its receiver counts it, names it in the status and goes on.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws MessageError(text) where `condition` does not hold.
inline void require(bool condition, const char* text) {
  if (!condition) throw MessageError(text);
}

}  // namespace limbcast::lcm_io
