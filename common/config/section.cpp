#include "common/config/section.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/joined.hpp"

namespace limbcast::config {
namespace {

template <class T>
T parsed_number(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  T value{};
  in >> value;
  if (in.fail() || !(in >> std::ws).eof()) throw std::invalid_argument(text);
  return value;
}

template <class T>
std::string number_text(T value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

/// NaN stands for an option that is left out: its help says what happens then.
template <class T>
std::string default_text(T value) {
  return std::isnan(static_cast<double>(value)) ? "" : number_text(value);
}

template <class T>
std::string range_text(const Range<T>& range) {
  const bool has_min = range.min != std::numeric_limits<T>::lowest();
  const bool has_max = range.max != std::numeric_limits<T>::max();
  if (has_min && has_max) return number_text(range.min) + " to " + number_text(range.max);
  if (has_min) return "at least " + number_text(range.min);
  if (has_max) return "at most " + number_text(range.max);
  return "a number";
}

bool parsed_bool(const std::string& text) {
  if (text == "true" || text == "1" || text == "yes" || text == "on") return true;
  if (text == "false" || text == "0" || text == "no" || text == "off") return false;
  throw std::invalid_argument(text);
}

}  // namespace

Section::Section(std::string name) : name_(std::move(name)) {}

template <class T>
void Section::add_number(const std::string& key, T& target, const std::string& unit,
                         const std::string& help, Range<T> range) {
  Entry entry{key, unit, help, default_text(target), range_text(range), false, {}};
  entry.assign = [&target, range](const std::string& text) {
    const T value = parsed_number<T>(text);
    if (!(value >= range.min && value <= range.max)) throw std::invalid_argument(text);
    target = value;
  };
  entries_.push_back(std::move(entry));
}

void Section::add(const std::string& key, double& target, const std::string& unit,
                  const std::string& help, Range<double> range) {
  add_number(key, target, unit, help, range);
}

void Section::add(const std::string& key, float& target, const std::string& unit,
                  const std::string& help, Range<float> range) {
  add_number(key, target, unit, help, range);
}

void Section::add(const std::string& key, int& target, const std::string& unit,
                  const std::string& help, Range<int> range) {
  add_number(key, target, unit, help, range);
}

void Section::add(const std::string& key, std::string& target, const std::string& help) {
  entries_.push_back({key, "", help, target, "text", false,
                      [&target](const std::string& text) { target = text; }});
}

void Section::add_name(const std::string& key, std::string& target, const std::string& help) {
  entries_.push_back(
      {key, "", help, target, "a name, not empty", false, [&target](const std::string& text) {
         if (text.empty()) throw std::invalid_argument(text);
         target = text;
       }});
}

void Section::add_channel(const std::string& key, std::string& target, const std::string& help) {
  entries_.push_back({key, "", help, target,
                      "a name of 1 to " + std::to_string(kLongestChannel) + " characters", false,
                      [&target](const std::string& text) {
                        if (text.empty() || text.size() > kLongestChannel)
                          throw std::invalid_argument(text);
                        target = text;
                      }});
}

void Section::add_input_channel(const std::string& key, std::string& target,
                                const std::string& help) {
  add_channel(key, target, "input: " + help);
  inputs_.push_back({key, &target});
}

void Section::add_output_channel(const std::string& key, std::string& target,
                                 const std::string& help) {
  add_channel(key, target, "output: " + help);
  outputs_.push_back({key, &target});
}

void Section::add(const std::string& key, bool& target, const std::string& help) {
  entries_.push_back({key, "", help, target ? "true" : "false", "true or false", true,
                      [&target](const std::string& text) { target = parsed_bool(text); }});
}

void Section::add_choice(const std::string& key, std::string& target,
                         const std::vector<std::string>& choices, const std::string& help) {
  entries_.push_back({key, "", help, target, "one of " + joined(choices), false,
                      [&target, choices](const std::string& text) {
                        if (std::find(choices.begin(), choices.end(), text) == choices.end())
                          throw std::invalid_argument(text);
                        target = text;
                      }});
}

}  // namespace limbcast::config
