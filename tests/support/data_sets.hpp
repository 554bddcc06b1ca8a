#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/config/options.hpp"
#include "common/input_error.hpp"

namespace limbcast::test {

/// What a program that prints figures of the data (README.md, "Accuracy") looks at.
struct DataSets {
  std::vector<std::string> names;  ///< as "stereo_dev/pointing"
  std::string data = LIMBCAST_DATA_DIR;

  /// Binds --data and the arguments. `parser` must not outlive this object.
  void declare(config::Section& section, config::Parser& parser) {
    std::string usual;
    for (const std::string& name : names) usual.append(usual.empty() ? "" : " ").append(name);
    section.add("data", data, "folder of the data");
    parser.add_positional("[SET...]", names, "folders in it; default: " + usual);
  }
  /// The set's folder. Throws InputError where it is absent.
  std::string folder(const std::string& name) const {
    const std::filesystem::path path = std::filesystem::path(data) / name;
    if (std::filesystem::is_directory(path)) return path.string();
    throw InputError(path.string() + ": no such folder; say with --data where the data are");
  }
};

/// A program that prints figures of sets, `usual` where none is named: calls `print` with those
/// that are asked for.
template <class Print>
int print_figures(const std::string& program, const std::string& purpose,
                  std::vector<std::string> usual, int argc, char** argv, Print print) {
  return config::run_program(program, [&] {
    DataSets sets{std::move(usual)};
    config::Section section("figures");
    config::Parser parser(program, purpose);
    sets.declare(section, parser);
    parser.add(section);
    if (parser.parse(argc, argv)) print(sets);
  });
}

}  // namespace limbcast::test
