// Prints how many faces are seen at true heads, of people who face the sensor, stand sideways or
// with the back to it. limbcast-face-figures [SET...]: folders, of the data folder where they are
// no absolute paths.

#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "modules/segmenter/faces_and_joints/face_finder.hpp"
#include "tests/segmenter/recorded_frames.hpp"
#include "tests/support/data_sets.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// Turned by more than 60 degrees from here on, to either side.
constexpr float kFacingCosine = 0.5F;
constexpr std::array<const char*, 3> kTurns = {"facing", "sideways", "from behind"};
/// Log odds that the person faces the sensor: none is seen below the first limit.
constexpr std::array<float, 3> kLimits = {0.0F, 1.5F, 3.0F};

/// People of one turn, by the number of limits that their log odds pass.
using Counts = std::array<int, kLimits.size() + 1>;
using Table = std::array<Counts, kTurns.size()>;

/// Cosine between where a person faces and the way to the sensor.
float facing_cosine(const TruePerson& person, const Eigen::Vector3f& down) {
  const Eigen::Vector3f leftwards =
      person.joints_m.at("shoulder_left") - person.joints_m.at("shoulder_right");
  const Eigen::Vector3f front = down.cross(leftwards).normalized();
  const Eigen::Vector3f& head_m = person.joints_m.at("head");
  return -front.dot((head_m - down * down.dot(head_m)).normalized());
}

void count(const Cloud& cloud, const TruePerson& person, const FaceFinder& faces, Table& table) {
  if (!person.head_visible() || person.joints_m.count("shoulder_left") == 0 ||
      person.joints_m.count("shoulder_right") == 0)
    return;
  const Eigen::Vector3f& down = cloud.stamp.gravity.down;
  const Eigen::Vector3f& head_m = person.joints_m.at("head");
  const Eigen::Vector2f up_px =
      (cloud.camera->project(head_m - 0.1F * down) - cloud.camera->project(head_m)).normalized();
  const float log_odds = faces.look(cloud, head_m, up_px).facing_log_odds;
  std::size_t passed = 0;
  while (passed < kLimits.size() && log_odds > kLimits[passed]) ++passed;
  const float cosine = facing_cosine(person, down);
  ++table[cosine > kFacingCosine ? 0 : cosine > -kFacingCosine ? 1 : 2][passed];
}

void print(const char* who, const Table& table) {
  for (std::size_t turn = 0; turn < kTurns.size(); ++turn) {
    std::printf("| %s, %s |", kTurns[turn], who);
    for (const int people : table[turn]) std::printf(" %d |", people);
    std::puts("");
  }
}

}  // namespace

int main(int argc, char** argv) {
  return test::print_figures(
      "limbcast-face-figures", "Prints how sure the face finder is of who faces the sensor.",
      {"stereo_dev/general", "stereo_dev/pointing", "stereo_dev/hd"}, argc, argv,
      [](const test::DataSets& sets) {
        const FaceFinder faces({});
        Table tuned{}, checking{};
        for (const std::string& set : sets.names) {
          const FrameReader reader(sets.folder(set), DepthFrom::kTruth);
          for (const std::string& path : reader.paths()) {
            const LoadedFrame frame = reader.read(path);
            for (const TruePerson& person : frame.persons)
              count(frame.cloud, person, faces, person.for_checking() ? checking : tuned);
          }
        }
        std::puts("| people | log odds up to 0 | up to 1.5 | up to 3 | over 3 |");
        print("D4, D5", checking);
        print("others", tuned);
      });
}
