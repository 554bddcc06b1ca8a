#include "modules/segmenter/faces_and_joints/face_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>
#include <vector>

#include "modules/segmenter/segmenter.hpp"
#include "modules/simulate/render.hpp"
#include "tests/segmenter/recorded_frames.hpp"
#include "tests/segmenter/turned_cloud.hpp"
#include "tests/support/demo_frame.hpp"
#include "tests/support/lone_person.hpp"

namespace limbcast::segmenter {
namespace {

const Eigen::Vector2f kUpPx(0.0F, -1.0F);
/// Log odds of who faces the sensor, clearly.
constexpr float kClear = 2.0F;

bool tell_the_same(const FaceEvidence& a, const FaceEvidence& b) {
  return a.facing_log_odds == b.facing_log_odds && a.looks_right_log_odds == b.looks_right_log_odds;
}

/// The cloud as a mirror shows it.
Cloud mirrored(Cloud cloud) {
  for (auto row = cloud.colors.begin(); row != cloud.colors.end(); row += cloud.width)
    std::reverse(row, row + cloud.width);
  cloud.camera->cx = cloud.width - 1 - cloud.camera->cx;
  return cloud;
}

/// Two people of the demo log's first frame, the first of whom looks at the camera.
class FacesOfTheDemo : public ::testing::Test {
 protected:
  FaceEvidence look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                    const Eigen::Vector2f& up_px = kUpPx) const {
    return FaceFinder(params_).look(cloud, head_m, up_px);
  }

  const Cloud& cloud_ = test::demo_frame().cloud;
  const Segment person_ = segment(cloud_).segments.at(0);
  const Eigen::Vector3f head_m_ = person_.seed_m;
  const FaceParams params_{};
};

TEST_F(FacesOfTheDemo, TellThatWhoLooksAtTheSensorFacesIt) {
  EXPECT_GE(look(cloud_, head_m_).facing_log_odds, kClear);
  EXPECT_GE(person_.face.facing_log_odds, kClear);
}

TEST_F(FacesOfTheDemo, AreNotSeenAtTheTrunk) {
  const Eigen::Vector3f trunk_m = head_m_ + Eigen::Vector3f(0.0F, 0.6F, 0.0F);
  EXPECT_LT(look(cloud_, trunk_m).facing_log_odds, 0.0F);
}

TEST_F(FacesOfTheDemo, AreSeenByACameraThatHangsSideways) {
  const Eigen::Vector3f head_m = turned(head_m_);
  const Cloud sideways = turned(cloud_);
  EXPECT_GE(look(sideways, head_m, {-1.0F, 0.0F}).facing_log_odds, kClear);
  EXPECT_LT(look(sideways, head_m, kUpPx).facing_log_odds, kClear);
}

TEST_F(FacesOfTheDemo, TellNothingWithoutColor) {
  Cloud colorless = cloud_;
  colorless.colors.clear();
  EXPECT_TRUE(tell_the_same(look(colorless, head_m_), {}));
}

TEST_F(FacesOfTheDemo, TellNothingInACloudThatIsNoCameras) {
  Cloud list = cloud_;
  list.camera.reset();
  EXPECT_TRUE(tell_the_same(look(list, head_m_), {}));
}

TEST_F(FacesOfTheDemo, TellNothingOfAHeadTooSmallToSee) {
  const float far_m =
      static_cast<float>(cloud_.camera->fx) * params_.patch_m / params_.min_patch_px * 1.01F;
  EXPECT_TRUE(tell_the_same(look(cloud_, {0.0F, 0.0F, far_m}), {}));
  EXPECT_FALSE(tell_the_same(look(cloud_, {0.0F, 0.0F, 0.98F * far_m}), {}));
}

TEST_F(FacesOfTheDemo, AreTheSameForSeveralThreads) {
  const FaceFinder finder(params_);
  const FaceEvidence alone = finder.look(cloud_, head_m_, kUpPx);
  std::vector<FaceEvidence> evidence(4);
  std::vector<std::thread> threads;
  for (FaceEvidence& result : evidence)
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) result = finder.look(cloud_, head_m_, kUpPx);
    });
  for (std::thread& thread : threads) thread.join();
  for (const FaceEvidence& result : evidence) EXPECT_TRUE(tell_the_same(result, alone));
}

TEST_F(FacesOfTheDemo, AreNotLookedForWhereNobodyWantsThem) {
  Params params;
  params.faces.enabled = false;
  EXPECT_TRUE(tell_the_same(Segmenter(params).segment(cloud_).segments.at(0).face, {}));
}

/// Simulated people without hats, 2 m away.
class SimulatedFaces : public ::testing::Test {
 protected:
  /// Of how many of ten people who are turned by `yaw_rad` the face tells that they face the
  /// sensor.
  int facing(double yaw_rad) const {
    const FaceFinder finder(params_);
    int count = 0;
    for (int person = 0; person < 10; ++person) {
      const simulate::Scenario scenario = somebody(person, yaw_rad);
      const Eigen::Vector3f head_m = scenario.persons[0].skeleton[Joint::kHead].cast<float>();
      if (finder.look(photo_of(scenario), head_m, kUpPx).facing_log_odds >= kClear) ++count;
    }
    return count;
  }

 private:
  static simulate::Scenario somebody(int seed, double yaw_rad) {
    test::LonePerson person;
    person.yaw_rad = yaw_rad;
    person.arms = -Eigen::Vector3d::UnitY();
    person.distance_m = 2.0;
    person.sensor_height_m = 1.5;
    person.seed = static_cast<std::uint64_t>(seed);
    simulate::Scenario scenario = test::scenario_of(person);
    scenario.light = Eigen::Vector3f(0.3F, -0.5F, -0.8F).normalized();
    return scenario;
  }

  static Cloud photo_of(const simulate::Scenario& scenario) {
    Cloud cloud;
    cloud.camera = PinholeCamera{160, 120, 525.0, 525.0, 79.5, 59.5};
    // Only the head is in the picture.
    const Eigen::Vector3f head_m = scenario.persons[0].skeleton[Joint::kHead].cast<float>();
    cloud.camera->cy -= cloud.camera->fy * head_m.y() / head_m.z();
    cloud.width = cloud.camera->width;
    cloud.height = cloud.camera->height;
    cloud.points_m.resize(static_cast<std::size_t>(cloud.width) * cloud.height);
    const cv::Mat3b photo = simulate::color_image(
        scenario, simulate::look(scenario.world, *cloud.camera), *cloud.camera, simulate::Rng(1));
    for (const cv::Vec3b& pixel : photo) cloud.colors.push_back({pixel[0], pixel[1], pixel[2]});
    return cloud;
  }

  const FaceParams params_{};
};

TEST_F(SimulatedFaces, AreSeenFromTheFrontAndNotFromBehind) {
  constexpr double kTurnedAway_rad = 3.14159;
  EXPECT_GE(facing(0.0), 8);
  EXPECT_EQ(facing(kTurnedAway_rad), 0);
}

/// Rendered people of whom is known how they stand.
class RecordedFace : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  }
  static LoadedFrame read(const std::string& name, const std::string& folder = kFolder) {
    return FrameReader(folder, DepthFrom::kTruth).read(folder + "/" + name);
  }

  inline static const std::string kFolder = LIMBCAST_DATA_DIR "/stereo_dev/pointing";
  const FaceParams params_{};
};

TEST_F(RecordedFace, IsNotSeenFromBehind) {
  for (const char* name : {"pointing60_0007", "pointing60_0017", "pointing60_0047"}) {
    const LoadedFrame frame = read(name);
    const Eigen::Vector3f& head_m = frame.persons.at(0).joints_m.at("head");
    EXPECT_LT(FaceFinder(params_).look(frame.cloud, head_m, kUpPx).facing_log_odds, 0.0F) << name;
  }
}

TEST_F(RecordedFace, TellsToWhichSideItLooks) {
  const LoadedFrame frame = read("pointing60_0014");
  Eigen::Vector3f head_m = frame.persons.at(0).joints_m.at("head");
  const FaceFinder finder(params_);
  EXPECT_GT(finder.look(frame.cloud, head_m, kUpPx).looks_right_log_odds, 1.0F);
  head_m.x() = -head_m.x();
  EXPECT_LT(finder.look(mirrored(frame.cloud), head_m, kUpPx).looks_right_log_odds, -1.0F);
}

/// What is held before a trunk is taken for a back, unless the face weighs more than a simulated
/// one may.
TEST_F(RecordedFace, OfARealManInPlainSightTellsMoreThanASimulatedOne) {
  constexpr float kSimulated = 4.0F;
  for (const char* name : {"seated_00007", "seated_00011", "seated_00016", "seated_00019"}) {
    const LoadedFrame frame = read(name, LIMBCAST_DATA_DIR "/rgbd_pointing");
    const Eigen::Vector3f& head_m = frame.persons.at(0).joints_m.at("head");
    EXPECT_GT(FaceFinder(params_).look(frame.cloud, head_m, kUpPx).facing_log_odds, kSimulated)
        << name;
  }
}

}  // namespace
}  // namespace limbcast::segmenter
