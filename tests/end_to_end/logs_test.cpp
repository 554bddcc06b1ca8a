#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/child_process.hpp"

namespace limbcast::test {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(LogsOfTheRepository, AreMadeAgainByteForByte) {
  const std::string data = LIMBCAST_DATA_DIR;
  if (!fs::exists(data + "/stereo_dev")) GTEST_SKIP() << data << " is absent";
  const std::string copy = temporary_folder("repository");
  const std::string folder = copy + "/logs";  // the script writes beside itself
  for (const std::string file : {"logs/make_logs.sh", "modules/usage.sh"}) {
    fs::create_directories(fs::path(copy + "/" + file).parent_path());
    fs::copy_file(repository_file(file), copy + "/" + file);
  }

  const std::string programs = fs::path(program("limbcast-stereo-camera")).parent_path();
  const RunResult result = run({"bash", folder + "/make_logs.sh", data, programs});

  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const char* name : {"demo.log", "multi.log", "nobody.log"}) {
    const std::string made = bytes_of(folder + "/" + name);
    EXPECT_FALSE(made.empty()) << name;
    EXPECT_TRUE(made == bytes_of(repository_file(std::string("logs/") + name))) << name;
  }
}

}  // namespace
}  // namespace limbcast::test
