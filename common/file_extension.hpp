#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace limbcast {

/// The end of a file's name in small letters, e.g. ".pcd": others write .PCD too.
inline std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace limbcast
