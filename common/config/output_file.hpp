#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace limbcast::config {

/// Throws UsageError where no file can be written to `path`, which the user gave to `option` (e.g.
/// "--output"); an empty path is none given. To be asked before the work whose result goes there:
/// it may take minutes. `inputs` are files that are read: to be written over one of them is refused
/// too.
void check_output_file(const std::string& option, const std::string& path,
                       const std::vector<std::string>& inputs = {});

/// Throws UsageError where two options give the same file: one would be written over the other.
void check_outputs_differ(const std::string& option, const std::string& path,
                          const std::string& other_option, const std::string& other_path);

/// What is wrong where stdout takes no more, with the reason where one is known (errno).
std::runtime_error cannot_write_to_stdout();

/// Makes the folder that the user gave to `option` where it is missing. Throws UsageError where
/// that is not possible.
void make_output_folder(const std::string& option, const std::string& path);

/// Keeps what is written from other processes that lock it too, while it lives.
class OutputLock {
 public:
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 protected:
  /// Of a file that was opened, closed at the end; `kind`: what the user may choose another of.
  /// Throws UsageError where another process holds it. File systems without locks go without.
  OutputLock(int descriptor, const std::string& path, const std::string& kind);

 private:
  int descriptor_;
};

/// That of a folder.
class FolderLock : public OutputLock {
 public:
  /// Throws UsageError where another process holds it.
  explicit FolderLock(const std::string& path);
};

}  // namespace limbcast::config
