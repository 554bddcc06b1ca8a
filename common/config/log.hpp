#pragma once

#include <string>

namespace limbcast::config {

enum class LogLevel { kError = 0, kWarning = 1, kInfo = 2, kDebug = 3 };

/// Names the program in each line and says what is written. Call once, before threads start.
void configure_log(const std::string& module, const std::string& level);

/// One line on stderr: "module LEVEL text". Safe to call from any thread.
void log(LogLevel level, const std::string& text);

/// The one line with which a program says why it fails: "program: text".
void log_failure(const std::string& program, const std::string& text);

}  // namespace limbcast::config
