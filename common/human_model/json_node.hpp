#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

namespace limbcast {

/// A place in a JSON file that knows its name, so that errors say file and key.
class JsonNode {
 public:
  /// Throws InputError where the text is no JSON. `file` must outlive the nodes.
  static nlohmann::json parse(const std::string& file, const std::string& text);
  JsonNode(const std::string& file, const nlohmann::json& value, std::string key = "")
      : file_(&file), value_(&value), key_(std::move(key)) {}

  bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }
  JsonNode at(const std::string& key) const;
  /// Element of an array that must have as many.
  JsonNode element(std::size_t index) const;
  std::size_t size() const;

  double number(double min, double max) const;
  int whole(int min, int max) const;
  std::string text() const;
  /// Three numbers, not all zero, scaled to length one.
  Eigen::Vector3f direction() const;

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  std::string key_;
};

}  // namespace limbcast
