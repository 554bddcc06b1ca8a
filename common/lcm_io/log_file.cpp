#include "common/lcm_io/log_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/config/options.hpp"
#include "common/input_file.hpp"

namespace limbcast::lcm_io {
namespace {

/// First bytes of every event in an LCM log.
constexpr unsigned char kSyncWord[] = {0xED, 0xA1, 0xDA, 0x01};

/// Bytes of an event before its channel and data: sync word, number, time, two lengths.
constexpr std::int64_t kHeaderBytes = 28;

/// Where the next sync word begins, from `from` on; `size` where there is none.
std::int64_t find_sync_word(std::FILE* file, std::int64_t from, std::int64_t size) {
  std::fseek(file, static_cast<long>(from), SEEK_SET);
  std::size_t matched = 0;
  for (std::int64_t at = from; at < size; ++at) {
    const int byte = std::fgetc(file);
    if (byte == EOF) return size;
    // Its first byte does not come again in it, so that a mismatch starts over at once.
    matched = byte == kSyncWord[matched] ? matched + 1 : byte == kSyncWord[0] ? 1 : 0;
    if (matched == sizeof(kSyncWord)) return at + 1 - static_cast<std::int64_t>(matched);
  }
  return size;
}

void check_is_log(const std::string& path) {
  // A pipe of the shell is none either: a log is read here and there.
  if (const std::string kind = kind_of_no_file(path); !kind.empty())
    throw config::UsageError(path + ": is " + kind +
                             "; give a log that lcm-logger or a camera's --log made");
  if (!std::filesystem::is_regular_file(path))
    throw config::UsageError(path + ": no such file; give a log made by lcm-logger");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw config::UsageError(path + ": cannot be read; check its permissions");
  char head[sizeof(kSyncWord)] = {};
  in.read(head, sizeof(head));
  if (in.gcount() == 0) throw config::UsageError(path + ": is empty; was the logger running?");
  if (in.gcount() != sizeof(head) || std::memcmp(head, kSyncWord, sizeof(head)) != 0)
    throw config::UsageError(path + ": is no LCM log; give a log made by lcm-logger");
}

[[noreturn]] void refuse_to_write(const std::string& path) {
  throw config::UsageError(path + ": cannot be written (" + std::strerror(errno) + ")");
}

// A pipe that nobody reads fails at once, where it would be waited for without O_NONBLOCK.
int open_to_write(const std::string& path) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor < 0) refuse_to_write(path);
  return descriptor;
}

}  // namespace

LogReader::LogReader(const std::string& path) {
  check_is_log(path);
  size_bytes_ = static_cast<std::int64_t>(std::filesystem::file_size(path));
  file_ = std::make_unique<lcm::LogFile>(path, "r");
  if (!file_->good()) throw config::UsageError(path + ": cannot be opened");
}

std::optional<LogEvent> LogReader::next() {
  std::FILE* file = file_->getFilePtr();
  for (std::int64_t from = position_bytes_; from < size_bytes_;) {
    const lcm::LogEvent* event = file_->readNextEvent();
    if (event != nullptr) {
      const auto end = static_cast<std::int64_t>(std::ftell(file));
      const auto length =
          kHeaderBytes + static_cast<std::int64_t>(event->channel.size()) + event->datalen;
      damaged_bytes_ += end - length - position_bytes_;
      position_bytes_ = end;
      const auto* data = static_cast<const std::uint8_t*>(event->data);
      return LogEvent{
          event->timestamp, event->channel, {data, data + event->datalen}, event->eventnum};
    }
    // LCM gives up at the first event that is not whole; the next one may begin behind its header.
    from = find_sync_word(file, from + 1, size_bytes_);
    std::fseek(file, static_cast<long>(from), SEEK_SET);
  }
  torn_bytes_ = size_bytes_ - position_bytes_;
  at_end_ = true;
  return std::nullopt;
}

void LogReader::seek(std::int64_t position_bytes) {
  std::fseek(file_->getFilePtr(), static_cast<long>(position_bytes), SEEK_SET);
  position_bytes_ = position_bytes;
  at_end_ = false;
}

FileLock::FileLock(const std::string& path) : OutputLock(open_to_write(path), path, "file") {}

LogWriter::LogWriter(const std::string& path)
    : path_(path), lock_(path), log_(lcm_eventlog_create(path.c_str(), "w")) {
  if (log_ == nullptr) refuse_to_write(path);
}

LogWriter::~LogWriter() {
  if (log_ != nullptr) lcm_eventlog_destroy(log_);
}

void LogWriter::write(const LogEvent& event) {
  lcm_eventlog_event_t out{};
  out.timestamp = event.utime;
  out.channellen = static_cast<std::int32_t>(event.channel.size());
  out.channel = const_cast<char*>(event.channel.c_str());
  out.datalen = static_cast<std::int32_t>(event.data.size());
  out.data = const_cast<std::uint8_t*>(event.data.data());
  if (lcm_eventlog_write_event(log_, &out) != 0) fail();
}

void LogWriter::copy(const LogEvent& event) {
  log_->eventcount = event.number;
  write(event);
}

void LogWriter::close() {
  if (log_ == nullptr) return;
  if (std::fflush(log_->f) != 0) fail();
  lcm_eventlog_destroy(log_);
  log_ = nullptr;
}

void LogWriter::fail() const {
  throw std::runtime_error(path_ + ": cannot be written (" + std::strerror(errno) +
                           "); what was written so far is kept");
}

std::string torn_end(const std::string& log, std::int64_t torn_bytes) {
  return log + ": is torn, its last " + std::to_string(torn_bytes) +
         " bytes are no whole message and were left out";
}

}  // namespace limbcast::lcm_io
