#include "modules/tracker/tracker.hpp"

#include <algorithm>
#include <cmath>

#include "common/units.hpp"
#include "modules/tracker/assignment.hpp"

namespace limbcast::tracker {
namespace {

/// Dearer than any pair within the gate, so that every such pair is made: of a person not seen for
/// long and with another body too.
constexpr double kCostAlone = 1e3;

}  // namespace

std::optional<BodyPoses> Tracker::track(const BodyPoses& measured) {
  const double elapsed_s =
      static_cast<double>(measured.stamp.utime - last_utime_.value_or(measured.stamp.utime)) /
      kMicrosecondsPerSecond<double>;
  const bool jumped = std::abs(elapsed_s) > params_.identity.forget_after_s;
  if (last_utime_ && elapsed_s <= 0.0 && !jumped) return std::nullopt;
  last_utime_ = measured.stamp.utime;
  if (jumped) tracks_.clear();

  begin_frame(elapsed_s);
  begin_new(measured, update_known(measured));

  BodyPoses tracked;
  tracked.stamp = measured.stamp;
  for (const PersonTrack& track : tracks_)
    if (track.is_told()) tracked.persons.push_back(track.pose());
  return tracked;
}

void Tracker::begin_frame(double elapsed_s) {
  for (PersonTrack& track : tracks_) track.advance(elapsed_s);
}

/// Gives each pose to the person it fits best. Which poses were given away.
std::vector<bool> Tracker::update_known(const BodyPoses& measured) {
  const std::vector<BodyPose>& persons = measured.persons;
  std::vector<std::vector<double>> costs;
  for (const PersonTrack& track : tracks_) {
    std::vector<double>& row = costs.emplace_back();
    for (const BodyPose& person : persons)
      row.push_back(track.cost(person, measured.stamp.gravity.down));
  }
  const auto person_of_track = assign(costs, persons.size(), kCostAlone);
  std::vector<bool> known(persons.size(), false);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (person_of_track[i]) {
      tracks_[i].update(persons[*person_of_track[i]]);
      known[*person_of_track[i]] = true;
    } else {
      tracks_[i].miss();
    }
  }
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(),
                               [](const PersonTrack& track) { return track.forgotten(); }),
                tracks_.end());
  return known;
}

/// Who fits nobody is new, unless two would stand in one place: the fitter found a body twice.
void Tracker::begin_new(const BodyPoses& measured, const std::vector<bool>& known) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    const BodyPose& person = measured.persons[i];
    const bool is_double =
        std::any_of(tracks_.begin(), tracks_.end(), [&](const PersonTrack& track) {
          return track.stands_at(person, measured.stamp.gravity.down);
        });
    if (!known[i] && !is_double) tracks_.emplace_back(++last_id_, person, params_);
  }
}

}  // namespace limbcast::tracker
