#include "tests/support/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace limbcast::test {
namespace {

int exit_code_of(int status) {
  constexpr int kSignalBase = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
}

[[noreturn]] void execute(const std::vector<std::string>& command, const std::string& output) {
  constexpr int kCannotExecute = 127;
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(kCannotExecute);
}

/// Holds the folders of this process's tests. They stay for a look where a test failed.
class ProcessFolder {
 public:
  ~ProcessFolder() {
    std::error_code ignored;
    if (::testing::UnitTest::GetInstance()->Passed()) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  const std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / ("limbcast." + std::to_string(getpid()));
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& output,
                           const std::vector<std::string>& environment)
    : output_(output) {
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ > 0) return;
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  execute(command, output);
}

ChildProcess::~ChildProcess() {
  if (exit_code_) return;
  ::kill(pid_, SIGKILL);
  wait();
}

void ChildProcess::signal(int number) const { ::kill(pid_, number); }

bool ChildProcess::running() {
  if (exit_code_) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == 0) return true;
  exit_code_ = exit_code_of(status);
  return false;
}

int ChildProcess::wait() {
  int status = 0;
  if (!exit_code_) {
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    exit_code_ = exit_code_of(status);
  }
  return *exit_code_;
}

std::string ChildProcess::output() const {
  std::ifstream in(output_, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

RunResult run(const std::vector<std::string>& command) {
  const std::string output =
      (std::filesystem::path(temporary_folder("run")) / "output.txt").string();
  ChildProcess child(command, output);
  const int exit_code = child.wait();
  return {exit_code, child.output()};
}

std::string program(const std::string& name) { return std::string(LIMBCAST_BIN_DIR) + "/" + name; }

std::string repository_file(const std::string& path) {
  return std::string(LIMBCAST_SOURCE_DIR) + "/" + path;
}

std::string temporary_folder(const std::string& name) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string test =
      info == nullptr ? "no_test" : std::string(info->test_suite_name()) + "." + info->name();
  for (char& c : test)
    if (c == '/') c = '_';
  static const ProcessFolder process_folder;
  const auto folder = process_folder.path() / test / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

std::string private_lcm_url() {
  // Ports 20000 to 51999: beside the well-known ones and LCM's own.
  return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 32000) +
         "?ttl=0&recv_buf_size=2000000";
}

}  // namespace limbcast::test
