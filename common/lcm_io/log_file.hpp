#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/output_file.hpp"
#include "common/lcm_io/encode.hpp"

namespace limbcast::lcm_io {

/// One message of an LCM log.
struct LogEvent {
  std::int64_t utime = 0;  ///< when it was logged [us]
  std::string channel;
  std::vector<std::uint8_t> data;
  std::int64_t number =
      0;  ///< the logger's count of events; LogWriter counts anew, copy() does not
};

/// Reads an lcm-logger file from its begin to its end.
class LogReader {
 public:
  /// Throws config::UsageError where the file is missing, empty, or no LCM log.
  explicit LogReader(const std::string& path);

  /// The next message; nothing at the end. What is damaged is passed over.
  std::optional<LogEvent> next();

  /// Goes to where a message begins: what position_bytes() told before it was read.
  void seek(std::int64_t position_bytes);

  /// Did next() find nothing more?
  bool at_end() const { return at_end_; }
  /// After the last message: bytes that follow it but hold no whole message (a torn log), else 0.
  std::int64_t torn_bytes() const { return torn_bytes_; }
  /// Bytes between messages so far that hold none.
  std::int64_t damaged_bytes() const { return damaged_bytes_; }
  std::int64_t size_bytes() const { return size_bytes_; }
  std::int64_t position_bytes() const { return position_bytes_; }

 private:
  std::unique_ptr<lcm::LogFile> file_;
  std::int64_t size_bytes_ = 0, position_bytes_ = 0, torn_bytes_ = 0, damaged_bytes_ = 0;
  bool at_end_ = false;
};

/// Keeps a file that is about to be written from other processes that lock it too, as LogWriter
/// does.
class FileLock : public config::OutputLock {
 public:
  /// Makes the file where there is none and leaves what is in it. Throws config::UsageError where
  /// it cannot be written or another process writes it.
  explicit FileLock(const std::string& path);
};

/// Writes an LCM log. What was written stays readable when the program ends early.
class LogWriter {
 public:
  /// Throws config::UsageError where the file cannot be made or another process writes it.
  explicit LogWriter(const std::string& path);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Throws std::runtime_error with the reason (disk full ...).
  void write(const LogEvent& event);
  /// The same with the event's own number.
  void copy(const LogEvent& event);
  template <class Message>
  void write(std::int64_t utime, const std::string& channel, const Message& message) {
    write(LogEvent{utime, channel, encode(message)});
  }
  /// Writes out what is buffered and closes. Throws like write; the destructor closes without a
  /// word.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  FileLock lock_;
  lcm_eventlog_t* log_;
};

/// What is said of a log whose last bytes hold no whole message.
std::string torn_end(const std::string& log, std::int64_t torn_bytes);

}  // namespace limbcast::lcm_io
