#include "common/config/log.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace limbcast::config {
namespace {

constexpr std::array<const char*, 4> kLevelNames = {"ERROR", "WARNING", "INFO", "DEBUG"};

/// How a line begins to get its level in systemd's journal: sd-daemon(3).
constexpr std::array<const char*, 4> kJournalPriorities = {"<3>", "<4>", "<6>", "<7>"};

std::string& module_name() {
  static std::string name = "limbcast";
  return name;
}

/// systemd names device and inode of the journal's stream; stderr may have been redirected since.
bool stderr_is_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat file {};
  return stream != nullptr && fstat(STDERR_FILENO, &file) == 0 &&
         stream == std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino);
}

/// Empty where stderr is not the journal.
const char* priority_of(LogLevel level) {
  static const bool kToJournal = stderr_is_journal();
  return kToJournal ? kJournalPriorities[static_cast<int>(level)] : "";
}

LogLevel& highest_level() {
  static LogLevel level = LogLevel::kInfo;
  return level;
}

/// What is quoted may hold line breaks, as a pipeline that was written in several lines does: one
/// blank stands for each, and for the blanks around it; none at the end.
std::string in_one_line(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  std::string line = text;
  for (std::size_t at = line.find_first_of("\r\n"); at != std::string::npos;
       at = line.find_first_of("\r\n")) {
    const std::size_t end = std::min(line.find_first_not_of(kBlanks, at), line.size());
    const std::size_t begin = line.find_last_not_of(kBlanks, at) + 1;
    line.replace(begin, end - begin, end == line.size() ? "" : " ");
  }
  return line;
}

}  // namespace

void configure_log(const std::string& module, const std::string& level) {
  module_name() = module;
  if (level == "error") highest_level() = LogLevel::kError;
  if (level == "warning") highest_level() = LogLevel::kWarning;
  if (level == "info") highest_level() = LogLevel::kInfo;
  if (level == "debug") highest_level() = LogLevel::kDebug;
}

void log(LogLevel level, const std::string& text) {
  if (level > highest_level()) return;
  // One call a line: stdio locks the stream, so lines of several threads do not mix.
  std::fprintf(stderr, "%s%s %s %s\n", priority_of(level), module_name().c_str(),
               kLevelNames[static_cast<int>(level)], in_one_line(text).c_str());
}

void log_failure(const std::string& program, const std::string& text) {
  std::fprintf(stderr, "%s%s: %s\n", priority_of(LogLevel::kError), program.c_str(),
               in_one_line(text).c_str());
}

}  // namespace limbcast::config
