#include "common/camera/yaml_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>

#include "common/config/byte_order_mark.hpp"
#include "common/input_file.hpp"

namespace limbcast {
namespace {

std::string read_text(const std::string& path) {
  check_is_file(path, "give a calibration file");
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw InputError(path + ": cannot be read; give the path of a calibration file");
  if (text.empty()) throw InputError(path + ": is empty; calibrate again or copy the file again");
  return config::without_byte_order_mark(text);
}

/// ROS writes plain YAML; OpenCV's reader wants its own first line.
std::string with_opencv_header(const std::string& text) {
  if (text.rfind("%YAML", 0) == 0 || text.rfind("<?xml", 0) == 0 || text.front() == '{')
    return text;
  return "%YAML:1.0\n" + std::string(text.rfind("---", 0) == 0 ? "" : "---\n") + text;
}

/// Of as many digits a number may have more than 32 bits.
constexpr std::size_t kLongDigits = 10;
constexpr double kSmallestLongNumber = 1e9;

bool is_one_of(const std::string& characters, char character) {
  return characters.find(character) != std::string::npos;
}

/// OpenCV's reader wraps a whole number of more than 32 bits; with a point it is a real.
std::string with_long_numbers_real(const std::string& text) {
  std::string real;
  std::size_t digits = 0;
  for (const char character : text + '\n') {
    if (std::isdigit(static_cast<unsigned char>(character)) != 0) {
      ++digits;
    } else {
      const bool is_long = digits >= kLongDigits && digits < real.size();
      const bool stands_alone = is_long &&
                                is_one_of(" \t\r\n,[:>+-", real[real.size() - digits - 1]) &&
                                is_one_of(" \t\r\n,]}<", character);
      if (stands_alone) real += ".0";
      digits = 0;
    }
    real += character;
  }
  real.pop_back();
  return real;
}

void append_numbers(const cv::FileNode& node, std::vector<double>& numbers) {
  for (const cv::FileNode& value : node) {
    if (value.isSeq()) {
      append_numbers(value, numbers);
    } else {
      const bool is_number = value.isReal() || value.isInt();
      numbers.push_back(is_number ? static_cast<double>(value) : std::nan(""));
    }
  }
}

std::string count_text(std::size_t count) { return "has " + std::to_string(count) + " numbers"; }

std::string size_text(const cv::FileNode& node, std::size_t count) {
  if (!node.isMap() || !node["rows"].isInt() || !node["cols"].isInt()) {
    return count_text(count);
  }
  return "is " + std::to_string(static_cast<int>(node["rows"])) + " x " +
         std::to_string(static_cast<int>(node["cols"]));
}

/// "line 6: Tabs are prohibited in YAML!". OpenCV 4.6 hands on "(6): ..." in the place of the
/// function; `lines_before` are those that the file does not have.
std::string reason_of(const cv::Exception& error, std::ptrdiff_t lines_before) {
  static const std::regex located("\\(([0-9]+)\\): (.*)");
  std::smatch parts;
  if (!std::regex_match(error.func, parts, located)) return error.err;
  return "line " + std::to_string(std::stol(parts[1]) - lines_before) + ": " + parts[2].str();
}

}  // namespace

YamlReader::YamlReader(const std::string& path) : path_(path) {
  const std::string own = read_text(path);
  const std::string text = with_long_numbers_real(with_opencv_header(own));
  try {
    storage_.open(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  } catch (const cv::Exception& error) {
    const auto lines = [](const std::string& of) { return std::count(of.begin(), of.end(), '\n'); };
    throw InputError(path + ": is no valid YAML (" + reason_of(error, lines(text) - lines(own)) +
                     "); calibrate again or copy it again");
  }
  if (!storage_.isOpened() || !storage_.root().isMap()) {
    throw InputError(path +
                     ": is no calibration; OpenCV FileStorage or ROS camera_info YAML expected");
  }
}

bool YamlReader::has(const std::string& key) const { return !storage_[key].empty(); }

std::string YamlReader::first_of(const std::vector<std::string>& keys) const {
  for (const std::string& key : keys) {
    if (has(key)) return key;
  }
  return keys.front();
}

cv::FileNode YamlReader::node(const std::string& key) const {
  const cv::FileNode found = storage_[key];
  if (found.empty()) fail(key, "is missing", "add it");
  return found;
}

double YamlReader::integer(const std::string& key) const {
  const cv::FileNode value = node(key);
  const double number = value.isInt() || value.isReal() ? static_cast<double>(value) : 0.0;
  if (!value.isInt() && std::abs(number) < kSmallestLongNumber)
    fail(key, "is not a whole number", "correct it");
  return number;
}

double YamlReader::number(const std::string& key) const {
  const cv::FileNode value = node(key);
  if (!value.isInt() && !value.isReal()) fail(key, "is not a number", "correct it");
  const auto number = static_cast<double>(value);
  if (!std::isfinite(number)) fail(key, "is not finite", "calibrate again");
  return number;
}

std::string YamlReader::text(const std::string& key) const {
  const cv::FileNode value = node(key);
  if (!value.isString()) fail(key, "is not a text", "correct it");
  return value.string();
}

std::vector<double> YamlReader::numbers(const std::string& key) const {
  const cv::FileNode value = node(key);
  const cv::FileNode data = value.isMap() ? value["data"] : value;
  if (!data.isSeq()) fail(key, "is not a list of numbers", "correct it");
  std::vector<double> numbers;
  append_numbers(data, numbers);
  for (const double number : numbers) {
    if (!std::isfinite(number))
      fail(key, "holds a value that is no finite number", "calibrate again");
  }
  return numbers;
}

Eigen::MatrixXd YamlReader::matrix(const std::string& key, int rows, int cols) const {
  const std::vector<double> values = numbers(key);
  const cv::FileNode value = node(key);
  const bool is_vector = rows == 1 || cols == 1;
  const bool size_told = value.isMap() && !is_vector;
  const bool size_right = !size_told || (static_cast<int>(value["rows"]) == rows &&
                                         static_cast<int>(value["cols"]) == cols);
  if (!size_right ||
      values.size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols)) {
    fail(key, size_right ? count_text(values.size()) : size_text(value, values.size()),
         "must be " + std::to_string(rows) + " x " + std::to_string(cols));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), rows, cols);
}

void YamlReader::fail(const std::string& key, const std::string& found,
                      const std::string& advice) const {
  throw InputError(path_ + ": '" + key + "' " + found + "; " + advice);
}

}  // namespace limbcast
