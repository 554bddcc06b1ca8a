#pragma once

#include <optional>
#include <string>

#include "common/lcm_io/log_file.hpp"

namespace limbcast::lcm_io {

/// Writes an LCM log that takes its place when it is whole. Until then, and where the program fails
/// or is told to end, an earlier one is as it was, and what was written is a readable log beside it
/// (see unfinished_file).
class WholeLog {
 public:
  explicit WholeLog(const std::string& path);

  /// Makes the log when it is first asked for: nothing to write makes no empty one. Throws like
  /// LogWriter.
  LogWriter& writer();
  bool begun() const { return writer_.has_value(); }
  /// Writes out what is buffered. Throws like LogWriter.
  void close();
  /// Closes and puts it in its place. Throws std::runtime_error where it cannot be written, or
  /// nothing was.
  void finish();
  /// Where what was `done` ("sent") stands of a log that does not become whole.
  std::string what_is_left(const std::string& done) const;

 private:
  std::string path_, unfinished_;
  std::optional<LogWriter> writer_;
};

}  // namespace limbcast::lcm_io
