#include "common/config/setting_lines.hpp"

#include <boost/algorithm/string/trim.hpp>
#include <sstream>

#include "common/config/option_name.hpp"

namespace limbcast::config {

// As Boost reads them, which tells no lines.
std::vector<int> lines_that_set(const std::string& section, const std::string& key,
                                const std::string& text) {
  std::vector<int> found;
  std::istringstream lines(text);
  std::string line, prefix;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string words = boost::trim_copy(line.substr(0, line.find('#')));
    const std::size_t value_at = words.find('=');
    if (words.size() > 2 && words.front() == '[' && words.back() == ']') {
      prefix = words.substr(1, words.size() - 2) + '.';
    } else if (value_at != std::string::npos) {
      const OptionName name = section_and_key(prefix + boost::trim_copy(words.substr(0, value_at)));
      if (name.section == section && with_hyphens(name.key) == key) found.push_back(number);
    }
  }
  return found;
}

}  // namespace limbcast::config
