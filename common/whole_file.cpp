#include "common/whole_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace limbcast {
namespace {

namespace fs = std::filesystem;

/// Throws std::system_error where that fails.
void write(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::system_error(errno, std::generic_category());
}

/// What the shell has opened as /dev/stdout or /dev/fd/3.
std::optional<int> opened_descriptor(const std::string& path) {
  const auto is_descriptor = [](const fs::path& place) {
    std::error_code unreachable;
    return fs::exists(place, unreachable) &&
           fs::equivalent(place.parent_path(), "/proc/self/fd", unreachable);
  };
  std::error_code no_link;
  fs::path place = path;
  if (!is_descriptor(place)) place = fs::read_symlink(place, no_link);
  if (!is_descriptor(place)) return std::nullopt;
  return std::stoi(place.filename());
}

/// Behind what was written to it before: opened anew, by its name, a file would be written from its
/// begin.
void write(int descriptor, std::string_view bytes) {
  std::fflush(stdout);
  while (!bytes.empty()) {
    const ssize_t size = ::write(descriptor, bytes.data(), bytes.size());
    if (size < 0) throw std::system_error(errno, std::generic_category());
    bytes.remove_prefix(static_cast<std::size_t>(size));
  }
}

/// No file may take the place of a pipe, a terminal or /dev/null, nor of a file that the shell has
/// opened as /dev/stdout.
bool is_device(const std::string& path) {
  std::error_code unreachable;
  return fs::is_other(path, unreachable) || path.rfind("/dev/", 0) == 0;
}

/// The file that a link leads to or, where nothing stands there yet, is to be written to.
fs::path end_of_links(const fs::path& path) {
  std::error_code leads_nowhere, is_no_link;
  const fs::path end = fs::canonical(path, leads_nowhere);
  if (!leads_nowhere) return end;
  const bool is_a_ring = leads_nowhere == std::errc::too_many_symbolic_link_levels;
  const fs::path next = is_a_ring ? fs::path() : fs::read_symlink(path, is_no_link);
  return next.empty() ? path : end_of_links(path.parent_path() / next);
}

std::string unfinished_beside(const fs::path& path, const std::string& ending = "") {
  return path.string() + ".unfinished" + ending;
}

/// A file may be the user's in a folder that is not, and none takes the place of one that a
/// container has mounted.
bool can_only_be_overwritten(const std::system_error& error) {
  const int reason = error.code().value();
  return reason == EACCES || reason == EPERM || reason == EBUSY;
}

/// Under another name beside it until it is whole, where that can be.
void write_beside(const fs::path& path, std::string_view bytes) {
  const fs::path unfinished = unfinished_beside(path);
  try {
    write(unfinished, bytes);
    fs::rename(unfinished, path);
  } catch (const std::system_error& error) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    if (!can_only_be_overwritten(error)) throw;
    write(path, bytes);
  }
}

}  // namespace

void write_whole_file(const std::string& path, std::string_view bytes) {
  try {
    if (const auto descriptor = opened_descriptor(path))
      write(*descriptor, bytes);
    else
      is_device(path) ? write(path, bytes) : write_beside(end_of_links(path), bytes);
  } catch (const std::system_error& error) {
    throw std::runtime_error(path + ": cannot be written (" + std::strerror(error.code().value()) +
                             ")");
  }
}

void write_whole_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  write_whole_file(path,
                   std::string_view{reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string unfinished_file(const std::string& path, const std::string& ending) {
  if (is_device(path)) return path;
  const fs::path end = end_of_links(path);
  const fs::path folder = end.has_parent_path() ? end.parent_path() : ".";
  return access(folder.c_str(), W_OK) == 0 ? unfinished_beside(end, ending) : path;
}

void finish_file(const std::string& path, const std::string& ending) {
  const std::string unfinished = unfinished_file(path, ending);
  if (unfinished == path) return;
  std::error_code error;
  fs::rename(unfinished, end_of_links(path), error);
  if (error)
    throw std::runtime_error(path + ": cannot be written (" + error.message() + "); " + unfinished +
                             " holds it");
}

}  // namespace limbcast
