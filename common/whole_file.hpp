#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace limbcast {

/// Writes a file, or over the one that a link leads to: it is there whole or, where the program or
/// the disk fails, as it was before, unless only the file itself may be written and nothing beside
/// it. Pipes, terminals and other devices are written to. Throws
/// std::runtime_error, with the reason, where it cannot be written.
void write_whole_file(const std::string& path, std::string_view bytes);
void write_whole_file(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Where a file is to be written that grows for long, so that `path` stays as it was until
/// finish_file: beside it, or `path` itself where that is a device or nothing may stand beside it.
/// Its name ends with `ending` (".avi") where that tells a library the format.
std::string unfinished_file(const std::string& path, const std::string& ending = "");
/// Puts it in its place. Throws std::runtime_error like write_whole_file.
void finish_file(const std::string& path, const std::string& ending = "");

}  // namespace limbcast
