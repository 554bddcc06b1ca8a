#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace limbcast::config {

/// Allowed values of a number; both ends belong to it.
template <class T>
struct Range {
  T min = std::numeric_limits<T>::lowest();
  T max = std::numeric_limits<T>::max();
};

/// Characters that LCM takes for a channel's name at most.
inline constexpr std::size_t kLongestChannel = 63;

/// The options of one module: a section of the configuration file and the same keys on the command
/// line.
///
/// Keys are written with hyphens ("max-depth-m"); underscores are accepted too. Each `add` binds a
/// key to a variable whose present value is the default, and names its unit ("m", "px", "" for
/// none).
class Section {
 public:
  explicit Section(std::string name);  ///< e.g. "pose_fitter"

  /// An option, as it is parsed and as the help shows it.
  struct Entry {
    std::string key, unit, help, default_text, allowed_text;
    bool is_flag = false;
    /// Stores the text; throws std::invalid_argument where it is no allowed value.
    std::function<void(const std::string& text)> assign;
  };

  /// A channel with its present name.
  struct Channel {
    std::string key;
    const std::string* name;
  };

  const std::string& name() const { return name_; }
  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Channel>& inputs() const { return inputs_; }
  const std::vector<Channel>& outputs() const { return outputs_; }
  void add(const std::string& key, double& target, const std::string& unit, const std::string& help,
           Range<double> range = {});
  void add(const std::string& key, float& target, const std::string& unit, const std::string& help,
           Range<float> range = {});
  void add(const std::string& key, int& target, const std::string& unit, const std::string& help,
           Range<int> range = {});
  void add(const std::string& key, std::string& target, const std::string& help);
  /// A text that must not be empty: were a file to write empty, as a shell's variable that is not
  /// set, nothing would be written and nobody told.
  void add_name(const std::string& key, std::string& target, const std::string& help);
  /// The name of an LCM channel.
  void add_channel(const std::string& key, std::string& target, const std::string& help);
  /// The same of one that the module reads or writes; the parser refuses a name that is both.
  void add_input_channel(const std::string& key, std::string& target, const std::string& help);
  void add_output_channel(const std::string& key, std::string& target, const std::string& help);
  /// true/false; on the command line the bare key means true, and false is "--key=false".
  void add(const std::string& key, bool& target, const std::string& help);
  void add_choice(const std::string& key, std::string& target,
                  const std::vector<std::string>& choices, const std::string& help);

 private:
  template <class T>
  void add_number(const std::string& key, T& target, const std::string& unit,
                  const std::string& help, Range<T> range);

  std::string name_;
  std::vector<Entry> entries_;
  std::vector<Channel> inputs_, outputs_;
};

}  // namespace limbcast::config
