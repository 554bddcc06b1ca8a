#include "common/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "tests/support/temporary_folder.hpp"

namespace limbcast {
namespace {

std::string refusal_of(const std::string& path) {
  return test::error_of<InputError>([&] { check_is_file(path, "give a picture"); });
}

TEST(InputFile, MayBeAFileOrALinkToOneOrMissing) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a.jpg", "text");
  std::filesystem::create_symlink(file, folder / "link.jpg");
  for (const std::string& path : {file, folder / "link.jpg", folder / "none.jpg", std::string()})
    EXPECT_NO_THROW(check_is_file(path, "give a picture")) << path;
}

TEST(InputFile, IsNamedWhereItIsNone) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(refusal_of(folder.path()), folder.path() + ": is a folder; give a picture");
  EXPECT_EQ(refusal_of("/dev/zero"), "/dev/zero: is a device; give a picture");
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  std::filesystem::create_symlink(pipe, folder / "link");
  for (const std::string& path : {pipe, folder / "link"})
    EXPECT_EQ(refusal_of(path), path + ": is a pipe; give a picture");
}

TEST(InputFile, IsNoSocket) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "socket";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(refusal_of(path), path + ": is a socket; give a picture");
  close(socket);
}

TEST(InputFile, MayBeAPipeThatTheShellOpened) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  EXPECT_EQ(kind_of_no_file(path), "a pipe");
  EXPECT_NO_THROW(check_is_file(path, "give a picture"));
  for (const int end : ends) close(end);
}

}  // namespace
}  // namespace limbcast
