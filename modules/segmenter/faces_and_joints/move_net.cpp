#include "modules/segmenter/faces_and_joints/move_net.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/segmenter/networks/network.hpp"

// The file in ../networks/network_files.S.
extern "C" const char limbcast_move_net[];

namespace limbcast::segmenter {
namespace {

/// The network's maps have a cell for so many pixels of the picture.
constexpr int kCell_px = 4;
constexpr int kMapCells = kPictureSide_px / kCell_px;
constexpr float kMiddle_cells = 0.5F * kMapCells;
/// Keypoints of COCO, and the network's outputs.
constexpr int kKeypoints = 17;
enum Output { kCenter, kHeatmap, kRegression, kOffset };
/// A cell's weight is one over its distance to where it is expected and this [cells]: the network's
/// own (../models/README.md).
constexpr float kNearDistance_cells = 1.8F;

/// Of keypoints with these scores hardly one, and nine of ten, are within 10 cm (simulated people,
/// bodies D1 to D3); evenly more between them.
constexpr float kUnseenScore = 0.1F, kSeenScore = 0.5F;
float visibility(float score) {
  return std::clamp((score - kUnseenScore) / (kSeenScore - kUnseenScore), 0.0F, 1.0F);
}

constexpr int kLeftEarKeypoint = 3, kRightEarKeypoint = 4;
constexpr std::array<JointOutput, 12> kJointKeypoints = {{{Joint::kShoulderLeft, 5},
                                                          {Joint::kShoulderRight, 6},
                                                          {Joint::kElbowLeft, 7},
                                                          {Joint::kElbowRight, 8},
                                                          {Joint::kWristLeft, 9},
                                                          {Joint::kWristRight, 10},
                                                          {Joint::kHipLeft, 11},
                                                          {Joint::kHipRight, 12},
                                                          {Joint::kKneeLeft, 13},
                                                          {Joint::kKneeRight, 14},
                                                          {Joint::kAnkleLeft, 15},
                                                          {Joint::kAnkleRight, 16}}};

/// Column and row of a cell.
Eigen::Vector2f place_of(int cell) {
  const int row = cell / kMapCells;
  return {static_cast<float>(cell % kMapCells), static_cast<float>(row)};
}

/// The cell of the highest score, where those far from `expected` count less. `log_odds` are the
/// first cell's, the next cell's lie `stride` numbers on.
int best_cell(const float* log_odds, int stride, const Eigen::Vector2f& expected) {
  int best = 0;
  float best_weight = -1.0F;
  for (int cell = 0; cell < kMapCells * kMapCells; ++cell) {
    const float weight = probability(log_odds[cell * stride]) /
                         ((place_of(cell) - expected).norm() + kNearDistance_cells);
    if (weight <= best_weight) continue;
    best_weight = weight;
    best = cell;
  }
  return best;
}

/// Row and column of a keypoint in a map of such pairs, as column and row [cells].
Eigen::Vector2f pair_at(const float* pairs, int cell, int keypoint) {
  const float* pair = pairs + 2 * (cell * kKeypoints + keypoint);
  return {pair[1], pair[0]};
}

}  // namespace

const TfliteFile& MoveNet::file() {
  static const TfliteFile file = read_tflite(limbcast_move_net);
  return file;
}

MoveNet::MoveNet(NetworkLibrary library)
    : network_(file(), {"center", "heatmap", "regression", "offset"}, library) {}

int MoveNet::find_person() const {
  return best_cell(network_.output(kCenter), 1, Eigen::Vector2f::Constant(kMiddle_cells));
}

MoveNet::Keypoint MoveNet::find_keypoint(int person_cell, int keypoint) const {
  const float* heatmap = network_.output(kHeatmap) + keypoint;
  const Eigen::Vector2f expected =
      place_of(person_cell) + pair_at(network_.output(kRegression), person_cell, keypoint);
  const int cell = best_cell(heatmap, kKeypoints, expected);
  const Eigen::Vector2f place = place_of(cell) + pair_at(network_.output(kOffset), cell, keypoint);
  return {kCell_px * place, probability(heatmap[cell * kKeypoints])};
}

ImagePose MoveNet::see(const cv::Mat3b& picture) {
  constexpr double kMiddle = 127.5;
  write_rgb(picture, 1.0 / kMiddle, -1.0, network_.input());
  network_.run();
  const int person = find_person();
  const Keypoint left_ear = find_keypoint(person, kLeftEarKeypoint);
  const Keypoint right_ear = find_keypoint(person, kRightEarKeypoint);
  ImagePose pose;
  pose.person_score = probability(network_.output(kCenter)[person]);
  // The head is where the middle of the ears is; the nearer one is seen.
  pose.joints.push_back({Joint::kHead, 0.5F * (left_ear.px + right_ear.px),
                         visibility(std::max(left_ear.score, right_ear.score)), 0.0F});
  for (const auto& [joint, keypoint] : kJointKeypoints) {
    const Keypoint found = find_keypoint(person, keypoint);
    pose.joints.push_back({joint, found.px, visibility(found.score), 0.0F});
  }
  return pose;
}

}  // namespace limbcast::segmenter
