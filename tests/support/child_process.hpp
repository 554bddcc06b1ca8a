#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace limbcast::test {

/// A program that a test runs; killed with the test if it still runs.
class ChildProcess {
 public:
  /// Starts `command` (program and arguments); stdout and stderr go to the file `output`.
  ChildProcess(const std::vector<std::string>& command, const std::string& output,
               const std::vector<std::string>& environment = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  bool running();
  /// Waits for its end. The exit code, or 128 + signal number.
  int wait();
  /// What it has written so far.
  std::string output() const;

 private:
  pid_t pid_ = -1;
  std::string output_;
  std::optional<int> exit_code_;
};

struct RunResult {
  int exit_code;
  std::string output;
};
/// Runs a program to its end; stdout and stderr together.
RunResult run(const std::vector<std::string>& command);

/// Path of one of our programs, e.g. program("limbcast-replay").
std::string program(const std::string& name);
/// A file of the repository, e.g. repository_file("logs/demo.log").
std::string repository_file(const std::string& path);
/// A folder of this test alone, empty. Removed when the test program ends, unless a test failed.
std::string temporary_folder(const std::string& name);
/// LCM URL of this test alone (by process id), on this host only.
std::string private_lcm_url();

}  // namespace limbcast::test
