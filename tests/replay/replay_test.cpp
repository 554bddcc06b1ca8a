#include "modules/replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limbcast/body_poses_t.hpp>
#include <limbcast/module_status_t.hpp>
#include <limbcast/stereo_images_t.hpp>

#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/module.hpp"
#include "tests/replay/log_tools.hpp"
#include "tests/support/child_process.hpp"

namespace limbcast::replay {
namespace {

using lcm_io::LogEvent;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class ReplayProgram : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string write(const std::string& name, const std::vector<LogEvent>& events) const {
    write_events(path(name), events);
    return path(name);
  }
  std::string write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  test::RunResult replay(const std::vector<std::string>& arguments) const {
    std::vector<std::string> command = {test::program("limbcast-replay")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::run(command);
  }
  std::vector<LogEvent> replayed(const std::string& in,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {in, path("replayed.log")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = replay(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return events_of(path("replayed.log"));
  }
  void expect_wrong_usage(const std::vector<std::string>& arguments,
                          const std::string& text) const {
    const auto result = replay(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(text));
  }

  const std::string folder_ = test::temporary_folder("replay");
  const std::vector<LogEvent> two_frames_ =
      first_frames(test::repository_file("logs/multi.log"), 2);
};

TEST_F(ReplayProgram, HandsThroughWhatItReadsInOrderAndAddsWhatItMakes) {
  const auto out = replayed(write("in.log", two_frames_));
  std::vector<LogEvent> handed_through;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::string& channel = out[i].channel;
    if (channel == "STEREO_IMAGES") {
      ASSERT_LT(i + 3, out.size());
      EXPECT_EQ(out[i + 1].channel, "POINT_CLOUD");
      EXPECT_EQ(out[i + 2].channel, "SEGMENTS");
      EXPECT_EQ(out[i + 3].channel, "BODY_POSES");
      EXPECT_EQ(out[i + 3].utime, out[i].utime);
    }
    if (channel != "POINT_CLOUD" && channel != "SEGMENTS" && channel != "BODY_POSES")
      handed_through.push_back(out[i]);
  }
  EXPECT_TRUE(same(handed_through, two_frames_));
  EXPECT_THAT(on_channel(out, "BODY_POSES"), SizeIs(2));
  EXPECT_THAT(on_channel(out, "GROUND_TRUTH"), SizeIs(2));
}

TEST_F(ReplayProgram, MakesResultsOfAnEarlierRunAnew) {
  const auto first = replayed(write("in.log", two_frames_));
  std::vector<LogEvent> with_more = first;
  with_more.push_back({9, "TRACKED_POSES", {1}});
  with_more.push_back({9, "MODULE_STATUS", {1}});
  EXPECT_TRUE(same(replayed(write("again.log", with_more)), first));
}

TEST_F(ReplayProgram, BeginsWithCloudsOrSegments) {
  const auto first = replayed(write("in.log", two_frames_));
  EXPECT_TRUE(same(replayed(write("a.log", first), {"--from", "clouds"}), first));
  EXPECT_TRUE(same(replayed(write("b.log", first), {"--from", "segments"}), first));
  // Without images the chain begins with what there is.
  EXPECT_TRUE(same(replayed(write("c.log", on_channel(first, "POINT_CLOUD"))), [&] {
    std::vector<LogEvent> made;
    for (const LogEvent& event : first)
      if (event.channel == "POINT_CLOUD" || event.channel == "SEGMENTS" ||
          event.channel == "BODY_POSES")
        made.push_back(event);
    return made;
  }()));
}

TEST_F(ReplayProgram, TakesChannelsAndParametersFromTheConfigurationFile) {
  std::vector<LogEvent> renamed = two_frames_;
  for (LogEvent& event : renamed) {
    if (event.channel == "STEREO_IMAGES") event.channel = "FRONT_IMAGES";
  }
  const std::string config =
      write_text("robot.conf",
                 "[reconstructor]\nstereo-images-channel = "
                 "FRONT_IMAGES\n[pose_fitter]\nbody_poses_channel = FRONT_POSES\n");
  const auto out = replayed(write("in.log", renamed), {"--config", config});
  EXPECT_THAT(on_channel(out, "FRONT_POSES"), SizeIs(2));
  EXPECT_THAT(on_channel(out, "BODY_POSES"), SizeIs(0));
}

TEST_F(ReplayProgram, TakesACalibrationThatComesLate) {
  std::vector<LogEvent> late = two_frames_;
  ASSERT_EQ(late.front().channel, "STEREO_CALIBRATION");
  std::rotate(late.begin(), late.begin() + 1, late.end());
  const auto out = replayed(write("late.log", late));
  EXPECT_TRUE(same(on_channel(out, "BODY_POSES"),
                   on_channel(replayed(write("in.log", two_frames_)), "BODY_POSES")));
}

TEST_F(ReplayProgram, BeginsWithCloudsWhereAPartOfALogHasNoCalibration) {
  const auto first = replayed(write("in.log", two_frames_));
  std::vector<LogEvent> part;
  for (const LogEvent& event : first)
    if (event.channel != "STEREO_CALIBRATION" && event.channel != "SEGMENTS") part.push_back(event);
  const auto result = replay({write("part.log", part), path("again.log")});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("no calibration of stereo camera"));
  EXPECT_TRUE(same(on_channel(events_of(path("again.log")), "BODY_POSES"),
                   on_channel(first, "BODY_POSES")));
}

TEST_F(ReplayProgram, WorksOnceOnAFrameThatTwoHostsHeard) {
  std::vector<LogEvent> doubled;
  for (const LogEvent& event : two_frames_) doubled.insert(doubled.end(), 2, event);
  const auto out = replayed(write("in.log", doubled));
  EXPECT_THAT(on_channel(out, "STEREO_IMAGES"), SizeIs(4));
  EXPECT_THAT(on_channel(out, "BODY_POSES"), SizeIs(2));
}

TEST_F(ReplayProgram, SaysThatTheCalibrationIsMissing) {
  std::vector<LogEvent> bare;
  for (const LogEvent& event : two_frames_) {
    if (event.channel != "STEREO_CALIBRATION") bare.push_back(event);
  }
  const auto result = replay({write("bare.log", bare), path("out.log")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output,
              HasSubstr("no calibration of stereo camera 'stereo' on STEREO_CALIBRATION; log that "
                        "channel beside the images"));
  EXPECT_TRUE(same(events_of(path("out.log")), bare));
}

TEST_F(ReplayProgram, CountsMalformedMessagesAndGoesOn) {
  std::vector<LogEvent> events = two_frames_;
  LogEvent truncated = on_channel(events, "STEREO_IMAGES").front();
  truncated.data.resize(truncated.data.size() / 2);
  events.insert(events.begin() + 1, {5, "STEREO_IMAGES", {1, 2, 3}});
  events.insert(events.begin() + 1, truncated);
  events.insert(events.begin() + 1, {5, "STEREO_CALIBRATION", {}});
  events.insert(events.begin() + 1, {5, "POINT_CLOUD", {9}});
  const auto result = replay({write("in.log", events), path("out.log")});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("4 malformed messages"));
  EXPECT_THAT(on_channel(events_of(path("out.log")), "BODY_POSES"), SizeIs(2));
}

TEST_F(ReplayProgram, FailsWhereEveryFrameIsMalformed) {
  std::vector<LogEvent> events = two_frames_;
  for (LogEvent& event : events) {
    if (event.channel != "STEREO_IMAGES") continue;
    auto message = lcm_io::decode<stereo_images_t>(event.data);
    message.left.width = -1;
    message.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
  }
  const auto result = replay({write("in.log", events), path("out.log")});
  EXPECT_EQ(result.exit_code, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("2 malformed messages"));
  EXPECT_THAT(result.output,
              HasSubstr(path("in.log") + ": every frame is malformed, nothing was made from them"));
  EXPECT_TRUE(same(events_of(path("out.log")), events));
}

TEST_F(ReplayProgram, ReplaysWhatATornLogHolds) {
  std::vector<LogEvent> events = two_frames_;
  while (events.back().channel != "STEREO_IMAGES") events.pop_back();
  const std::string torn = write("torn.log", events);
  std::filesystem::resize_file(torn, std::filesystem::file_size(torn) - 1000);
  const auto result = replay({torn, path("out.log")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("is torn, its last"));
  EXPECT_THAT(on_channel(events_of(path("out.log")), "BODY_POSES"), SizeIs(1));
}

TEST_F(ReplayProgram, GoesOnWhereALoggerAddsASensorMeanwhile) {
  std::vector<LogEvent> events;
  for (int i = 0; i <= 10; ++i) {
    BodyPoses poses;
    poses.stamp.utime = i;
    poses.stamp.sensor = i < 10 ? "front" : "rear";
    events.push_back({i, "BODY_POSES", lcm_io::encode(lcm_io::to_message(poses))});
  }
  ReplayOptions options;
  options.in = write("in.log", events);
  options.out = path("out.log");
  options.from = Level::kPoses;
  options.track = true;
  // What the logger has written at the begin ends within the event of the second sensor.
  const auto whole_bytes = std::filesystem::file_size(options.in);
  std::filesystem::resize_file(options.in, whole_bytes - 10);
  limbcast::replay::replay(options, ChainOptions{}, [&](int done, int) {
    if (done == 1) write("in.log", events);
  });
  EXPECT_TRUE(same(on_channel(events_of(options.out), "BODY_POSES"), events));
}

TEST_F(ReplayProgram, EndsWithTwoForLogsThatCannotBeUsed) {
  const std::string out = path("out.log");
  expect_wrong_usage({path("none.log"), out}, "no such file");
  expect_wrong_usage({write_text("empty.log", ""), out}, "is empty");
  expect_wrong_usage({write_text("foreign.log", "just a text"), out}, "is no LCM log");
  expect_wrong_usage({write("truth.log", on_channel(two_frames_, "GROUND_TRUTH")), out},
                     "truth.log: holds no images, clouds or segments");
  const std::string torn = write("torn.log", on_channel(two_frames_, "STEREO_IMAGES"));
  std::filesystem::resize_file(torn, 1000);
  expect_wrong_usage({torn, out},
                     "torn.log: is torn, its last 1000 bytes are no whole message and were left "
                     "out; what is left holds no images, clouds or segments");
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(ReplayProgram, EndsWithTwoForWrongUsage) {
  const std::string in = write("in.log", two_frames_);
  expect_wrong_usage({in}, "OUT.log");
  expect_wrong_usage({in, in}, "is what is read; choose another OUT.log");
  EXPECT_TRUE(same(events_of(in), two_frames_));
  expect_wrong_usage({in, path("no/folder/out.log")},
                     "there is no folder " + path("no/folder") + "; make it or choose another");
  expect_wrong_usage({in, folder_}, folder_ + ": is a folder; give a file to OUT.log");
  expect_wrong_usage({in, path("out.log"), "--threads", "0"}, "threads");
  expect_wrong_usage({in, path("out.log"), "--segmenter.no-such-key=1"}, "no-such-key");
  expect_wrong_usage(
      {in, path("out.log"), "--config", write_text("robot.conf", "[segmenter]\nno_such_key = 1\n")},
      "no-such-key");
}

TEST_F(ReplayProgram, IsWholeWhereItIsToldToEndAfterItsLastFrame) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // others of these tests have started threads
  ReplayOptions options;
  options.in = write("in.log", up_to_last(two_frames_, "STEREO_IMAGES"));
  options.out = path("out.log");
  const auto replay_and_exit = [&options] {
    const ReplaySummary summary =
        limbcast::replay::replay(options, ChainOptions{}, [](int done, int total) {
          if (done == total) lcm_io::request_stop();
        });
    std::fputs(summary.left_by_interrupt.c_str(), stderr);
    std::_Exit(static_cast<int>(on_channel(events_of(options.out), "BODY_POSES").size()));
  };
  EXPECT_EXIT(replay_and_exit(), ::testing::ExitedWithCode(2), "^$");
}

// Last: the stop that it asks for holds for the rest of this program.

TEST_F(ReplayProgram, KeepsWhatWasWrittenWhenItIsInterrupted) {
  ReplayOptions options;
  options.in = test::repository_file("logs/multi.log");
  options.out = write("out.log", two_frames_);
  const ChainOptions chain;
  const ReplaySummary summary =
      limbcast::replay::replay(options, chain, [](int, int) { lcm_io::request_stop(); });
  EXPECT_EQ(summary.left_by_interrupt,
            path("out.log.unfinished") + " holds what was replayed so far");
  EXPECT_GE(summary.frames, 1);
  EXPECT_LT(summary.frames, 8);
  EXPECT_THAT(on_channel(events_of(path("out.log.unfinished")), "BODY_POSES"),
              SizeIs(summary.frames));
  EXPECT_TRUE(same(events_of(options.out), two_frames_)) << "an earlier log is as it was";
}

}  // namespace
}  // namespace limbcast::replay
