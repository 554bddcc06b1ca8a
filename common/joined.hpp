#pragma once

#include <boost/algorithm/string/join.hpp>
#include <string>

namespace limbcast {

/// "left, right, depth".
template <class Names>
std::string joined(const Names& names) {
  return boost::algorithm::join(names, ", ");
}

}  // namespace limbcast
