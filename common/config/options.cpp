#include "common/config/options.hpp"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <boost/program_options.hpp>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/config/byte_order_mark.hpp"
#include "common/config/log.hpp"
#include "common/config/option_name.hpp"
#include "common/config/output_file.hpp"
#include "common/config/setting_lines.hpp"
#include "common/config/version.hpp"
#include "common/input_file.hpp"
#include "common/joined.hpp"

namespace limbcast::config {
namespace {

namespace po = boost::program_options;

/// Sections a robot's configuration file may hold; a program reads its own and checks the names of
/// the rest.
constexpr std::array<std::string_view, 16> kModuleNames = {
    "stereo_camera", "depth_camera", "laser_scanner", "reconstructor", "segmenter", "pose_fitter",
    "tracker",       "viewer",       "replay",        "export_poses",  "evaluate",  "simulate",
    "status",        "doctor",       "log",           "calibrate"};

/// What stands on the command line without a name.
constexpr const char* kArgument = "argument";

/// "--Section.some_key=v" -> "--Section.some-key=v": the section keeps its underscores.
std::string normalized_argument(const std::string& argument) {
  if (argument.rfind("--", 0) != 0) return argument;
  const std::size_t value_at = std::min(argument.find('='), argument.size());
  const std::size_t dot = argument.substr(0, value_at).rfind('.');
  const std::size_t key_at = dot == std::string::npos ? 2 : dot + 1;
  return argument.substr(0, key_at) + with_hyphens(argument.substr(key_at, value_at - key_at)) +
         argument.substr(value_at);
}

/// What is said of a key that a configuration file sets more than once: which one was meant?
std::string why_not_twice(const OptionName& option, const std::string& text) {
  std::vector<std::string> lines;
  for (const int line : lines_that_set(option.section, option.key, text))
    lines.push_back(std::to_string(line));
  return "'" + option.key + "'" +
         (option.section.empty() ? "" : " in section [" + option.section + "]") +
         " is set in lines " + joined(lines) + "; leave it in one of them";
}

/// What is said of a line of a configuration file that sets nothing.
std::string why_no_setting(const std::string& line) {
  // Bytes of a picture or log are none to print.
  const bool is_text = std::none_of(line.begin(), line.end(), [](unsigned char c) {
    return std::iscntrl(c) != 0 && std::isspace(c) == 0;
  });
  return is_text ? "'" + line + "' is neither [MODULE] nor KEY = VALUE"
                 : "is no text; give a configuration file to --config";
}

/// A module would hear itself: its results would be taken for what they are made from.
void check_channels(const Section& section) {
  for (const Section::Channel& output : section.outputs()) {
    for (const Section::Channel& input : section.inputs()) {
      if (*output.name == *input.name)
        throw UsageError("'" + output.key + "' is '" + *output.name + "', as '" + input.key +
                         "' is, so that [" + section.name() +
                         "] would read what it writes; give one of them another name");
    }
  }
}

}  // namespace

Parser::Parser(std::string program, std::string purpose)
    : program_(std::move(program)), purpose_(std::move(purpose)) {
  common_section_.add("lcm-url", common_.lcm_url,
                      "LCM URL; default: $LCM_DEFAULT_URL, else this host only (ttl=0)");
  common_section_.add("config", common_.config_file, "configuration file, a section a module");
  common_section_.add_choice("log-level", common_.log_level, {"error", "warning", "info", "debug"},
                             "what is written to stderr");
  sections_.push_back({&common_section_, true});
}

void Parser::add(Section& section, bool own) { sections_.push_back({&section, own}); }

void Parser::add_positional(const std::string& name, std::string& target, const std::string& help) {
  positionals_.push_back({name, help, &target, name.front() != '['});
}

void Parser::add_positional(const std::string& name, std::vector<std::string>& targets,
                            const std::string& help) {
  positionals_.push_back({name, help, nullptr, name.front() != '[', &targets});
}

bool Parser::parse(int argc, const char* const* argv) { return parse(argc, argv, std::cout); }

bool Parser::parse(int argc, const char* const* argv, std::ostream& out) {
  const std::vector<Given> all = read_command_line(argc, argv);
  const auto given = [&all](const std::string& name) {
    return std::any_of(all.begin(), all.end(),
                       [&name](const Given& option) { return option.name == name; });
  };
  if (given("help")) return print_help(out), false;
  if (given("version")) return out << program_ << ' ' << kVersion << '\n', false;

  on_command_line_.clear();
  std::vector<std::string> positional_values;
  for (const auto& [name, values] : all) {
    if (name == kArgument) {
      positional_values.insert(positional_values.end(), values.begin(), values.end());
      continue;
    }
    const auto [section, key] = section_and_key(name);
    assign("command line", section, key, values.empty() ? "true" : values.front(), false);
    on_command_line_.push_back(name);
  }
  assign_positionals(positional_values);
  if (!common_.config_file.empty()) read_config_file(common_.config_file);
  for (const Bound& bound : sections_) check_channels(*bound.section);
  return true;
}

bool Parser::on_command_line(const std::string& key) const {
  return std::any_of(on_command_line_.begin(), on_command_line_.end(),
                     [&key](const std::string& name) { return section_and_key(name).key == key; });
}

std::string Parser::on_command_line(const std::vector<std::string>& keys) const {
  std::vector<std::string> given;
  for (const std::string& key : keys)
    if (on_command_line(key)) given.push_back(key);
  return joined(given);
}

std::vector<Parser::Given> Parser::read_command_line(int argc, const char* const* argv) const {
  po::options_description all;
  all.add_options()("help", "")("version", "")(kArgument, po::value<std::vector<std::string>>());
  std::set<std::string> flags;
  const auto declare = [&](const std::string& name, bool is_flag) {
    all.add_options()(name.c_str(), po::value<std::string>(), "");
    if (is_flag) flags.insert("--" + name);
  };
  for (const Bound& bound : sections_) {
    for (const Section::Entry& entry : bound.section->entries()) {
      if (bound.own) declare(entry.key, entry.is_flag);
      if (!bound.section->name().empty())
        declare(bound.section->name() + "." + entry.key, entry.is_flag);
    }
  }
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    arguments.push_back(normalized_argument(argv[i]));
    // Else a bare flag would take the argument behind it for its value.
    if (flags.count(arguments.back()) > 0) arguments.back() += "=true";
  }
  po::positional_options_description positional;
  positional.add(kArgument, -1);
  // No guessing from abbreviations: an option added later must not change what an old script means.
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  try {
    std::vector<Given> given;
    for (const po::option& option : po::command_line_parser(arguments)
                                        .options(all)
                                        .positional(positional)
                                        .style(style)
                                        .run()
                                        .options)
      given.push_back({option.string_key, option.value});
    return given;
  } catch (const po::error& error) {
    throw UsageError(std::string("command line: ") + error.what() + "; see " + program_ +
                     " --help");
  }
}

void Parser::refuse_argument(const std::string& value) const {
  const bool is_switch = value == "true" || value == "false";
  throw UsageError("command line: unexpected argument '" + value + "'; " +
                   (is_switch ? "write --key=" + value : "see " + program_ + " --help"));
}

void Parser::assign_positionals(const std::vector<std::string>& values) const {
  const bool takes_all = !positionals_.empty() && positionals_.back().targets != nullptr;
  if (values.size() > positionals_.size() && !takes_all)
    refuse_argument(values[positionals_.size()]);
  for (std::size_t i = 0; i < values.size(); ++i) {
    // A shell's variable that is not set would make a live one of a program that reads a log.
    if (values[i].empty())
      throw UsageError("command line: " + positionals_[std::min(i, positionals_.size() - 1)].name +
                       " is ''; give a name or leave it out");
  }
  for (std::size_t i = 0; i < positionals_.size(); ++i) {
    if (i < values.size() && positionals_[i].targets != nullptr)
      positionals_[i].targets->assign(values.begin() + static_cast<std::ptrdiff_t>(i),
                                      values.end());
    else if (i < values.size())
      *positionals_[i].target = values[i];
    else if (positionals_[i].required)
      throw UsageError("command line: " + positionals_[i].name + " is missing; see " + program_ +
                       " --help");
  }
}

void Parser::assign(const std::string& where, const std::string& section, const std::string& key,
                    const std::string& text, bool from_file) {
  bool found = false;
  for (const Bound& bound : sections_) {
    const bool addressed =
        bound.section->name() == section || (section.empty() && bound.own && !from_file);
    if (!addressed) continue;
    for (const Section::Entry& entry : bound.section->entries()) {
      if (entry.key != key) continue;
      try {
        entry.assign(text);
        found = true;
      } catch (const std::invalid_argument&) {
        throw UsageError(where + ": '" + (section.empty() ? "" : section + ".") + key + "' is '" +
                         text + "', must be " + entry.allowed_text +
                         (entry.unit.empty() ? "" : " [" + entry.unit + "]"));
      }
    }
  }
  if (!found)
    throw UsageError(where + ": unknown key '" + key + "'" +
                     (section.empty() ? "" : " in section [" + section + "]") + "; see " +
                     program_ + " --help");
}

void Parser::read_config_file(const std::string& path) {
  const std::string kind = kind_of_no_stream(path);
  if (!kind.empty()) throw UsageError(path + ": is " + kind + "; give a file to --config");
  std::ifstream in(path);
  if (!in) throw UsageError(path + ": cannot be read; give an existing file to --config");
  const std::string text = without_byte_order_mark({std::istreambuf_iterator<char>(in), {}});
  std::istringstream settings(text);
  std::optional<po::parsed_options> parsed;
  try {
    parsed =
        po::parse_config_file(settings, po::options_description(), /*allow_unregistered=*/true);
  } catch (const po::invalid_config_file_syntax& error) {
    throw UsageError(path + ": " + why_no_setting(error.tokens()) + "; see " + program_ +
                     " --help");
  } catch (const po::error& error) {
    throw UsageError(path + ": " + error.what());
  }
  std::set<std::string> set_before;
  for (const po::option& option : parsed->options) {
    const auto [section, written_key] = section_and_key(option.string_key);
    const std::string key = with_hyphens(written_key);
    const auto is_it = [&name = section](const Bound& bound) {
      return bound.section->name() == name;
    };
    const bool mine = std::any_of(sections_.begin(), sections_.end(), is_it);
    if (!mine) {
      if (std::find(kModuleNames.begin(), kModuleNames.end(), section) == kModuleNames.end())
        throw UsageError(path + ": unknown section [" + section +
                         "]; sections are named like modules");
      continue;
    }
    // A file would name a file that nobody reads.
    if (key == "config")
      throw UsageError(path + ": 'config' is for the command line; leave it out");
    const std::string full_key = section.empty() ? key : section + "." + key;
    if (!set_before.insert(full_key).second)
      throw UsageError(path + ": " + why_not_twice({section, key}, text));
    const auto overridden = [&](const std::string& name) {
      return std::find(on_command_line_.begin(), on_command_line_.end(), name) !=
             on_command_line_.end();
    };
    if (overridden(full_key)) continue;
    const bool own = std::any_of(sections_.begin(), sections_.end(),
                                 [&](const Bound& bound) { return bound.own && is_it(bound); });
    if (own && overridden(key)) continue;
    assign(path, section, key, option.value.empty() ? "" : option.value.front(), true);
  }
}

void Parser::print_help(std::ostream& out) const {
  out << program_ << ": " << purpose_ << "\n\nUsage: " << program_;
  for (const Positional& positional : positionals_) out << ' ' << positional.name;
  out << " [options]\n";
  for (const Positional& positional : positionals_)
    out << "  " << positional.name << "  " << positional.help << '\n';
  for (const Bound& bound : sections_) {
    const std::string& name = bound.section->name();
    out << '\n'
        << (name.empty() ? std::string("Common options") : "Section [" + name + "]") << ":\n";
    for (const Section::Entry& entry : bound.section->entries()) {
      out << "  --" << (bound.own || name.empty() ? "" : name + ".") << entry.key
          << (entry.is_flag ? "[=VALUE]" : " VALUE") << "\n        " << entry.help;
      if (!entry.unit.empty()) out << " [" << entry.unit << ']';
      out << " (" << entry.allowed_text;
      if (!entry.default_text.empty()) out << ", default " << entry.default_text;
      out << ")\n";
    }
  }
  out << "  --help, --version\n";
}

namespace {

/// "/data/run: Permission denied; check its name and permissions".
std::string text_of(const std::filesystem::filesystem_error& error) {
  return error.path1().string() + ": " + error.code().message() +
         "; check its name and permissions";
}

/// Each frame's images and lattices (up to some 10 MB each) are freed soon and wanted again with
/// the next frame. glibc gives such memory back to the kernel each time, which then clears it anew:
/// of a dense scan's frame that took a third of the time.
void keep_freed_memory() {
  constexpr int kLargestThatIsKept_bytes = 32 << 20;  // the most that glibc takes
  constexpr int kMostThatIsKept_bytes = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestThatIsKept_bytes);
  mallopt(M_TRIM_THRESHOLD, kMostThatIsKept_bytes);
}

}  // namespace

int run_program(const std::string& program, const std::function<void()>& body) {
  constexpr int kFailedAtRunTime = 1;
  constexpr int kWrongUsage = 2;
  keep_freed_memory();
  try {
    body();
    // A full disk must not pass for a report.
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw cannot_write_to_stdout();
    return 0;
  } catch (const InputError& error) {
    log_failure(program, error.what());
    return kWrongUsage;
  } catch (const std::filesystem::filesystem_error& error) {
    log_failure(program, text_of(error));
    return kWrongUsage;
  } catch (const std::exception& error) {
    log_failure(program, error.what());
    return kFailedAtRunTime;
  }
}

}  // namespace limbcast::config
