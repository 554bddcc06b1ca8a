#include <cstdio>

#include "common/config/options.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "tests/replay/pose_differences.hpp"

int main(int argc, char** argv) {
  using namespace limbcast;
  return config::run_program("compare_poses", [&] {
    if (argc != 3) throw config::UsageError("usage: compare_poses BEFORE.jsonl AFTER.jsonl");
    const auto lines =
        replay::pose_differences(pose_json::read_file(argv[1]), pose_json::read_file(argv[2]));
    for (const std::string& line : lines) std::puts(line.c_str());
    std::printf("%zu differences\n", lines.size());
  });
}
