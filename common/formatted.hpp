#pragma once

#include <cstdarg>
#include <cstdio>
#include <string>

namespace limbcast {

/// printf into a string of the length that it takes.
[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, format, values);
  va_end(values);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

/// "640x480".
inline std::string size_text(long width, long height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace limbcast
