#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "common/lcm_io/pose_log.hpp"
#include "common/pose_json/pose_lines.hpp"
#include "tests/replay/log_tools.hpp"
#include "tests/replay/pose_differences.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::replay {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<BodyPoses> poses_of(const std::string& log) {
  std::vector<BodyPoses> frames;
  lcm_io::visit_poses(log, "BODY_POSES", [&](const BodyPoses& poses) { frames.push_back(poses); });
  return frames;
}

class ReplayOfALog : public ::testing::TestWithParam<const char*> {
 protected:
  /// Replays once, however many cases of this process ask for it.
  static std::string replay_on(int threads) {
    static std::map<std::pair<std::string, int>, std::string> replayed;
    std::string& out = replayed[{GetParam(), threads}];
    if (out.empty()) out = replay("threads", std::to_string(threads));
    return out;
  }
  static std::string replay(const std::string& option, const std::string& value) {
    const std::string out = test::temporary_folder(option + "_" + value) + "/out.log";
    const auto result =
        test::run({test::program("limbcast-replay"),
                   test::repository_file(std::string("logs/") + GetParam() + ".log"), out,
                   "--" + option + "=" + value});
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return out;
  }
};

// Update on purpose with tests/replay/update_golden.sh.
TEST_P(ReplayOfALog, GivesTheRecordedPoses) {
  const auto golden = pose_json::read_file(
      test::repository_file(std::string("tests/replay/golden/") + GetParam() + ".jsonl"));
  // Recorded so, since what is quickest computes in 16 bits on some processors.
  const std::string replayed = replay("segmenter.portable-networks", "true");
  EXPECT_THAT(pose_differences(golden, poses_of(replayed)), ::testing::IsEmpty());
}

TEST_P(ReplayOfALog, GivesTheSameBytesOnAnyNumberOfThreads) {
  // Four: more than some computers have, so that they overtake one another. No EXPECT_EQ: it would
  // print megabytes.
  EXPECT_TRUE(bytes_of(replay_on(4)) == bytes_of(replay_on(1))) << "4 threads give another log";
}

TEST_P(ReplayOfALog, HasImagesAndCloudsThatAreSmallEnoughForTheNetwork) {
  constexpr std::size_t kMostBytes = 250'000;  // a lost fragment loses the message
  for (const lcm_io::LogEvent& event : events_of(replay_on(4))) {
    if (event.channel != "STEREO_IMAGES" && event.channel != "POINT_CLOUD") continue;
    EXPECT_LE(event.data.size(), kMostBytes) << event.channel << " at " << event.utime;
  }
}

INSTANTIATE_TEST_SUITE_P(Logs, ReplayOfALog, ::testing::Values("demo", "multi", "nobody"),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace limbcast::replay
