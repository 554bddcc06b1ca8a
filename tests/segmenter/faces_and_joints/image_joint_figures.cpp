// Prints how many visible joints each network of poses sees within 10 cm, from true heads, nobody
// painted over. limbcast-image-joint-figures [SET...]

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "modules/segmenter/faces_and_joints/pose_network.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/recorded_frames.hpp"
#include "tests/support/data_sets.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

constexpr float kNear_m = 0.10F;
/// A depth of less is neither before nor behind the hips.
constexpr float kClearlyBeside_m = 0.15F;

struct Tally {
  int joints = 0, near = 0;
  int with_depth = 0, right_sign = 0;  ///< of those clearly before or behind the hips

  void add(float error_m, float told_depth_m, float true_depth_m) {
    ++joints;
    near += error_m < kNear_m ? 1 : 0;
    if (std::abs(true_depth_m) < kClearlyBeside_m) return;
    ++with_depth;
    right_sign += told_depth_m * true_depth_m > 0.0F ? 1 : 0;
  }
};

/// Joints of one kind, left and right: of bodies D1 to D3, and of those kept for checking.
struct Row {
  std::string kind;
  std::array<Tally, 2> tallies;
};

Row& row_of(const std::string& joint, std::vector<Row>& rows) {
  const std::string kind = joint.substr(0, joint.find('_'));
  for (Row& row : rows) {
    if (row.kind == kind) return row;
  }
  return rows.emplace_back(Row{kind, {}});
}

void count(const Cloud& cloud, const TruePerson& person, const PoseNetwork& network,
           std::vector<Row>& rows) {
  const auto pelvis = person.joints_m.find("pelvis");
  if (!person.head_visible() || pelvis == person.joints_m.end()) return;
  const std::vector<std::int16_t> nobody(cloud.points_m.size(), kNobody);
  const auto pose =
      network.look(cloud, {nobody, kNobody, person.joints_m.at("head")}, cloud.stamp.gravity.down);
  if (!pose) return;
  for (const ImageJoint& joint : pose->joints) {
    const std::string name(kJointNames[index(joint.joint)]);
    const auto visible = person.visible.find(name);
    if (visible == person.visible.end() || !visible->second) continue;
    const Eigen::Vector3f& truth_m = person.joints_m.at(name);
    const Eigen::Vector3f told_m =
        cloud.camera->back_project(joint.px.x(), joint.px.y(), truth_m.z());
    row_of(name, rows)
        .tallies[person.for_checking() ? 1 : 0]
        .add((told_m - truth_m).norm(), joint.behind_hips_m, truth_m.z() - pelvis->second.z());
  }
}

void print(const std::vector<Row>& rows) {
  std::printf("| joints | D1 to D3 | D4, D5 (checking) | right side of the hips' depth |\n");
  for (const Row& row : rows) {
    const auto& [tuned, checking] = row.tallies;
    std::printf("| %s | %d of %d | %d of %d | %d of %d |\n", row.kind.c_str(), tuned.near,
                tuned.joints, checking.near, checking.joints,
                tuned.right_sign + checking.right_sign, tuned.with_depth + checking.with_depth);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return test::print_figures(
      "limbcast-image-joint-figures", "Prints where the networks of poses see joints in colours.",
      {"stereo_dev/general", "stereo_dev/pointing"}, argc, argv, [](const test::DataSets& sets) {
        const PoseNetwork blaze_pose({});
        const PoseNetwork move_net(kSecondPoseNetwork, PictureNetworkKind::kMoveNet);
        std::vector<Row> blaze_pose_rows, move_net_rows;
        for (const std::string& set : sets.names) {
          const FrameReader reader(sets.folder(set), DepthFrom::kTruth);
          for (const std::string& path : reader.paths()) {
            const LoadedFrame frame = reader.read(path);
            for (const TruePerson& person : frame.persons) {
              count(frame.cloud, person, blaze_pose, blaze_pose_rows);
              count(frame.cloud, person, move_net, move_net_rows);
            }
          }
        }
        std::puts("BlazePose");
        print(blaze_pose_rows);
        std::puts("MoveNet, which tells no depths");
        print(move_net_rows);
      });
}
