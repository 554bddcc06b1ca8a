#include "modules/tracker/stage.hpp"

#include "common/lcm_io/body_poses_codec.hpp"

namespace limbcast::tracker {
namespace {

void declare_identity(config::Section& section, IdentityParams& identity) {
  section.add("forget-after-s", identity.forget_after_s, "s",
              "a person who is not seen keeps the identity for this long", {0.0, 60.0});
  section.add("gate-sigmas", identity.gate_sigmas, "standard deviations",
              "a pose farther from where the person was expected is somebody else's", {0.5, 100.0});
  section.add("length-sigma-m", identity.length_sigma_m, "m",
              "deviation of a link's length from frame to frame; less: bodies count more",
              {0.001, 10.0});
  section.add("acceleration-sigma", identity.motion.acceleration_sigma_m_s2, "m/s^2",
              "how suddenly people start and stop", {0.01, 100.0});
}

void declare_prediction(config::Section& section, PredictionParams& prediction) {
  section.add("predict-s", prediction.predict_s, "s",
              "joints and persons that are not seen are predicted for this long; 0: never",
              {0.0, 10.0});
  section.add("frames-to-trust", prediction.frames_to_trust, "",
              "a person is predicted once seen in this many frames", {1, 1000});
}

void declare_smoothing(config::Section& section, const std::string& of, const std::string& speed,
                       OneEuroParams& filter) {
  section.add(of + "-min-cutoff-hz", filter.min_cutoff_hz, "Hz",
              "cutoff of the filter of " + of + " at rest; less: steadier", {0.001, 1000.0});
  section.add(of + "-speed-coefficient", filter.speed_coefficient, "Hz/(" + speed + ")",
              "rise of that cutoff with the speed; more: less lag", {0.0, 1e6});
  section.add(of + "-rest-speed", filter.rest_speed, speed,
              "speed that noise alone shows; slower " + of + " rest", {0.0, 100.0});
}

}  // namespace

void declare(config::Section& section, StageOptions& options) {
  declare_identity(section, options.algorithm.identity);
  declare_prediction(section, options.algorithm.prediction);
  declare_smoothing(section, "joints", "m/s", options.algorithm.joints);
  declare_smoothing(section, "pointing", "rad/s", options.algorithm.pointing);
  section.add_input_channel("body-poses-channel", options.body_poses_channel, "poses of people");
  section.add_output_channel("tracked-poses-channel", options.tracked_poses_channel,
                             "the same with identities, smoothed");
}

std::optional<body_poses_t> Stage::process(const body_poses_t& poses) {
  const BodyPoses measured = lcm_io::from_message(poses);
  const auto tracked = trackers_.get(measured.stamp.sensor, params_).track(measured);
  if (!tracked) return std::nullopt;
  return lcm_io::to_message(*tracked);
}

}  // namespace limbcast::tracker
