#pragma once

#include <string>

namespace limbcast {

/// "left, right, depth".
template <class Names>
std::string joined(const Names& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace limbcast
