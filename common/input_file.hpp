#pragma once

#include <linux/magic.h>
#include <sys/vfs.h>

#include <filesystem>
#include <string>

#include "common/input_error.hpp"

namespace limbcast {

/// What stands at the path where it is no file, in which reading could wait or go on for ever: "a
/// folder", "a pipe", "a device" or "a socket". Empty for a file, and where nothing is there.
inline std::string kind_of_no_file(const std::string& path) {
  std::error_code unreachable;
  switch (std::filesystem::status(path, unreachable).type()) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character:
      return "a device";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "";
  }
}

/// A pipe that somebody writes to already, as a shell makes one for "<(command)" and "|
/// /dev/stdin". It can be read once, from begin to end.
inline bool is_open_pipe(const std::string& path) {
  struct statfs file_system {};
  return statfs(path.c_str(), &file_system) == 0 && file_system.f_type == PIPEFS_MAGIC;
}

/// The same of what is read once, from begin to end: empty for pipes of the shell too.
inline std::string kind_of_no_stream(const std::string& path) {
  return is_open_pipe(path) ? "" : kind_of_no_file(path);
}

/// For what is read once. Throws InputError, with `remedy` ("give a picture") at its end, for all
/// but files, pipes of the shell, and what the reader will find to be missing.
inline void check_is_file(const std::string& path, const std::string& remedy) {
  const std::string kind = kind_of_no_stream(path);
  if (!kind.empty()) throw InputError(path + ": is " + kind + "; " + remedy);
}

}  // namespace limbcast
