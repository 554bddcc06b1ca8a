#pragma once

#include <stdexcept>

namespace limbcast {

/// A file or folder that the user named cannot be used. One line: where, what was found, what to
/// do. Programs end with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace limbcast
