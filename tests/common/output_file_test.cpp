#include "common/config/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "common/config/options.hpp"
#include "tests/support/rights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::config {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

std::string refusal_of(const std::string& path) {
  return test::error_of<UsageError>([&] { check_output_file("--output", path); });
}

TEST(OutputFile, MayBeNewOrThereAlreadyOrNotGiven) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_output_file("--output", folder / "new.yml"));
  EXPECT_NO_THROW(check_output_file("--output", folder.write("old.yml", "text")));
  EXPECT_NO_THROW(check_output_file("--output", "in_the_working_folder.yml"));
  EXPECT_NO_THROW(check_output_file("--output", "/dev/stdout"));
  EXPECT_NO_THROW(check_output_file("--output", ""));
}

TEST(OutputFile, IsRefusedInAFolderThatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of(folder / "none/a.yml"), folder / "none/a.yml" + ": there is no folder " +
                                                   folder / "none" +
                                                   "; make it or choose another --output");
}

TEST(OutputFile, IsRefusedWhereAFolderStands) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal_of(folder.path()), folder.path() + ": is a folder; give a file to --output");
}

TEST(OutputFile, IsRefusedWhereItIsRead) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.log", "text");
  std::filesystem::create_symlink(in, folder / "link.log");
  EXPECT_EQ(test::error_of<UsageError>([&] {
              check_output_file("--json", folder / "link.log", {folder / "none", in});
            }),
            folder / "link.log" + ": is what is read; choose another --json");
  EXPECT_NO_THROW(check_output_file("--json", folder / "new.log", {in}));
}

TEST(OutputFile, IsRefusedWhereWhatIsLeftOfAnEarlierRunIsRead) {
  const TemporaryFolder folder;
  const std::string left = folder.write("out.log.unfinished", "text");
  EXPECT_EQ(
      test::error_of<UsageError>([&] { check_output_file("OUT.log", folder / "out.log", {left}); }),
      left + ": is what is read; choose another OUT.log");
}

constexpr auto kToLookAt = static_cast<std::filesystem::perms>(0555);

TEST(OutputFile, IsRefusedWhereTheUserMayNotWrite) {
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), kToLookAt);
  const auto tell = [&] {
    test::give_up_rights();
    std::fputs(refusal_of(folder / "a.yml").c_str(), stderr);
    std::exit(0);
  };
  EXPECT_EXIT(tell(), ::testing::ExitedWithCode(0),
              HasSubstr("/a.yml: cannot be written (Permission denied); choose another --output"));
}

TEST(OutputFile, IsRefusedWhereAnotherOptionWritesIt) {
  const TemporaryFolder folder;
  EXPECT_EQ(test::error_of<UsageError>([&] {
              check_outputs_differ("--picture", folder / "./a.png", "--json", folder / "a.png");
            }),
            folder / "./a.png" + ": is what --json writes; choose another --picture");
  EXPECT_NO_THROW(check_outputs_differ("--picture", folder / "a.png", "--json", folder / "a.json"));
  EXPECT_NO_THROW(check_outputs_differ("--picture", "", "--json", ""));
}

TEST(OutputFolder, IsMadeWithThoseAboveIt) {
  const TemporaryFolder folder;
  make_output_folder("--output", folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  EXPECT_NO_THROW(make_output_folder("--output", folder / "a/b"));
}

TEST(OutputFolder, IsRefusedWhereItCannotBe) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "text");
  const auto refusal_of = [](const std::string& path) {
    return test::error_of<UsageError>([&path] { make_output_folder("--output", path); });
  };
  EXPECT_EQ(refusal_of(file), file + ": is no folder; give one to --output");
  EXPECT_EQ(refusal_of(file + "/a"),
            file + "/a: cannot be made (Not a directory); choose another --output");
}

TEST(OutputFolder, IsRefusedWhereTheUserMayNotWrite) {
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), kToLookAt);
  for (const auto& [path, refusal] :
       {std::pair(folder.path(), ": cannot be written (Permission denied); choose another FOLDER"),
        std::pair(folder / "new", ": cannot be made (Permission denied); choose another FOLDER")}) {
    const auto tell = [&path = path] {
      test::give_up_rights();
      std::fputs(test::error_of<UsageError>([&] { make_output_folder("FOLDER", path); }).c_str(),
                 stderr);
      std::exit(0);
    };
    EXPECT_EXIT(tell(), ::testing::ExitedWithCode(0), HasSubstr(path + refusal));
  }
}

TEST(FolderLock, KeepsOthersOutWhileItLives) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_EQ(test::error_of<UsageError>([&] { FolderLock(folder.path()); }),
              folder.path() + ": is being written by another process; choose another folder");
  }
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

}  // namespace
}  // namespace limbcast::config
