#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "common/human_model/joints.hpp"

namespace limbcast::pose_json {

/// Reads a field of a JSON object; throws InputError "where: 'key' ..." where it is missing or of
/// the wrong kind. `where` names file and line.
const nlohmann::json& required(const nlohmann::json& object, const std::string& key,
                               const std::string& where);
std::int64_t integer(const nlohmann::json& object, const std::string& key,
                     const std::string& where);
/// A whole number of 32 bits where the key is there and not null, else `otherwise`.
std::int32_t integer_or(const nlohmann::json& object, const std::string& key,
                        std::int32_t otherwise, const std::string& where);
/// Three finite numbers.
Eigen::Vector3f vector3(const nlohmann::json& value, const std::string& what,
                        const std::string& where);
/// Three finite numbers that are a direction; scaled to unit length.
Eigen::Vector3f direction(const nlohmann::json& value, const std::string& what,
                          const std::string& where);
/// "left" or "right".
Side side(const nlohmann::json& object, const std::string& where);
/// A finite number where the key is there and not null, else `otherwise`.
float number_or(const nlohmann::json& object, const std::string& key, float otherwise,
                const std::string& where);

}  // namespace limbcast::pose_json
