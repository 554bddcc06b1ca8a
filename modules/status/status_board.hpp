#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "common/lcm_io/module_status_codec.hpp"

namespace limbcast::status {

struct BoardParams {
  /// A module that was not heard for so long is silent [s]: three of its messages are missing.
  double silent_after_s = 3.0;
  /// Then it leaves the table [s].
  double forget_after_s = 60.0;
  /// No more modules than a robot can have: who floods the channel fills no memory.
  std::size_t max_modules = 500;
};

/// One line of the table.
struct Row {
  lcm_io::ModuleStatus status;
  double age_s = 0.0;  ///< since its last message
  /// As the module says, or "silent" (not heard any more), "missing" (expected, never heard).
  std::string state;

  /// Failing, silent or missing.
  bool is_in_error() const;
};

/// What all modules of all hosts told last. Knows no clock: each call is told the time [s].
class StatusBoard {
 public:
  /// `expected`: names of modules that must be there, on any host.
  explicit StatusBoard(std::vector<std::string> expected = {}, const BoardParams& params = {})
      : expected_(std::move(expected)), params_(params) {}

  void take(const lcm_io::ModuleStatus& status, double now_s);

  /// By host, module and process number; the missing ones at the end. A silent process whose place
  /// another of the same kind took on the same host is left out: it was started again.
  std::vector<Row> rows(double now_s);

 private:
  using Key = std::tuple<std::string, std::string, int>;
  struct Entry {
    lcm_io::ModuleStatus status;
    double heard_s = 0.0;
  };
  void forget_old(double now_s);
  bool is_silent(const Entry& entry, double now_s) const;
  bool was_replaced(const Entry& entry, double now_s) const;

  std::vector<std::string> expected_;
  BoardParams params_;
  std::map<Key, Entry> entries_;
};

}  // namespace limbcast::status
