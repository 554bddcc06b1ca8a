#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limbcast/body_poses_t.hpp>
#include <regex>

#include "common/lcm_io/bus.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::packages {
namespace {

namespace fs = std::filesystem;
using test::run;
using ::testing::HasSubstr;

/// One person whose head is at (1, 2, 3) and who points straight ahead.
body_poses_t somebody() {
  body_poses_t poses{};
  poses.stamp.sequence = 7;
  body_pose_t person{};
  for (joint_t& joint : person.joints) joint.name = "chest";
  person.joints[0].name = "head";
  person.joints[0].valid = 1;
  person.joints[0].position_m[0] = 1.0F;
  person.joints[0].position_m[1] = 2.0F;
  person.joints[0].position_m[2] = 3.0F;
  pointing_t arm{};
  arm.direction[2] = 1.0F;
  person.pointing.push_back(arm);
  person.num_pointing = 1;
  poses.persons.push_back(person);
  poses.num_persons = 1;
  return poses;
}

int num_frames_in(const std::string& output) {
  const std::regex frame("frame [0-9]+:");
  return static_cast<int>(
      std::distance(std::sregex_iterator(output.begin(), output.end(), frame), {}));
}

/// The package for developers, installed in a folder, and the examples as a user copies them.
class Examples : public ::testing::Test {
 protected:
  Examples()
      : prefix_(test::temporary_folder("installed")), folder_(test::temporary_folder("copy")) {
    const auto installed = run({LIMBCAST_CMAKE, "--install", LIMBCAST_BUILD_DIR, "--prefix",
                                prefix_.string(), "--component", "dev"});
    EXPECT_EQ(installed.exit_code, 0) << installed.output;
    fs::copy(prefix_ / "share/doc/limbcast-dev/examples", folder_, fs::copy_options::recursive);
  }

  /// Sends poses until the subscriber has begun with a second frame: then the first is complete.
  void expect_prints_poses(const std::vector<std::string>& command) const {
    const std::string url = test::private_lcm_url();
    lcm_io::Bus bus(url);
    // A message that comes back to its sender paces the sending.
    int echoes = 0;
    bus.subscribe<body_poses_t>("BODY_POSES", lcm_io::Keep::kAll,
                                [&](const body_poses_t&) { ++echoes; });
    test::ChildProcess subscriber(command, (folder_ / "output.txt").string(),
                                  {"LCM_DEFAULT_URL=" + url});
    constexpr std::chrono::milliseconds kPause{100};
    while (num_frames_in(subscriber.output()) < 2) {
      ASSERT_TRUE(subscriber.running()) << subscriber.output();
      bus.publish("BODY_POSES", somebody());
      while (bus.handle(kPause)) continue;
    }
    EXPECT_THAT(subscriber.output(), HasSubstr("frame 7: 1 persons\n"
                                               "  head at 1.00 2.00 3.00 m\n"
                                               "  points to 0.00 0.00 1.00"));
    EXPECT_GT(echoes, 0);
  }

  const fs::path prefix_, folder_;
};

TEST_F(Examples, BuildWithCMakeAndPrintPoses) {
  const fs::path build = folder_ / "build";
  const auto configured = run({LIMBCAST_CMAKE, "-S", folder_.string(), "-B", build.string(),
                               "-DCMAKE_PREFIX_PATH=" + prefix_.string()});
  ASSERT_EQ(configured.exit_code, 0) << configured.output;
  const auto built = run({LIMBCAST_CMAKE, "--build", build.string()});
  ASSERT_EQ(built.exit_code, 0) << built.output;
  expect_prints_poses({(build / "subscriber").string()});
}

TEST_F(Examples, BuildWithPkgConfigAndPrintPoses) {
  const auto built = run({"sh", "-c",
                          "cd " + folder_.string() + " && export PKG_CONFIG_PATH=" +
                              (prefix_ / "share/pkgconfig").string() +
                              " && g++ -std=c++17 subscriber.cpp -o subscriber $(pkg-config "
                              "--cflags --libs limbcast)"});
  ASSERT_EQ(built.exit_code, 0) << built.output;
  expect_prints_poses({(folder_ / "subscriber").string()});
}

TEST_F(Examples, RunInJavaAndPrintPoses) {
  const std::string classes = LIMBCAST_JAVA_CLASSES;
  if (classes.empty())
    GTEST_SKIP() << "built without Java: apt-get install default-jdk-headless liblcm-java";
  expect_prints_poses({"java", "-Djava.net.preferIPv4Stack=true", "-cp", classes,
                       (folder_ / "Subscriber.java").string()});
}

}  // namespace
}  // namespace limbcast::packages
