#include "common/human_model/json_node.hpp"

#include <cmath>

#include "common/input_error.hpp"

namespace limbcast {

nlohmann::json JsonNode::parse(const std::string& file, const std::string& text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(file + ": no valid JSON at byte " + std::to_string(error.byte));
  }
}

JsonNode JsonNode::at(const std::string& key) const {
  if (!has(key)) fail("has no '" + key + "'; add it");
  return {*file_, value_->at(key), key_.empty() ? key : key_ + "." + key};
}

JsonNode JsonNode::element(std::size_t index) const {
  return {*file_, value_->at(index), key_ + "[" + std::to_string(index) + "]"};
}

std::size_t JsonNode::size() const {
  if (!value_->is_array()) fail("must be a list");
  return value_->size();
}

double JsonNode::number(double min, double max) const {
  if (!value_->is_number()) fail("is " + value_->dump() + ", must be a number");
  const auto number = value_->get<double>();
  if (!(number >= min && number <= max)) {
    fail("is " + value_->dump() + ", must be " + nlohmann::json(min).dump() + " to " +
         nlohmann::json(max).dump());
  }
  return number;
}

int JsonNode::whole(int min, int max) const {
  const double value = number(min, max);
  if (value != std::floor(value)) fail("is " + value_->dump() + ", must be a whole number");
  return static_cast<int>(value);
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("is " + value_->dump() + ", must be a text");
  return value_->get<std::string>();
}

Eigen::Vector3f JsonNode::direction() const {
  if (!value_->is_array() || value_->size() != 3) fail("must be three numbers [left, up, forward]");
  Eigen::Vector3d direction;
  for (int i = 0; i < 3; ++i) direction[i] = element(static_cast<std::size_t>(i)).number(-1e3, 1e3);
  if (direction.norm() < 1e-6) fail("has no length, must be a direction");
  return direction.normalized().cast<float>();
}

void JsonNode::fail(const std::string& problem) const {
  throw InputError(*file_ + ": " + (key_.empty() ? "the file" : "'" + key_ + "'") + " " + problem);
}

}  // namespace limbcast
