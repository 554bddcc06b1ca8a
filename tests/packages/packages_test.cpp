#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/child_process.hpp"

namespace limbcast::packages {
namespace {

namespace fs = std::filesystem;
using test::run;
using ::testing::HasSubstr;

const std::string kNoPackage = "no such package";

/// The .deb files that cpack makes of this build.
class Packages : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = test::temporary_folder("packages");
    const auto packed =
        run({LIMBCAST_CPACK, "--config", std::string(LIMBCAST_BUILD_DIR) + "/CPackConfig.cmake",
             "-B", folder_.string()});
    ASSERT_EQ(packed.exit_code, 0) << packed.output;
  }
  /// What dpkg-deb says of the package that begins with `name`.
  static std::string tell(const std::string& what, const std::string& name) {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().filename().string().rfind(name + "_", 0) == 0)
        return run({"dpkg-deb", what, entry.path().string()}).output;
    }
    return kNoPackage;
  }

  static fs::path folder_;
};

fs::path Packages::folder_;

TEST_F(Packages, HoldProgramsWithUnitsSettingsManualsAndCompletion) {
  const std::string contents = tell("--contents", "limbcast-tools");
  for (const char* file :
       {"./usr/bin/limbcast-segmenter\n", "./usr/bin/limbcast-doctor\n", "./usr/bin/limbcast-spy\n",
        "./usr/lib/systemd/system/limbcast-segmenter@.service\n",
        "./usr/lib/sysctl.d/60-limbcast.conf\n", "./etc/limbcast/lcm.conf\n",
        "./usr/share/bash-completion/completions/limbcast-segmenter\n"})
    EXPECT_THAT(contents, HasSubstr(file));
  // help2man makes the manuals; without it they are left out.
  if (fs::exists(std::string(LIMBCAST_BUILD_DIR) + "/share/man/man1/limbcast-segmenter.1")) {
    EXPECT_THAT(contents, HasSubstr("./usr/share/man/man1/limbcast-segmenter.1\n"));
    EXPECT_THAT(contents, HasSubstr("./usr/share/man/man1/limbcast-spy.1\n"));
  }
  EXPECT_THAT(contents, Not(HasSubstr("/usr/include")));
}

TEST_F(Packages, HoldTypesForCppAndJava) {
  const std::string contents = tell("--contents", "limbcast-dev");
  for (const char* file :
       {"./usr/include/limbcast/body_poses_t.hpp\n",
        "./usr/share/cmake/limbcast/limbcastConfig.cmake\n", "./usr/share/pkgconfig/limbcast.pc\n",
        "./usr/share/limbcast/lcmtypes/body_poses_t.lcm\n",
        "./usr/share/doc/limbcast-dev/examples/subscriber.cpp\n"})
    EXPECT_THAT(contents, HasSubstr(file));
  const std::string java = tell("--contents", "limbcast-java");
  if (fs::exists(std::string(LIMBCAST_BUILD_DIR) + "/share/java/limbcast_types.jar")) {
    EXPECT_THAT(java, HasSubstr("./usr/share/java/limbcast_types.jar\n"));
    EXPECT_THAT(java, HasSubstr("./usr/share/java/limbcast_spy.jar\n"));
  }
}

TEST_F(Packages, TellTheLicenceOfThePoseNetwork) {
  const auto copyright = run({"sh", "-c",
                              "dpkg-deb --fsys-tarfile " + folder_.string() +
                                  "/limbcast-tools_*.deb | tar -xO "
                                  "./usr/share/doc/limbcast-tools/copyright"});
  for (const char* text : {"BSD 3-Clause", "BlazeFace", "BlazePose", "MoveNet", "Apache License"})
    EXPECT_THAT(copyright.output, HasSubstr(text));
}

TEST_F(Packages, NameWhatTheyNeed) {
  const std::string tools = tell("--info", "limbcast-tools");
  EXPECT_THAT(tools, HasSubstr("libopencv-core406"));
  EXPECT_THAT(tools, HasSubstr("libxnnpack0"));
#ifdef __x86_64__
  EXPECT_THAT(tools, HasSubstr("libdnnl2"));
#endif
  EXPECT_THAT(tools, HasSubstr("liblcm-bin"));
  EXPECT_THAT(tools, HasSubstr("conffiles"));
  EXPECT_THAT(tell("--info", "limbcast-dev"), HasSubstr("Depends: liblcm-dev"));
  const std::string java = tell("--info", "limbcast-java");
  if (java != kNoPackage) {
    EXPECT_THAT(java, HasSubstr("Depends: liblcm-java, libjchart2d-java, default-jre"));
  }
}

}  // namespace
}  // namespace limbcast::packages
