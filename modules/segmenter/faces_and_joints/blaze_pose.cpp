#include "modules/segmenter/faces_and_joints/blaze_pose.hpp"

#include <algorithm>
#include <array>

#include "modules/segmenter/networks/network.hpp"

// The file in ../networks/network_files.S.
extern "C" const char limbcast_blaze_pose[];

namespace limbcast::segmenter {
namespace {

// The network's landmarks (../models/README.md).
constexpr int kLeftEar = 7, kRightEar = 8;
constexpr std::array<JointOutput, 12> kJointLandmarks = {{{Joint::kShoulderLeft, 11},
                                                          {Joint::kShoulderRight, 12},
                                                          {Joint::kElbowLeft, 13},
                                                          {Joint::kElbowRight, 14},
                                                          {Joint::kWristLeft, 15},
                                                          {Joint::kWristRight, 16},
                                                          {Joint::kHipLeft, 23},
                                                          {Joint::kHipRight, 24},
                                                          {Joint::kKneeLeft, 25},
                                                          {Joint::kKneeRight, 26},
                                                          {Joint::kAnkleLeft, 27},
                                                          {Joint::kAnkleRight, 28}}};

/// What the network tells of a person, in the pixels of its input.
struct Landmarks {
  // Numbers of each landmark: column, row, depth [px], visibility, presence [log odds].
  static constexpr int kInInput = 5;
  const float* in_input;
  // Numbers of each landmark: right, down, away [m], from the middle of the hips.
  static constexpr int kInWorld = 3;
  const float* in_world;

  Eigen::Vector2f px(int landmark) const {
    return {in_input[kInInput * landmark], in_input[kInInput * landmark + 1]};
  }
  float visibility(int landmark) const {
    return probability(in_input[kInInput * landmark + 3]) *
           probability(in_input[kInInput * landmark + 4]);
  }
  float behind_hips_m(int landmark) const { return in_world[kInWorld * landmark + 2]; }
};

/// The head is where the middle of the ears is; the nearer one is seen.
ImageJoint head_of(const Landmarks& landmarks) {
  return {Joint::kHead, 0.5F * (landmarks.px(kLeftEar) + landmarks.px(kRightEar)),
          std::max(landmarks.visibility(kLeftEar), landmarks.visibility(kRightEar)),
          0.5F * (landmarks.behind_hips_m(kLeftEar) + landmarks.behind_hips_m(kRightEar))};
}

}  // namespace

const TfliteFile& BlazePose::file() {
  static const TfliteFile file = read_tflite(limbcast_blaze_pose);
  return file;
}

BlazePose::BlazePose(NetworkLibrary library)
    : network_(file(), {"Identity", "Identity_4", "Identity_1"}, library) {}

ImagePose BlazePose::see(const cv::Mat3b& picture) {
  constexpr double kWhite = 255.0;
  write_rgb(picture, 1.0 / kWhite, 0.0, network_.input());
  network_.run();
  const Landmarks landmarks{network_.output(0), network_.output(1)};
  ImagePose pose;
  pose.person_score = network_.output(2)[0];
  pose.joints.push_back(head_of(landmarks));
  for (const auto& [joint, landmark] : kJointLandmarks)
    pose.joints.push_back({joint, landmarks.px(landmark), landmarks.visibility(landmark),
                           landmarks.behind_hips_m(landmark)});
  return pose;
}

}  // namespace limbcast::segmenter
