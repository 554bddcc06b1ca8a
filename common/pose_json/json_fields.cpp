#include "common/pose_json/json_fields.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/input_error.hpp"
#include "common/whole_number.hpp"

namespace limbcast::pose_json {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& key, const std::string& found) {
  throw InputError(where + ": '" + key + "' " + found);
}

template <class Integer>
Integer to_integer(const nlohmann::json& value, const std::string& key, const std::string& where) {
  const auto number = whole_number<Integer>(value);
  if (!number) fail(where, key, "must be " + whole_number_text<Integer>() + ", is " + value.dump());
  return *number;
}

}  // namespace

const nlohmann::json& required(const nlohmann::json& object, const std::string& key,
                               const std::string& where) {
  if (!object.is_object()) fail(where, key, "is looked for, but no JSON object stands here");
  const auto found = object.find(key);
  if (found == object.end()) fail(where, key, "is missing");
  return *found;
}

std::int64_t integer(const nlohmann::json& object, const std::string& key,
                     const std::string& where) {
  return to_integer<std::int64_t>(required(object, key, where), key, where);
}

std::int32_t integer_or(const nlohmann::json& object, const std::string& key,
                        std::int32_t otherwise, const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  return to_integer<std::int32_t>(*found, key, where);
}

Eigen::Vector3f vector3(const nlohmann::json& value, const std::string& what,
                        const std::string& where) {
  if (!value.is_array() || value.size() != 3) fail(where, what, "must be three numbers");
  Eigen::Vector3f vector;
  for (int i = 0; i < 3; ++i) {
    if (!value[i].is_number()) fail(where, what, "must be three numbers");
    vector[i] = value[i].get<float>();
    if (!std::isfinite(vector[i])) fail(where, what, "is not finite");
  }
  return vector;
}

Eigen::Vector3f direction(const nlohmann::json& value, const std::string& what,
                          const std::string& where) {
  const Eigen::Vector3f vector = vector3(value, what, where);
  if (vector.norm() < 1e-6F) fail(where, what, "has no direction");
  return vector.normalized();
}

Side side(const nlohmann::json& object, const std::string& where) {
  const nlohmann::json& value = required(object, "side", where);
  if (value == "left") return Side::kLeft;
  if (value == "right") return Side::kRight;
  fail(where, "side", "must be \"left\" or \"right\"");
}

float number_or(const nlohmann::json& object, const std::string& key, float otherwise,
                const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  if (!found->is_number()) fail(where, key, "must be a number");
  const auto number = found->get<float>();
  if (!std::isfinite(number)) fail(where, key, "is not finite");
  return number;
}

}  // namespace limbcast::pose_json
