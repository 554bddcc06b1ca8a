// Writes what limbcast's own network of poses sees of people whose joints are known, and of things
// in rooms without people, to train it on: limbcast-write-depth-pictures OUT.bin FOLDER... segments
// each folder's frames (pairs through the reconstructor) and writes a record for each person who is
// found and each thing that is taken for one: train_depth_pose.py reads them. Recorded people are
// only checked on, so bodies D4 and D5 are written too.

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/human_model/joints.hpp"
#include "modules/segmenter/faces_and_joints/depth_picture.hpp"
#include "modules/segmenter/seeds/seed_place.hpp"
#include "modules/segmenter/segmenter.hpp"
#include "tests/segmenter/recorded_frames.hpp"

namespace {

using namespace limbcast;
using namespace limbcast::segmenter;

/// Of a person whose head is no farther than this from a segment's [m].
constexpr float kSamePerson_m = 0.35F;

/// As train_depth_pose.py's RECORD.
struct TrueJoint {
  float u_px = 0.0F, v_px = 0.0F, behind_middle_m = 0.0F;
  float visible = 0.0F, told = 0.0F;  ///< 0 or 1
};
struct Record {
  std::array<Eigen::half, kDepthPictureSide_px * kDepthPictureSide_px * 4> channels;
  std::array<TrueJoint, kJointCount> joints;
  float px_per_m = 0.0F;   ///< at the picture's middle
  float is_person = 0.0F;  ///< 0 or 1: a thing
};

const TruePerson* person_at(const Eigen::Vector3f& head_m, const LoadedFrame& frame) {
  const TruePerson* nearest = nullptr;
  float nearest_m = kSamePerson_m;
  for (const TruePerson& person : frame.persons) {
    const auto head = person.joints_m.find("head");
    if (head == person.joints_m.end()) continue;
    const float distance_m = (head->second - head_m).norm();
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    nearest = &person;
  }
  return nearest;
}

bool shows_nobody(const LoadedFrame& frame) { return frame.labelled && frame.persons.empty(); }

TrueJoint joint_in(const DepthPicture& picture, const TruePerson& person, const std::string& name) {
  const auto told = person.joints_m.find(name);
  if (told == person.joints_m.end()) return {};
  const Eigen::Vector3f place_m = picture.frame_from_picture.transpose() * told->second;
  constexpr float kLeastDepth_m = 0.1F;
  if (!(place_m.z() > kLeastDepth_m)) return {};
  const Eigen::Vector2f px = picture.camera.project(place_m);
  const auto visible = person.visible.find(name);
  const bool in_sight = visible != person.visible.end() && visible->second;
  return {px.x(), px.y(), place_m.z() - picture.middle_m, in_sight ? 1.0F : 0.0F, 1.0F};
}

std::optional<Record> record_of(const Segment& segment, const std::optional<DepthPicture>& picture,
                                const LoadedFrame& frame) {
  if (!segment.valid() || !picture) return std::nullopt;
  const Eigen::Vector3f head_m = behind_surface(segment.seed_m);
  const TruePerson* person = person_at(head_m, frame);
  // Beside people a candidate that is at nobody's head may be somebody's hand.
  if (person == nullptr && !shows_nobody(frame)) return std::nullopt;
  Record record;
  const auto* channels = picture->channels.ptr<float>();
  for (std::size_t i = 0; i < record.channels.size(); ++i)
    record.channels[i] = static_cast<Eigen::half>(channels[i]);
  record.px_per_m = static_cast<float>(picture->camera.fx) / picture->middle_m;
  if (person == nullptr) return record;
  record.is_person = 1.0F;
  for (std::size_t i = 0; i < record.joints.size(); ++i)
    record.joints[i] = joint_in(*picture, *person, std::string(kJointNames[i]));
  return record;
}

/// The segmenters whose segments are drawn.
struct Segmenters {
  Segmenter usual, with_overlooked, of_rooms;
};

/// Of the segments; people whose heads are in `known_heads_m` are left out, and the others' added
/// there.
void add_records(const Segmenter& segmenter, const LoadedFrame& frame,
                 std::vector<Eigen::Vector3f>& known_heads_m, std::vector<Record>& records) {
  DepthPictures pictures;
  const Segments segments = segmenter.segment(frame.cloud, &pictures);
  std::vector<Eigen::Vector3f> heads_m;
  for (std::size_t k = 0; k < segments.segments.size(); ++k) {
    const Segment& segment = segments.segments[k];
    const auto record = record_of(segment, pictures[k], frame);
    if (!record) continue;
    const Eigen::Vector3f head_m = behind_surface(segment.seed_m);
    if (std::any_of(known_heads_m.begin(), known_heads_m.end(),
                    [&](const auto& known_m) { return (known_m - head_m).norm() < kSamePerson_m; }))
      continue;
    heads_m.push_back(head_m);
    records.push_back(*record);
  }
  known_heads_m.insert(known_heads_m.end(), heads_m.begin(), heads_m.end());
}

/// People as they are found, and those who are overlooked without the network of depths.
std::vector<Record> records_of(const LoadedFrame& frame, const Segmenters& segmenters) {
  std::vector<Record> records;
  std::vector<Eigen::Vector3f> known_heads_m;
  if (shows_nobody(frame)) {
    add_records(segmenters.of_rooms, frame, known_heads_m, records);
  } else {
    add_records(segmenters.usual, frame, known_heads_m, records);
    add_records(segmenters.with_overlooked, frame, known_heads_m, records);
  }
  return records;
}

Params without_depth_pose(Params params) {
  params.depth_pose.enabled = false;
  return params;
}

/// Whatever the network of depths is shown counts as a person, wherever it marks the head.
Params shown(Params params) {
  constexpr float kLowest = -100.0F;
  params.overlooked.min_person_odds = kLowest;
  return params;
}

/// Of rooms: takes whatever looks a little like a head, so that the network sees many things.
Params eager(Params params) {
  constexpr float kEager = 2.0F;
  params.classifier.min_head_odds -= kEager;
  params.classifier.min_panorama_head_odds -= kEager;
  params.classifier.min_person_odds -= kEager;
  params.pose_network.enabled = false;
  return params;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: limbcast-write-depth-pictures OUT.bin FOLDER...\n");
    return 2;
  }
  const Params params;
  const Segmenters segmenters{Segmenter(without_depth_pose(params)), Segmenter(shown(params)),
                              Segmenter(shown(eager(params)))};
  std::ofstream file(argv[1], std::ios::binary);
  for (int k = 2; k < argc; ++k) {
    const FrameReader reader(argv[k], DepthFrom::kReconstructor);
    std::vector<std::vector<Record>> frames(reader.paths().size());
    tbb::parallel_for(std::size_t{0}, frames.size(), [&](std::size_t i) {
      const LoadedFrame frame = reader.read(reader.paths()[i]);
      frames[i] = records_of(frame, segmenters);
    });
    std::size_t pictures = 0;
    for (const std::vector<Record>& records : frames) {
      pictures += records.size();
      file.write(reinterpret_cast<const char*>(records.data()),
                 static_cast<std::streamsize>(records.size() * sizeof(Record)));
    }
    std::printf("%s: %zu pictures of %zu frames\n", argv[k], pictures, frames.size());
    std::fflush(stdout);
  }
  if (!file.flush()) {
    std::fprintf(stderr, "limbcast-write-depth-pictures: %s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
