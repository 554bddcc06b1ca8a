#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace limbcast {

/// More than a robot has.
inline constexpr std::size_t kMostSensors = 32;

/// What is known by a name that came over the network, where anyone can make names up: of more than
/// `most` the one that was not asked for the longest is forgotten.
template <class Value>
class BoundedMap {
 public:
  explicit BoundedMap(std::size_t most = kMostSensors) : most_(most) {}

  /// The value of that name; made of `arguments` where it is new, or was forgotten.
  template <class... Arguments>
  Value& get(const std::string& name, const Arguments&... arguments) {
    auto entry = entries_.find(name);
    if (entry == entries_.end()) {
      if (entries_.size() >= most_) forget_oldest();
      entry = entries_.emplace(name, Entry{Value(arguments...), 0}).first;
    }
    entry->second.last_use = ++uses_;
    return entry->second.value;
  }

  /// Null where the name is not known. Does not count as asking.
  const Value* find(const std::string& name) const {
    const auto entry = entries_.find(name);
    return entry == entries_.end() ? nullptr : &entry->second.value;
  }

  /// Calls `visit(name, value)` for all, by name.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [name, entry] : entries_) visit(name, entry.value);
  }

 private:
  struct Entry {
    Value value;
    std::uint64_t last_use;
  };

  void forget_oldest() {
    entries_.erase(std::min_element(
        entries_.begin(), entries_.end(),
        [](const auto& a, const auto& b) { return a.second.last_use < b.second.last_use; }));
  }

  std::size_t most_;
  std::map<std::string, Entry> entries_;
  std::uint64_t uses_ = 0;
};

}  // namespace limbcast
