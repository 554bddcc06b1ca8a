#include "common/whole_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/full_disk.hpp"
#include "tests/support/rights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

using test::TemporaryFolder;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string refusal_of(const std::string& path, const std::string& text) {
  return test::error_of<std::runtime_error>([&] { write_whole_file(path, text); });
}

TEST(WholeFile, TakesThePlaceOfTheOneBefore) {
  const TemporaryFolder folder;
  const std::string path = folder.write("report.txt", "a longer text of before");
  write_whole_file(path, std::string("new\0text", 8));
  EXPECT_EQ(text_of(path), std::string("new\0text", 8));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WholeFile, GoesWhereALinkLeadsThoughNothingStandsThereYet) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "disk");
  std::filesystem::create_symlink("disk/link", folder / "report.txt");
  std::filesystem::create_symlink("today.txt", folder / "disk/link");
  write_whole_file(folder / "report.txt", std::string("text"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "report.txt"));
  EXPECT_EQ(text_of(folder / "disk/today.txt"), "text");
  std::filesystem::create_symlink("ring", folder / "ring");
  write_whole_file(folder / "ring", std::string("text"));
  EXPECT_EQ(text_of(folder / "ring"), "text");
}

TEST(WholeFile, GoesToWhatTheShellHasOpened) {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.txt", "");
  const int shells = open(path.c_str(), O_WRONLY);  // NOLINT(*-vararg)
  const auto write_by_shell = [shells](const std::string_view text) {
    EXPECT_EQ(write(shells, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  };
  write_by_shell("from the shell, ");
  write_whole_file("/dev/fd/" + std::to_string(shells), std::string("from the program, "));
  write_by_shell("from the shell again");
  close(shells);
  EXPECT_EQ(text_of(path), "from the shell, from the program, from the shell again");
}

TEST(WholeFile, IsAsItWasWhereTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder.write("report.txt", "before");
  const auto tell = [&] {
    test::let_files_grow_to(50'000);
    std::fputs(refusal_of(path, std::string(100'000, 'x')).c_str(), stderr);
    std::exit(0);
  };
  EXPECT_EXIT(tell(), ::testing::ExitedWithCode(0),
              ::testing::HasSubstr("report.txt: cannot be written (File too large)"));
  EXPECT_EQ(text_of(path), "before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WholeFile, IsWrittenInAFolderThatIsNot) {
  const TemporaryFolder folder;
  const std::string path = folder.write("report.txt", "before");
  std::filesystem::permissions(path, static_cast<std::filesystem::perms>(0666));
  std::filesystem::permissions(folder.path(), static_cast<std::filesystem::perms>(0555));
  const auto overwrite = [&] {
    test::give_up_rights();
    write_whole_file(path, std::string("after"));
    std::exit(0);
  };
  EXPECT_EXIT(overwrite(), ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(text_of(path), "after");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(WholeFile, IsNamedWithTheReasonWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of(folder / "none/report.txt", "text"),
            folder / "none/report.txt: cannot be written (No such file or directory)");
  EXPECT_EQ(refusal_of(folder.path(), "text"),
            folder.path() + ": cannot be written (Is a directory)");
}

}  // namespace
}  // namespace limbcast
