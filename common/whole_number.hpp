#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace limbcast {

/// The value where it is a whole number that fits the type: a longer one would be wrapped.
template <class Integer>
std::optional<Integer> whole_number(const nlohmann::json& value) {
  using Limits = std::numeric_limits<Integer>;
  if (!value.is_number_integer()) return std::nullopt;
  if (value.is_number_unsigned() &&
      value.get<std::uint64_t>() > static_cast<std::uint64_t>(Limits::max()))
    return std::nullopt;
  const auto number = value.get<std::int64_t>();
  if (number < Limits::min()) return std::nullopt;
  return static_cast<Integer>(number);
}

/// For errors: "a whole number of 32 bits".
template <class Integer>
std::string whole_number_text() {
  return "a whole number of " + std::to_string(8 * sizeof(Integer)) + " bits";
}

}  // namespace limbcast
