#include "tests/replay/pose_differences.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/angle.hpp"
#include "common/formatted.hpp"

namespace limbcast::replay {
namespace {

class Comparison {
 public:
  explicit Comparison(const Tolerance& tolerance) : tolerance_(tolerance) {}

  void compare(const BodyPoses& before, const BodyPoses& after) {
    where_ = "utime " + std::to_string(before.stamp.utime);
    const std::size_t common = std::min(before.persons.size(), after.persons.size());
    if (before.persons.size() != after.persons.size())
      add(formatted("%zu persons, before %zu", after.persons.size(), before.persons.size()));
    for (std::size_t i = 0; i < common; ++i) {
      where_ = formatted("utime %lld person %zu", static_cast<long long>(before.stamp.utime), i);
      compare_joints(before.persons[i], after.persons[i]);
      compare_pointing(before.persons[i].pointing, after.persons[i].pointing);
    }
  }
  void add_frame(std::int64_t utime, const std::string& text) {
    where_ = "utime " + std::to_string(utime);
    add(text);
  }
  std::vector<std::string> lines() const { return lines_; }

 private:
  void add(const std::string& text) { lines_.push_back(where_ + ": " + text); }

  void compare_joints(const BodyPose& before, const BodyPose& after) {
    for (int i = 0; i < kJointCount; ++i) {
      const JointEstimate &old_joint = before.joints[i], &new_joint = after.joints[i];
      const std::string name(kJointNames[i]);
      if (old_joint.valid != new_joint.valid) {
        add(name + (new_joint.valid ? " found, before left out" : " left out, before found"));
      } else if (new_joint.valid) {
        const float moved_m = (new_joint.position_m - old_joint.position_m).norm();
        if (moved_m > tolerance_.joint_m)
          add(formatted("%s moved by %.1f cm", name.c_str(), 100.0 * moved_m));
      }
    }
  }

  void compare_pointing(const std::vector<Pointing>& before, const std::vector<Pointing>& after) {
    if (before.empty() != after.empty()) {
      add(after.empty() ? "does not point, before it did" : "points, before it did not");
    } else if (!after.empty()) {
      if (before.front().side != after.front().side) {
        add("points with the other arm");
      } else if (const double turned_deg =
                     angle_deg(before.front().direction, after.front().direction);
                 turned_deg > tolerance_.direction_deg) {
        add(formatted("direction turned by %.1f degrees", turned_deg));
      }
    }
  }

  Tolerance tolerance_;
  std::string where_;
  std::vector<std::string> lines_;
};

std::map<std::int64_t, const BodyPoses*> by_utime(const std::vector<BodyPoses>& frames) {
  std::map<std::int64_t, const BodyPoses*> result;
  for (const BodyPoses& frame : frames) result[frame.stamp.utime] = &frame;
  return result;
}

}  // namespace

std::vector<std::string> pose_differences(const std::vector<BodyPoses>& before,
                                          const std::vector<BodyPoses>& after,
                                          const Tolerance& tolerance) {
  const auto old_frames = by_utime(before), new_frames = by_utime(after);
  std::set<std::int64_t> utimes;
  for (const auto& [utime, frame] : old_frames) utimes.insert(utime);
  for (const auto& [utime, frame] : new_frames) utimes.insert(utime);
  Comparison comparison(tolerance);
  for (const std::int64_t utime : utimes) {
    const auto old_frame = old_frames.find(utime), new_frame = new_frames.find(utime);
    if (old_frame == old_frames.end()) {
      comparison.add_frame(utime, "frame is new");
    } else if (new_frame == new_frames.end()) {
      comparison.add_frame(utime, "frame is gone");
    } else {
      comparison.compare(*old_frame->second, *new_frame->second);
    }
  }
  return comparison.lines();
}

}  // namespace limbcast::replay
