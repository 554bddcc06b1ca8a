#pragma once

#include <string>

namespace limbcast::calibrate {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace limbcast::calibrate
