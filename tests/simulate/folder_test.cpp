#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/camera/calibration_reader.hpp"
#include "common/camera/recording.hpp"
#include "common/config/options.hpp"
#include "modules/simulate/frame_folder.hpp"
#include "modules/simulate/options.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace limbcast::simulate {
namespace {

class FolderTest : public ::testing::Test {
 protected:
  SimulatorParams write_frames(SensorKind sensor, int count) const {
    SimulatorParams params;
    params.camera = {160, 120, 130.0, 130.0, 79.5, 59.5};
    params.scenario.set = SetKind::kPointing;
    params.sensor = sensor;
    FrameFolder folder(folder_.path(), params);
    for (int i = 0; i < count; ++i) folder.write(simulate_frame(params, 1, i));
    return params;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(FolderTest, AStereoFolderReadsBackAsARecording) {
  const SimulatorParams params = write_frames(SensorKind::kStereo, 2);

  const Recording recording = find_recording(folder_.path(), {"left", "right"}, {});
  const StereoCalibration calibration = read_stereo_calibration(folder_ / "calibration.yml");

  ASSERT_EQ(recording.frames.size(), 2U);
  EXPECT_TRUE(recording.has_timestamps);
  EXPECT_FALSE(recording.frames[0].truth_path.empty());
  ASSERT_TRUE(recording.frames[0].time.down.has_value());
  EXPECT_NEAR(baseline_m(calibration), params.baseline_m, 1e-9);
  EXPECT_EQ(cv::imread(recording.frames[1].first_path).cols, 160);
}

TEST_F(FolderTest, ADepthFolderReadsBackAsARecording) {
  write_frames(SensorKind::kDepth, 1);

  const Recording recording = find_recording(folder_.path(), {"color", "depth"}, {});
  const DepthCalibration calibration = read_depth_calibration(folder_ / "calibration.yml");

  ASSERT_EQ(recording.frames.size(), 1U);
  EXPECT_EQ(cv::imread(recording.frames[0].second_path, cv::IMREAD_UNCHANGED).type(), CV_16U);
  EXPECT_NEAR(calibration.color.camera.fx, 130.0, 1e-9);
}

TEST_F(FolderTest, TheTruthHasEveryJointAndItsFlag) {
  write_frames(SensorKind::kLaser, 1);

  nlohmann::json truth;
  std::ifstream(folder_ / "pointing_0000_gt.json") >> truth;

  ASSERT_EQ(truth["persons"].size(), 1U);
  const auto& person = truth["persons"][0];
  for (const auto name : kJointNames) {
    EXPECT_TRUE(person["joints"].contains(std::string(name))) << name;
    EXPECT_TRUE(person["visible"].contains(std::string(name))) << name;
  }
  EXPECT_TRUE(person["pointing"]["side"] == "left" || person["pointing"]["side"] == "right");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pointing_0000.pcd"));
}

TEST_F(FolderTest, AFolderThatCannotBeMadeIsWrongUsage) {
  EXPECT_THROW(FrameFolder("/proc/nowhere", SimulatorParams{}), config::UsageError);
}

TEST_F(FolderTest, AFolderThatHoldsARecordingIsRefusedAndStaysAsItIs) {
  write_frames(SensorKind::kLaser, 1);
  const auto size = std::filesystem::file_size(folder_ / "timestamps.csv");

  EXPECT_EQ(
      test::error_of<config::UsageError>([&] { write_frames(SensorKind::kStereo, 1); }),
      folder_.path() + ": holds a recording already; choose another --output or delete the folder");
  EXPECT_EQ(std::filesystem::file_size(folder_ / "timestamps.csv"), size);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "calibration.yml"));
}

TEST_F(FolderTest, AFolderThatAnotherProcessWritesIsRefused) {
  const FrameFolder other(folder_.path(), SimulatorParams{});
  std::filesystem::remove(folder_ / "timestamps.csv");  // as before the other one has made it
  EXPECT_EQ(test::error_of<config::UsageError>([&] { write_frames(SensorKind::kLaser, 1); }),
            folder_.path() + ": is being written by another process; choose another folder");
}

TEST_F(FolderTest, AFolderOnAFullDiskHoldsNoRecording) {
  const auto make_folder_on_a_full_disk = [this] {
    test::let_files_grow_to(8);  // bytes of a file, less than a line
    std::exit(config::run_program("simulate", [this] { write_frames(SensorKind::kLaser, 0); }));
  };
  EXPECT_EXIT(make_folder_on_a_full_disk(), ::testing::ExitedWithCode(1), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "timestamps.csv"));
}

TEST_F(FolderTest, AFolderThatHoldsOtherThingsIsUsed) {
  folder_.write("notes.txt", "of the set");
  EXPECT_NO_THROW(write_frames(SensorKind::kLaser, 1));
}

TEST(Options, RefuseWhatContradictsItself) {
  SimulateOptions options;
  options.output = "folder";
  options.log = "out.log";
  EXPECT_THROW(to_params(options), config::UsageError);
  options.log.clear();
  EXPECT_NO_THROW(to_params(options));
  options.params.scenario.min_distance_m = 4.0;
  options.params.scenario.max_distance_m = 3.0;
  EXPECT_THROW(to_params(options), config::UsageError);
}

}  // namespace
}  // namespace limbcast::simulate
