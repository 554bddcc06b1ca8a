#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "common/config/section.hpp"
#include "common/input_error.hpp"

namespace limbcast::config {

/// Wrong usage or input: the program ends with exit code 2 and this one line.
class UsageError : public InputError {
 public:
  using InputError::InputError;
};

/// What every program understands.
struct CommonOptions {
  std::string lcm_url;             ///< empty: LCM_DEFAULT_URL, else lcm_io::kDefaultUrl
  std::string config_file;         ///< empty: none
  std::string log_level = "info";  ///< error, warning, info, debug
};

/// Reads command line, configuration file and defaults, in this order of precedence.
class Parser {
 public:
  /// `purpose`: one line for --help.
  Parser(std::string program, std::string purpose);

  /// A section whose keys are understood with the prefix ("--pose_fitter.method") and, where `own`,
  /// without.
  void add(Section& section, bool own = true);
  /// A required ("IN.log") or optional ("[FOLDER]") argument without a key.
  void add_positional(const std::string& name, std::string& target, const std::string& help);
  /// One or more arguments ("IN.log...") or any number ("[SET...]", where `targets` stay as they
  /// are without any): all that follow the others. The last to be added.
  void add_positional(const std::string& name, std::vector<std::string>& targets,
                      const std::string& help);

  /// Fills all targets. Prints and returns false after --help or --version (then exit with 0).
  /// Throws UsageError naming file, key, value and allowed range.
  bool parse(int argc, const char* const* argv);
  bool parse(int argc, const char* const* argv, std::ostream& out);

  const CommonOptions& common() const { return common_; }
  /// Did an option of this key stand on the command line, with or without its section?
  bool on_command_line(const std::string& key) const;
  /// Those of these keys that did, separated by commas.
  std::string on_command_line(const std::vector<std::string>& keys) const;

 private:
  struct Positional {
    std::string name, help;
    std::string* target;
    bool required;
    std::vector<std::string>* targets = nullptr;  ///< instead of `target`: all the rest
  };
  struct Bound {
    Section* section;
    bool own;
  };
  /// An option of the command line with its values.
  struct Given {
    std::string name;
    std::vector<std::string> values;
  };
  std::vector<Given> read_command_line(int argc, const char* const* argv) const;
  void assign_positionals(const std::vector<std::string>& values) const;
  [[noreturn]] void refuse_argument(const std::string& value) const;
  void assign(const std::string& where, const std::string& section, const std::string& key,
              const std::string& text, bool from_file);
  void read_config_file(const std::string& path);
  void print_help(std::ostream& out) const;

  std::string program_, purpose_;
  Section common_section_{""};
  CommonOptions common_;
  std::vector<Bound> sections_;
  std::vector<Positional> positionals_;
  std::vector<std::string> on_command_line_;  ///< names, with the section where it was given
};

/// Runs `body` and turns its end into an exit code: 0 done, 1 failed at run time, 2 wrong usage or
/// input; an exception, or output that could not be written, prints one line "program: what" on
/// stderr.
int run_program(const std::string& program, const std::function<void()>& body);

}  // namespace limbcast::config
