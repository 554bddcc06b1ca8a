#pragma once

#include <string>
#include <vector>

#include "modules/evaluate/evaluation.hpp"

namespace limbcast::evaluate {

/// All NAME_gt.json of the folders, in order of time. `bodies`: count only persons whose body's
/// name begins with one of these ("D4" for "D4_woman_older"); empty: all. Throws InputError for a
/// folder without truth, a wrong file, two of the same utime, or where no person has one of the
/// bodies.
std::vector<TruthFrame> read_truth_folders(const std::vector<std::string>& folders,
                                           const std::vector<std::string>& bodies = {});

/// Their files. Throws InputError for a folder without truth.
std::vector<std::string> truth_files(const std::vector<std::string>& folders);

/// "a,b" -> {"a", "b"}; empty parts are dropped.
std::vector<std::string> split_list(const std::string& text);

}  // namespace limbcast::evaluate
