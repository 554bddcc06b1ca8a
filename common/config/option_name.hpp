#pragma once

#include <algorithm>
#include <string>

namespace limbcast::config {

/// "pose_fitter.method" -> "pose_fitter", "method".
struct OptionName {
  std::string section, key;
};

inline OptionName section_and_key(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return {"", name};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

inline std::string with_hyphens(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return key;
}

}  // namespace limbcast::config
