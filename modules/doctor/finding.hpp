#pragma once

#include <string>
#include <vector>

namespace limbcast::doctor {

enum class Level {
  kGood,     ///< was checked and is as it should be
  kNote,     ///< worth knowing; costs limbcast nothing
  kProblem,  ///< costs messages, time or safety
};

struct Finding {
  Level level;
  std::string check;  ///< what was looked at, e.g. "multicast route"
  std::string text;   ///< what was found
  std::string
      command;  ///< what mends it, to be typed as it stands; empty where no command mends it
};

using Findings = std::vector<Finding>;

}  // namespace limbcast::doctor
