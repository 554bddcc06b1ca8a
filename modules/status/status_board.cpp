#include "modules/status/status_board.hpp"

#include <algorithm>

namespace limbcast::status {

bool Row::is_in_error() const {
  return state == "failing" || state == "silent" || state == "missing";
}

void StatusBoard::take(const lcm_io::ModuleStatus& status, double now_s) {
  const Key key{status.host, status.module, status.pid};
  if (entries_.size() >= params_.max_modules && entries_.count(key) == 0) return;
  entries_[key] = {status, now_s};
}

std::vector<Row> StatusBoard::rows(double now_s) {
  forget_old(now_s);
  std::vector<Row> rows;
  for (const auto& [key, entry] : entries_) {
    if (was_replaced(entry, now_s)) continue;
    rows.push_back({entry.status, now_s - entry.heard_s,
                    is_silent(entry, now_s) ? "silent" : entry.status.state});
  }
  for (const std::string& name : expected_) {
    const bool heard = std::any_of(rows.begin(), rows.end(),
                                   [&](const Row& row) { return row.status.module == name; });
    if (heard) continue;
    Row row;
    row.status.module = name;
    row.state = "missing";
    rows.push_back(row);
  }
  return rows;
}

void StatusBoard::forget_old(double now_s) {
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    const bool old = now_s - entry->second.heard_s > params_.forget_after_s;
    entry = old ? entries_.erase(entry) : std::next(entry);
  }
}

bool StatusBoard::is_silent(const Entry& entry, double now_s) const {
  return now_s - entry.heard_s > params_.silent_after_s;
}

bool StatusBoard::was_replaced(const Entry& entry, double now_s) const {
  if (!is_silent(entry, now_s)) return false;
  return std::any_of(entries_.begin(), entries_.end(), [&](const auto& other) {
    const lcm_io::ModuleStatus& status = other.second.status;
    return status.host == entry.status.host && status.module == entry.status.module &&
           status.pid != entry.status.pid && !is_silent(other.second, now_s);
  });
}

}  // namespace limbcast::status
