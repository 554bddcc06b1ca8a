#pragma once

#include <string>
#include <vector>

#include "modules/status/status_board.hpp"

namespace limbcast::status {

/// The table, a line a module, with its last error below it. `color`: states in colour, for
/// terminals. `width`: longer lines are cut, 0: not.
std::string table_text(const std::vector<Row>& rows, bool color = false, int width = 0);

}  // namespace limbcast::status
