#pragma once

#include <string>

#include "modules/doctor/finding.hpp"
#include "modules/doctor/traffic.hpp"

namespace limbcast::doctor {

bool has_problem(const Findings& findings);

/// A line for each finding, and one with the command that mends it.
std::string report_text(const Findings& findings);
/// {"host":…,"url":…,"good":…,"findings":[{"level","check","text","command"}],"channels":{…}}
std::string report_json(const Findings& findings, const Traffic& traffic, const std::string& host,
                        const std::string& url);

}  // namespace limbcast::doctor
