#include "common/config/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/config/options.hpp"
#include "common/whole_file.hpp"

namespace limbcast::config {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// `written`: the path, or the folder in which it is made.
void check_writable(const std::string& path, const std::string& written,
                    const std::string& option) {
  if (access(written.c_str(), W_OK) == 0) return;
  throw UsageError(path + ": cannot be written (" + std::strerror(errno) + "); choose another " +
                   option);
}

}  // namespace

void check_output_file(const std::string& option, const std::string& path,
                       const std::vector<std::string>& inputs) {
  if (path.empty()) return;
  std::error_code ignored;
  for (const std::string& input : inputs) {
    for (const std::string& written : {path, unfinished_file(path)}) {
      if (fs::equivalent(written, input, ignored))
        throw UsageError(written + ": is what is read; choose another " + option);
    }
  }
  if (fs::is_directory(path, ignored))
    throw UsageError(path + ": is a folder; give a file to " + option);
  const std::string folder = folder_of(path);
  if (!fs::is_directory(folder, ignored))
    throw UsageError(path + ": there is no folder " + folder + "; make it or choose another " +
                     option);
  check_writable(path, fs::exists(path, ignored) ? path : folder, option);
}

void check_outputs_differ(const std::string& option, const std::string& path,
                          const std::string& other_option, const std::string& other_path) {
  if (path.empty() || other_path.empty()) return;
  if (fs::weakly_canonical(path) == fs::weakly_canonical(other_path))
    throw UsageError(path + ": is what " + other_option + " writes; choose another " + option);
}

std::runtime_error cannot_write_to_stdout() {
  const std::string reason = errno == 0 ? "" : std::string(" (") + std::strerror(errno) + ")";
  return std::runtime_error("cannot write to stdout" + reason);
}

void make_output_folder(const std::string& option, const std::string& path) {
  std::error_code reason, ignored;
  fs::create_directories(path, reason);
  if (fs::is_directory(path, ignored)) return check_writable(path, path, option);
  if (fs::exists(path, ignored)) throw UsageError(path + ": is no folder; give one to " + option);
  throw UsageError(path + ": cannot be made (" + reason.message() + "); choose another " + option);
}

OutputLock::OutputLock(int descriptor, const std::string& path, const std::string& kind)
    : descriptor_(descriptor) {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw UsageError(path + ": is being written by another process; choose another " + kind);
}

OutputLock::~OutputLock() { close(descriptor_); }

FolderLock::FolderLock(const std::string& path)
    : OutputLock(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC), path, "folder") {}

}  // namespace limbcast::config
