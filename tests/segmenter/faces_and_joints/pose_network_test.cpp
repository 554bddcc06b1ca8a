#include "modules/segmenter/faces_and_joints/pose_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <thread>
#include <vector>

#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/turned_cloud.hpp"
#include "tests/support/demo_frame.hpp"

namespace limbcast::segmenter {
namespace {

bool tell_the_same(const ImagePose& a, const ImagePose& b) {
  return a.person_score == b.person_score &&
         std::equal(a.joints.begin(), a.joints.end(), b.joints.begin(), b.joints.end(),
                    [](const ImageJoint& i, const ImageJoint& k) {
                      return i.joint == k.joint && i.px == k.px && i.visibility == k.visibility &&
                             i.behind_hips_m == k.behind_hips_m;
                    });
}

const ImageJoint& find(const ImagePose& pose, Joint joint) {
  return *std::find_if(pose.joints.begin(), pose.joints.end(),
                       [&](const ImageJoint& seen) { return seen.joint == joint; });
}

/// The person of the demo log's first frame.
class JointsOfTheDemo : public ::testing::Test {
 protected:
  std::optional<ImagePose> look(const Cloud& cloud, const Eigen::Vector3f& head_m,
                                const PoseNetworkParams& params = {}) const {
    return PoseNetwork(params).look(cloud, {nobody_, kNobody, head_m}, cloud.stamp.gravity.down);
  }
  /// What the network tells where all of the cloud is `label`'s and it looks for person 0.
  ImagePose look_at_labels(std::int16_t label) const {
    const std::vector<std::int16_t> labels(cloud_.points_m.size(), label);
    return PoseNetwork({}).look(cloud_, {labels, 0, head_m_}, down_).value();
  }

  const test::DemoFrame& frame_ = test::demo_frame();
  const Cloud& cloud_ = frame_.cloud;
  const Eigen::Vector3f down_ = cloud_.stamp.gravity.down;
  const BodyPose& person_ = frame_.truth.persons.at(0);
  const Eigen::Vector3f head_m_ = person_[Joint::kHead].position_m;
  const std::vector<std::int16_t> nobody_ =
      std::vector<std::int16_t>(cloud_.points_m.size(), kNobody);
};

class NetworkAndJointsOfTheDemo : public JointsOfTheDemo,
                                  public ::testing::WithParamInterface<PictureNetworkKind> {};

TEST_P(NetworkAndJointsOfTheDemo, AreSeenWhereTheyAre) {
  constexpr float kNear_m = 0.10F;
  const PoseNetworkParams params =
      GetParam() == PictureNetworkKind::kMoveNet ? kSecondPoseNetwork : PoseNetworkParams{};
  const ImagePose pose =
      PoseNetwork(params, GetParam()).look(cloud_, {nobody_, kNobody, head_m_}, down_).value();
  ASSERT_EQ(pose.joints.size(), 13U);
  for (const ImageJoint& joint : pose.joints) {
    const JointEstimate& truth = person_[joint.joint];
    ASSERT_EQ(truth.confidence, 1.0F) << "visible";
    const Eigen::Vector3f told_m =
        cloud_.camera->back_project(joint.px.x(), joint.px.y(), truth.position_m.z());
    EXPECT_LT((told_m - truth.position_m).norm(), kNear_m) << kJointNames[index(joint.joint)];
    EXPECT_GT(joint.visibility, 0.5F) << kJointNames[index(joint.joint)];
  }
}

TEST_P(NetworkAndJointsOfTheDemo, AreSeenInTheSamePlacesByPortableNetworks) {
  const bool is_move_net = GetParam() == PictureNetworkKind::kMoveNet;
  // 0.6 and 2 cm at this person: MoveNet marks cells, and the best one may be a neighbour.
  const float near_px = is_move_net ? 4.0F : 1.0F;
  PoseNetworkParams params = is_move_net ? kSecondPoseNetwork : PoseNetworkParams{};
  const LabelledPerson person{nobody_, kNobody, head_m_};
  const ImagePose quick = PoseNetwork(params, GetParam()).look(cloud_, person, down_).value();
  params.library = NetworkLibrary::kXnnpack;
  const ImagePose portable = PoseNetwork(params, GetParam()).look(cloud_, person, down_).value();
  EXPECT_NEAR(quick.person_score, portable.person_score, 0.02F);
  for (const ImageJoint& joint : quick.joints) {
    const ImageJoint& other = find(portable, joint.joint);
    EXPECT_LT((joint.px - other.px).norm(), near_px) << kJointNames[index(joint.joint)];
    EXPECT_NEAR(joint.visibility, other.visibility, 0.05F) << kJointNames[index(joint.joint)];
  }
}

INSTANTIATE_TEST_SUITE_P(Both, NetworkAndJointsOfTheDemo,
                         ::testing::Values(PictureNetworkKind::kBlazePose,
                                           PictureNetworkKind::kMoveNet));

TEST_F(JointsOfTheDemo, AreToldBeforeAndBehindTheHips) {
  constexpr float kNear_m = 0.12F;  // of the trunk; arms are often wrong
  const ImagePose pose = look(cloud_, head_m_).value();
  const float hips_m = person_[Joint::kPelvis].position_m.z();
  for (const Joint joint : {Joint::kHead, Joint::kShoulderLeft, Joint::kShoulderRight,
                            Joint::kHipLeft, Joint::kHipRight})
    EXPECT_NEAR(find(pose, joint).behind_hips_m, person_[joint].position_m.z() - hips_m, kNear_m)
        << kJointNames[index(joint)];
}

TEST_F(JointsOfTheDemo, AreSureOfAPersonAndNotOfAWall) {
  EXPECT_GT(look(cloud_, head_m_)->person_score, 0.9F);
  EXPECT_LT(look(cloud_, {0.5F, -0.5F, 6.0F})->person_score, 0.1F);
}

TEST_F(JointsOfTheDemo, AreSeenByACameraThatHangsSideways) {
  const Cloud sideways = turned(cloud_);
  const ImagePose upright_pose = look(cloud_, head_m_).value();
  const ImagePose pose = look(sideways, turned(head_m_)).value();
  for (const ImageJoint& joint : pose.joints) {
    const Eigen::Vector2f& px = find(upright_pose, joint.joint).px;
    const Eigen::Vector2f expected(px.y(), static_cast<float>(cloud_.width - 1) - px.x());
    EXPECT_LT((joint.px - expected).norm(), 2.0F) << kJointNames[index(joint.joint)];
  }
}

TEST_F(JointsOfTheDemo, AreNotSeenWhereSomebodyElseIs) {
  const float own = look_at_labels(0).person_score;
  EXPECT_GT(own, 0.9F);
  EXPECT_LT(look_at_labels(1).person_score, 0.1F);
  for (const std::int16_t others : {kNobody, kUnsure})
    EXPECT_EQ(look_at_labels(others).person_score, own) << others;
}

TEST_F(JointsOfTheDemo, DoNotDependOnTheColorsOfOthers) {
  const Eigen::Vector2i wrist_px =
      cloud_.camera->project(person_[Joint::kWristRight].position_m).cast<int>();
  std::vector<std::int16_t> labels = nobody_;
  Cloud repainted = cloud_;
  for (int v = wrist_px.y() - 40; v < wrist_px.y() + 40; ++v) {
    for (int u = wrist_px.x() - 30; u < wrist_px.x() + 30; ++u) {
      const int i = v * cloud_.width + u;
      labels.at(i) = 1;
      repainted.colors[i] = {0, 0, 255};
    }
  }
  const PoseNetwork network({});
  const ImagePose pose = network.look(cloud_, {labels, 0, head_m_}, down_).value();
  EXPECT_TRUE(tell_the_same(pose, network.look(repainted, {labels, 0, head_m_}, down_).value()));
  EXPECT_FALSE(tell_the_same(pose, look(cloud_, head_m_).value()));
}

TEST_F(JointsOfTheDemo, AreToldOfThePeopleAndNotOfWhatIsRejected) {
  const std::vector<Segment> segments = segment(cloud_).segments;
  EXPECT_GE(
      std::count_if(segments.begin(), segments.end(), [](const Segment& s) { return s.valid(); }),
      1);
  for (const Segment& found : segments)
    EXPECT_EQ(found.image_poses.size(), found.valid() ? 3U : 0U);
  EXPECT_GT(segments.at(0).image_poses.at(0).person_score, 0.9F);
}

TEST_F(JointsOfTheDemo, AreNotSeenInColorsThatAreNone) {
  Cloud colorless = cloud_;
  colorless.colors.clear();
  EXPECT_FALSE(look(colorless, head_m_));
}

TEST_F(JointsOfTheDemo, AreNotToldInACloudThatIsNoCameras) {
  Cloud list = cloud_;
  list.camera.reset();
  EXPECT_FALSE(look(list, head_m_));
}

/// Whether each network looked.
std::vector<bool> looked(const Segments& segments) {
  std::vector<bool> looked;
  for (const ImagePose& pose : segments.segments.at(0).image_poses)
    looked.push_back(!pose.joints.empty());
  return looked;
}

TEST_F(JointsOfTheDemo, AreToldByTheNetworksThatAreWanted) {
  Params params;
  params.second_pose_network.enabled = false;
  EXPECT_EQ(looked(Segmenter(params).segment(cloud_)), (std::vector<bool>{true, false, true}));
  params.depth_pose.enabled = false;
  const Segments by_first = Segmenter(params).segment(cloud_);
  EXPECT_EQ(looked(by_first), (std::vector<bool>{true}));
  EXPECT_TRUE(tell_the_same(by_first.segments.at(0).image_poses[0],
                            segment(cloud_).segments.at(0).image_poses.at(0)));
  params.pose_network.enabled = false;
  EXPECT_TRUE(looked(Segmenter(params).segment(cloud_)).empty());
}

TEST_F(JointsOfTheDemo, AreNotToldOfAPersonTooSmallToSee) {
  const PoseNetworkParams params;
  const float far_m = static_cast<float>(cloud_.camera->fx) * params.side_m / params.min_side_px;
  EXPECT_FALSE(look(cloud_, {0.0F, 0.0F, 1.1F * far_m}));
  EXPECT_TRUE(look(cloud_, {0.0F, 0.0F, 0.9F * far_m}));
}

TEST_F(JointsOfTheDemo, AreNotToldOfWhatNoImageShows) {
  EXPECT_FALSE(look(cloud_, {50.0F, 0.0F, 3.0F})) << "beside the image";
  EXPECT_FALSE(look(cloud_, {0.0F, 0.0F, -3.0F})) << "behind the camera";
  Cloud level = cloud_;
  level.stamp.gravity.down = {0.0F, 1.0F, 0.0F};
  EXPECT_FALSE(look(level, {0.0F, -0.7F, 1e-4F})) << "at the camera";
  Cloud from_above = cloud_;
  from_above.stamp.gravity.down = {0.0F, 0.0F, 1.0F};
  EXPECT_FALSE(look(from_above, {0.0F, 0.0F, 3.0F})) << "straight below";
}

TEST_F(JointsOfTheDemo, AreTheSameForSeveralThreads) {
  const PoseNetwork network({});
  const LabelledPerson person{nobody_, 0, head_m_};
  const ImagePose alone = network.look(cloud_, person, down_).value();
  std::vector<ImagePose> poses(3);
  std::vector<std::thread> threads;
  for (ImagePose& pose : poses)
    threads.emplace_back([&] {
      for (int i = 0; i < 3; ++i) pose = network.look(cloud_, person, down_).value();
    });
  for (std::thread& thread : threads) thread.join();
  for (const ImagePose& pose : poses) EXPECT_TRUE(tell_the_same(pose, alone));
}

TEST_F(JointsOfTheDemo, AreTheSameForSeveralThreadsOfOpenCv) {
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const ImagePose alone = look(cloud_, head_m_).value();
  for (const int threads : {2, 3, 4}) {
    cv::setNumThreads(threads);
    EXPECT_TRUE(tell_the_same(look(cloud_, head_m_).value(), alone)) << threads;
  }
  cv::setNumThreads(before);
}

}  // namespace
}  // namespace limbcast::segmenter
