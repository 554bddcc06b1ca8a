#include "modules/status/table.hpp"

#include <algorithm>

#include "common/formatted.hpp"

namespace limbcast::status {
namespace {

constexpr const char* kRed = "\033[31m";
constexpr const char* kYellow = "\033[33m";
constexpr const char* kPlain = "\033[0m";

std::string milliseconds(const std::optional<double>& value) {
  return value ? formatted("%.0f", *value) : "-";
}

std::string cut_to(std::string line, int width) {
  if (width > 0 && static_cast<int>(line.size()) > width)
    line.resize(static_cast<std::size_t>(width));
  return line;
}

std::string head() {
  return formatted("%-12s %-15s %-8s %6s %6s %6s %6s %7s %7s %7s %5s  %-8s %s", "host", "module",
                   "state", "in/s", "out/s", "p50 ms", "p99 ms", "lost", "skipped", "malform",
                   "age s", "version", "pid");
}

std::string line_of(const Row& row) {
  const lcm_io::ModuleStatus& status = row.status;
  if (row.state == "missing")
    return formatted("%-12s %-15s %-8s", "-", status.module.c_str(), row.state.c_str());
  return formatted("%-12s %-15s %-8s %6.1f %6.1f %6s %6s %7lld %7lld %7lld %5.1f  %-8s %d",
                   status.host.c_str(), status.module.c_str(), row.state.c_str(), status.rate_in_hz,
                   status.rate_out_hz, milliseconds(status.latency_p50_ms).c_str(),
                   milliseconds(status.latency_p99_ms).c_str(), static_cast<long long>(status.lost),
                   static_cast<long long>(status.skipped), static_cast<long long>(status.malformed),
                   row.age_s, status.version.c_str(), status.pid);
}

std::string colored(const std::string& line, const Row& row, bool color) {
  if (!color || row.state == "running") return line;
  return (row.is_in_error() ? kRed : kYellow) + line + kPlain;
}

}  // namespace

std::string table_text(const std::vector<Row>& rows, bool color, int width) {
  std::string text = cut_to(head(), width) + '\n';
  for (const Row& row : rows) {
    text += colored(cut_to(line_of(row), width), row, color) + '\n';
    if (!row.status.note.empty()) text += cut_to("    " + row.status.note, width) + '\n';
    if (!row.status.last_error.empty())
      text += cut_to("    last error: " + row.status.last_error, width) + '\n';
  }
  const auto errors =
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.is_in_error(); });
  text += formatted("%zu modules, %lld in error\n", rows.size(), static_cast<long long>(errors));
  return text;
}

}  // namespace limbcast::status
