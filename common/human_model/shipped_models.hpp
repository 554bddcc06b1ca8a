#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace limbcast {

/// Text of the model file that ships as `name` (data/NAME.json); nothing for another name.
std::optional<std::string_view> shipped_model(const std::string& name);
/// Their names, separated by commas.
std::string shipped_model_names();

}  // namespace limbcast
