#include "modules/viewer/playback.hpp"

#include <gtest/gtest.h>

namespace limbcast::viewer {
namespace {

TEST(Playback, PlaysToTheLastFrameAndStaysThere) {
  Playback playback(3);
  for (const int frame : {0, 1, 2}) {
    EXPECT_EQ(playback.frame(), frame);
    EXPECT_FALSE(playback.paused());
    playback.advance();
  }
  EXPECT_EQ(playback.frame(), 2);
  EXPECT_TRUE(playback.paused());
  EXPECT_FALSE(playback.ended());
}

TEST(Playback, PlaysAgainFromTheBeginOnceItIsThrough) {
  Playback playback(2);
  playback.apply(Command::kLast);
  playback.apply(Command::kPause);
  EXPECT_EQ(playback.frame(), 0);
  EXPECT_FALSE(playback.paused());
}

TEST(Playback, GoesOnWhereItWasPaused) {
  Playback playback(9);
  playback.advance();
  playback.apply(Command::kPause);
  playback.advance();
  EXPECT_EQ(playback.frame(), 1);
  playback.apply(Command::kPause);
  playback.advance();
  EXPECT_EQ(playback.frame(), 2);
}

TEST(Playback, StepsAndJumpsBothWaysAndPauses) {
  Playback playback(50);
  playback.apply(Command::kNext);
  EXPECT_EQ(playback.frame(), 1);
  EXPECT_TRUE(playback.paused());
  playback.apply(Command::kForward);
  EXPECT_EQ(playback.frame(), 11);
  playback.apply(Command::kPrevious);
  EXPECT_EQ(playback.frame(), 10);
  playback.apply(Command::kBack);
  EXPECT_EQ(playback.frame(), 0);
  playback.apply(Command::kLast);
  EXPECT_EQ(playback.frame(), 49);
  playback.apply(Command::kFirst);
  EXPECT_EQ(playback.frame(), 0);
}

TEST(Playback, StaysWithinTheLog) {
  Playback playback(5);
  playback.apply(Command::kPrevious);
  EXPECT_EQ(playback.frame(), 0);
  playback.seek(99);
  EXPECT_EQ(playback.frame(), 4);
  EXPECT_TRUE(playback.paused());
}

}  // namespace
}  // namespace limbcast::viewer
