#pragma once

#include <string>
#include <string_view>

namespace limbcast::config {

/// Some editors put these bytes before UTF-8 text; they are no part of it.
inline std::string without_byte_order_mark(const std::string& text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.rfind(kMark, 0) == 0 ? text.substr(kMark.size()) : text;
}

}  // namespace limbcast::config
