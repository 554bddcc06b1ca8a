#pragma once

#include <string>
#include <vector>

namespace limbcast::config {

/// The lines of a configuration file that set `key` ("threads") of `section` ("pose_fitter", empty:
/// before the first one), counted from 1.
std::vector<int> lines_that_set(const std::string& section, const std::string& key,
                                const std::string& text);

}  // namespace limbcast::config
