#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>
#include <string>
#include <vector>

namespace limbcast {

/// Reads values from an OpenCV FileStorage or ROS YAML file. Whatever is missing or of the wrong
/// kind throws InputError with file, key, what was found and what to do.
class YamlReader {
 public:
  explicit YamlReader(const std::string& path);

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const;
  /// The first of `keys` that the file has; the first one where it has none.
  std::string first_of(const std::vector<std::string>& keys) const;

  /// A whole number as it stands in the file, of any length.
  double integer(const std::string& key) const;
  double number(const std::string& key) const;
  std::string text(const std::string& key) const;
  /// All numbers of a matrix (row by row) or list; finite.
  std::vector<double> numbers(const std::string& key) const;
  /// A matrix that must have this size (one row or column: either way round).
  Eigen::MatrixXd matrix(const std::string& key, int rows, int cols) const;

  /// Throws InputError "file: 'key' found; advice".
  [[noreturn]] void fail(const std::string& key, const std::string& found,
                         const std::string& advice) const;

 private:
  cv::FileNode node(const std::string& key) const;

  std::string path_;
  cv::FileStorage storage_;
};

}  // namespace limbcast
