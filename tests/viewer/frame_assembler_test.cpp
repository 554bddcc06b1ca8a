#include "modules/viewer/frame_assembler.hpp"

#include <gtest/gtest.h>

#include "tests/viewer/scene.hpp"

namespace limbcast::viewer {
namespace {

TEST(FrameAssembler, PutsMessagesOfOneMomentTogetherInAnyOrder) {
  FrameAssembler assembler;
  assembler.add_truth(pointing_arm(7));
  assembler.add(pointing_arm(7));
  assembler.add(wall(7));
  const auto frame = assembler.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stamp.utime, 7);
  EXPECT_TRUE(frame->cloud && frame->poses && frame->truth);
  EXPECT_FALSE(frame->segments);
  EXPECT_FALSE(assembler.next());
}

TEST(FrameAssembler, KeepsMomentsAndSensorsApart) {
  FrameAssembler assembler;
  assembler.add(wall(7));
  assembler.add(pointing_arm(8));
  BodyPoses other = pointing_arm(7);
  other.stamp.sensor = "rear";
  assembler.add(other);
  int num_frames = 0;
  while (const auto frame = assembler.next_at_end()) {
    EXPECT_NE(frame->cloud.has_value(), frame->poses.has_value());
    EXPECT_EQ(frame->number, num_frames++);
  }
  EXPECT_EQ(num_frames, 3);
}

TEST(FrameAssembler, HasNoFrameOfTruthAlone) {
  FrameAssembler assembler;
  assembler.add_truth(pointing_arm(1));
  EXPECT_FALSE(assembler.next());
  EXPECT_FALSE(assembler.next_at_end());
}

TEST(FrameAssembler, GivesUpOnFramesWithoutPoses) {
  FrameAssembler assembler;
  int num_frames = 0;
  for (int i = 1; i <= 100; ++i) {
    assembler.add(wall(i));
    while (assembler.next()) ++num_frames;
  }
  EXPECT_GT(num_frames, 50);
}

TEST(FrameAssembler, PutsMessagesTogetherAfterTheClockWasSetBack) {
  FrameAssembler assembler;
  for (int i = 0; i < 100; ++i) {  // of a camera that the chain was too slow for
    assembler.add_truth(pointing_arm(1000 + i));
    EXPECT_FALSE(assembler.next());
  }
  assembler.add_truth(pointing_arm(7));
  EXPECT_FALSE(assembler.next());
  assembler.add(wall(7));
  EXPECT_FALSE(assembler.next()) << "the poses are still to come";
  assembler.add(pointing_arm(7));
  const auto frame = assembler.next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->cloud && frame->poses && frame->truth);
}

}  // namespace
}  // namespace limbcast::viewer
