#include <gtest/gtest.h>

#include <algorithm>

#include "common/human_model/ground_truth_json.hpp"
#include "common/lcm_io/body_poses_codec.hpp"
#include "common/lcm_io/calibration_codec.hpp"
#include "common/lcm_io/depth_images_codec.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "common/lcm_io/stereo_images_codec.hpp"
#include "modules/simulate/frame_folder.hpp"
#include "modules/simulate/frame_messages.hpp"
#include "modules/simulate/truth.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::simulate {
namespace {

SimulatorParams small_params(SensorKind sensor) {
  SimulatorParams params;
  params.camera = {160, 120, 130.0, 130.0, 79.5, 59.5};
  params.scenario.set = SetKind::kPointing;
  params.sensor = sensor;
  params.laser.rings = 16;
  return params;
}

/// What stands in a log of one frame, by channel.
std::vector<lcm_io::LogEvent> logged(const FrameMessages& messages) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "frame.log";
  lcm_io::LogWriter writer(path);
  Outlet outlet(writer);
  messages.send({}, outlet);
  writer.close();
  std::vector<lcm_io::LogEvent> events;
  lcm_io::LogReader reader(path);
  while (auto event = reader.next()) events.push_back(*event);
  return events;
}

/// Of a message that is a frame or its truth.
stamp_t stamp_of(const lcm_io::LogEvent& event) {
  if (event.channel == "STEREO_IMAGES") return lcm_io::decode<stereo_images_t>(event.data).stamp;
  if (event.channel == "DEPTH_IMAGES") return lcm_io::decode<depth_images_t>(event.data).stamp;
  if (event.channel == "POINT_CLOUD") return lcm_io::decode<point_cloud_t>(event.data).stamp;
  return lcm_io::decode<body_poses_t>(event.data).stamp;
}

TEST(FrameMessages, AStereoFrameIsCalibrationPairAndTruth) {
  const SimulatorParams params = small_params(SensorKind::kStereo);
  const SimulatedFrame frame = simulate_frame(params, 1, 0);

  const auto events = logged(FrameMessages(params, frame, "front", 5));

  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].channel, "STEREO_CALIBRATION");
  EXPECT_EQ(events[1].channel, "STEREO_IMAGES");
  EXPECT_EQ(events[2].channel, "GROUND_TRUTH");
  const StereoImages images = lcm_io::from_message(lcm_io::decode<stereo_images_t>(events[1].data));
  EXPECT_EQ(images.left.cols, 160);
  EXPECT_EQ(images.stamp.utime, frame.scenario.utime);
  EXPECT_EQ(images.stamp.sensor, "front");
  EXPECT_EQ(images.stamp.sequence, 5);
}

TEST(FrameMessages, ADepthFrameKeepsItsMillimetres) {
  const SimulatorParams params = small_params(SensorKind::kDepth);
  const SimulatedFrame frame = simulate_frame(params, 1, 0);

  const auto events = logged(FrameMessages(params, frame, "front", 0));

  ASSERT_EQ(events.size(), 2U);
  const auto decoded = lcm_io::from_message(lcm_io::decode<depth_images_t>(events[0].data));
  for (int v = 0; v < 120; v += 7) {
    for (int u = 0; u < 160; u += 7) {
      EXPECT_NEAR(decoded.images.depth.at<std::uint16_t>(v, u),
                  1000.0F * frame.sensed_depth_m.at<float>(v, u), 0.51);
    }
  }
}

TEST(FrameMessages, ALaserFrameIsAListOfFinitePoints) {
  SimulatorParams params = small_params(SensorKind::kLaser);
  params.laser.organised = true;
  const SimulatedFrame frame = simulate_frame(params, 1, 0);

  const auto events = logged(FrameMessages(params, frame, "laser", 0));

  ASSERT_EQ(events.size(), 2U);
  const Cloud cloud = lcm_io::from_message(lcm_io::decode<point_cloud_t>(events[0].data));
  EXPECT_FALSE(cloud.organized());
  EXPECT_GT(cloud.points_m.size(), 1000U);
  EXPECT_EQ(cloud.intensities.size(), cloud.points_m.size());
  EXPECT_GT(*std::max_element(cloud.intensities.begin(), cloud.intensities.end()), 0.0F);
}

TEST(FrameMessages, TheTruthIsThatOfTheFolder) {
  const SimulatorParams params = small_params(SensorKind::kDepth);
  const SimulatedFrame frame = simulate_frame(params, 1, 2);
  const test::TemporaryFolder folder;
  FrameFolder(folder.path(), params).write(frame);

  const BodyPoses read = read_ground_truth(folder / (frame.scenario.name + "_gt.json"));
  const BodyPoses sent = truth_poses(frame.scenario, params.camera, {});

  ASSERT_EQ(read.persons.size(), sent.persons.size());
  for (std::size_t i = 0; i < read.persons.size(); ++i) {
    for (int j = 0; j < kJointCount; ++j) {
      const JointEstimate& a = read.persons[i].joints[j];
      const JointEstimate& b = sent.persons[i].joints[j];
      EXPECT_NEAR((a.position_m - b.position_m).norm(), 0.0F, 2e-4F) << kJointNames[j];
      EXPECT_EQ(a.confidence, b.confidence) << kJointNames[j];
    }
    ASSERT_EQ(read.persons[i].pointing.size(), sent.persons[i].pointing.size());
    EXPECT_EQ(read.persons[i].pointing[0].side, sent.persons[i].pointing[0].side);
    EXPECT_EQ(read.persons[i].pointing[0].confidence, sent.persons[i].pointing[0].confidence);
  }
}

TEST(FrameMessages, RestampingChangesTimeAndNumberOfAll) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kDepth, SensorKind::kLaser}) {
    const SimulatorParams params = small_params(sensor);
    FrameMessages messages(params, simulate_frame(params, 1, 0), "front", 0);

    messages.restamp(123456, 7);

    EXPECT_EQ(messages.utime(), 123456);
    int stamps = 0;
    for (const auto& event : logged(messages)) {
      if (event.channel == "STEREO_CALIBRATION") {
        EXPECT_EQ(lcm_io::decode<stereo_calibration_t>(event.data).utime, 123456);
        continue;
      }
      const stamp_t stamp = stamp_of(event);
      EXPECT_EQ(stamp.utime, 123456) << event.channel;
      EXPECT_EQ(stamp.sequence, 7) << event.channel;
      ++stamps;
    }
    EXPECT_EQ(stamps, 2);  // the frame and its truth
  }
}

}  // namespace
}  // namespace limbcast::simulate
