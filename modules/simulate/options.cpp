#include "modules/simulate/options.hpp"

#include <algorithm>
#include <map>

namespace limbcast::simulate {

namespace {

std::vector<std::string> posture_choices() {
  std::vector<std::string> choices = natural_posture_names();
  // "any" is there as well: arms that go anywhere. For the option it means any posture.
  choices.erase(std::remove(choices.begin(), choices.end(), "any"), choices.end());
  choices.insert(choices.begin(), "any");
  return choices;
}

/// What would say nothing to the set or to the output that was chosen.
void refuse_idle_options(const SimulateOptions& options) {
  const bool poses = options.set == "general" || options.set == "multi";
  if (options.posture != "any" && !poses)
    throw config::UsageError("--posture is of the sets general and multi, not of " + options.set);
  if (options.motion != "any" && options.set != "sequence")
    throw config::UsageError("--motion is of the set sequence, not of " + options.set);
  const bool live = options.output.empty() && options.log.empty();
  if (options.loop && !live)
    throw config::UsageError("--loop is of live frames; leave it out with --output or --log");
}

}  // namespace

void declare(config::Section& section, SimulateOptions& options) {
  SimulatorParams& params = options.params;
  section.add_name("output", options.output, "folder to write the frames to");
  section.add_name("log", options.log,
                   "LCM log to write; without folder and log the frames go out live");
  section.add("rate", options.rate_hz, "frames/s", "of live frames", {0.1, 1000.0});
  section.add("loop", options.loop, "live: start again at the end");
  section.add("sensor-name", options.sensor_name, "name of the sensor in all messages");
  section.add("frames", options.frames, "", "how many frames", {1, 1000000});
  section.add("first", options.first, "", "number of the first frame", {0, 1000000});
  section.add("seed", options.seed, "", "of all that is drawn; the same seed gives the same frames",
              {0, 1000000000});
  section.add_choice("set", options.set, {"pointing", "general", "multi", "nohuman", "sequence"},
                     "what people do");
  section.add_choice(
      "sensor", options.sensor, {"stereo", "stereo-depth", "depth", "laser"},
      "a pair of pictures, the depth that matching gives, a depth camera, a laser range finder");
  section.add_choice("noise", options.noise, {"varied", "fixed"},
                     "another device with every frame, or a mean one");
  section.add_choice("posture", options.posture, posture_choices(),
                     "of everybody in the set general; in multi of those who do not point");
  section.add_choice("motion", options.motion,
                     {"any", "walk-point", "wave", "point-around", "sit-down"},
                     "of everybody in the set sequence");
  section.add("persons", options.persons, "", "people in a frame, 0 = as the set has it", {0, 8});
  section.add("color", params.color, "pictures for depth cameras too");
  section.add("blind", params.blind, "no masks, labels and true depth");
  section.add("min-distance-m", params.scenario.min_distance_m, "m", "of people from the camera",
              {0.5, 20.0});
  section.add("max-distance-m", params.scenario.max_distance_m, "m", "of people from the camera",
              {0.5, 20.0});
  section.add("min-camera-height-m", params.scenario.min_camera_height_m, "m", "over the ground",
              {0.05, 5.0});
  section.add("max-camera-height-m", params.scenario.max_camera_height_m, "m", "over the ground",
              {0.05, 5.0});
  section.add("occluder-share", params.scenario.occluder_share, "",
              "of frames with something before a person", {0.0, 1.0});
  section.add("street-share", params.scenario.street_share, "",
              "of frames among trunks, poles, bushes and cars, not in a room", {0.0, 1.0});
  section.add("head-above-share", params.scenario.head_above_share, "",
              "of people whose head is above the image, their chest in it", {0.0, 1.0});
  section.add("child-share", params.scenario.body.child_share, "", "of people who are children",
              {0.0, 1.0});
  section.add("coat-share", params.scenario.body.coat_share, "", "of people who wear thick coats",
              {0.0, 1.0});
  section.add("frame-rate-hz", params.scenario.frame_rate_hz, "Hz", "of a sequence", {0.1, 1000.0});
  section.add("pitch-down-deg", params.scenario.pitch_down_deg, "deg", "mean pitch of the camera",
              {-90.0, 90.0});
  section.add("pitch-sigma-deg", params.scenario.pitch_sigma_deg, "deg",
              "its standard deviation from frame to frame", {0.0, 30.0});
  section.add("width-px", params.camera.width, "px", "of the pictures", {32, 8192});
  section.add("height-px", params.camera.height, "px", "of the pictures", {32, 8192});
  section.add("focal-px", params.camera.fx, "px", "focal length", {20.0, 20000.0});
  section.add("baseline-m", params.baseline_m, "m", "of the stereo camera", {0.01, 5.0});
  section.add("rings", params.laser.rings, "", "rows of the laser range finder", {1, 2048});
  section.add("azimuth-step-deg", params.laser.azimuth_step_deg, "deg",
              "between two returns of a row", {0.01, 5.0});
  section.add("max-azimuth-deg", params.laser.max_azimuth_deg, "deg",
              "the laser sweeps to both sides", {1.0, 180.0});
  section.add("max-elevation-deg", params.laser.max_elevation_deg, "deg",
              "the laser looks up and down", {1.0, 90.0});
  section.add("range-sigma-m", params.laser.range_sigma_m, "m", "noise of the laser", {0.0, 1.0});
  section.add("ring-range-sigma-m", params.laser.ring_range_sigma_m, "m",
              "by which each ring's ranges are off", {0.0, 1.0});
  section.add("ring-azimuth-sigma-deg", params.laser.ring_azimuth_sigma_deg, "deg",
              "by which each ring's azimuths are off", {0.0, 5.0});
  section.add("organised", params.laser.organised, "keep the laser's rows, with NaN for no return");
  section.add("report", options.report,
              "tell to what distance poses will be right, from runs of limbcast-replay");
  section.add("report-from-m", options.report_params.from_m, "m", "nearest distance of the report",
              {0.5, 20.0});
  section.add("report-to-m", options.report_params.to_m, "m", "farthest distance of the report",
              {0.5, 20.0});
  section.add("report-step-m", options.report_params.step_m, "m", "between two distances",
              {0.1, 10.0});
  section.add("report-frames", options.report_params.frames, "", "simulated at each distance",
              {1, 1000});
}

SimulatorParams to_params(const SimulateOptions& options) {
  static const std::map<std::string, SetKind> sets = {{"pointing", SetKind::kPointing},
                                                      {"general", SetKind::kGeneral},
                                                      {"multi", SetKind::kMulti},
                                                      {"nohuman", SetKind::kNoHuman},
                                                      {"sequence", SetKind::kSequence}};
  static const std::map<std::string, SensorKind> sensors = {
      {"stereo", SensorKind::kStereo},
      {"stereo-depth", SensorKind::kStereoDepth},
      {"depth", SensorKind::kDepth},
      {"laser", SensorKind::kLaser}};
  static const std::map<std::string, MotionKind> motions = {
      {"any", MotionKind::kAny},
      {"walk-point", MotionKind::kWalkPoint},
      {"wave", MotionKind::kWave},
      {"point-around", MotionKind::kPointAround},
      {"sit-down", MotionKind::kSitDown}};
  SimulatorParams params = options.params;
  if (!options.output.empty() && !options.log.empty()) {
    throw config::UsageError("--output and --log exclude one another: give one of them");
  }
  refuse_idle_options(options);
  if (options.sensor_name.empty()) throw config::UsageError("--sensor-name must not be empty");
  if (params.scenario.min_distance_m >= params.scenario.max_distance_m) {
    throw config::UsageError("--min-distance-m must be less than --max-distance-m");
  }
  if (params.scenario.min_camera_height_m > params.scenario.max_camera_height_m) {
    throw config::UsageError("--min-camera-height-m must not be more than --max-camera-height-m");
  }
  if (options.report_params.from_m > options.report_params.to_m) {
    throw config::UsageError("--report-from-m must not be more than --report-to-m");
  }
  params.scenario.set = sets.at(options.set);
  params.sensor = sensors.at(options.sensor);
  params.vary_noise = options.noise == "varied";
  params.scenario.posture = options.posture == "any" ? "" : options.posture;
  params.scenario.motion = motions.at(options.motion);
  params.scenario.min_persons = params.scenario.max_persons = options.persons;
  params.laser.min_azimuth_deg = -params.laser.max_azimuth_deg;
  params.laser.min_elevation_deg = -params.laser.max_elevation_deg;
  PinholeCamera& camera = params.camera;
  camera.fy = camera.fx;
  const PinholeCamera standard = SimulatorParams{}.camera;
  if (camera.width != standard.width || camera.height != standard.height) {
    camera.cx = 0.5 * (camera.width - 1);
    camera.cy = 0.5 * (camera.height - 1);
  }
  return params;
}

void refuse_options_of_others(const SimulateOptions& options, const config::Parser& parser) {
  const bool stereo = options.sensor == "stereo", laser = options.sensor == "laser";
  const bool stereo_depth = options.sensor == "stereo-depth", depth = options.sensor == "depth";
  const bool to_folder = !options.output.empty();
  const bool live = !to_folder && options.log.empty();
  const bool has_people = options.report || options.set != "nohuman" || options.persons > 0;
  struct Owner {
    bool is_chosen;
    const char* name;
    std::vector<std::string> keys;
  };
  const std::vector<Owner> owners = {
      {options.report,
       "with --report only",
       {"report-from-m", "report-to-m", "report-step-m", "report-frames"}},
      {!options.report,
       "not with --report",
       {"output", "log", "frames", "first", "set", "noise", "rate", "sensor-name", "min-distance-m",
        "max-distance-m", "occluder-share", "blind", "stereo-images-channel",
        "stereo-calibration-channel", "depth-images-channel", "point-cloud-channel",
        "truth-channel"}},
      {laser,
       "for the sensor laser only",
       {"rings", "azimuth-step-deg", "max-azimuth-deg", "max-elevation-deg", "range-sigma-m",
        "ring-range-sigma-m", "ring-azimuth-sigma-deg", "organised", "point-cloud-channel"}},
      {stereo,
       "for the sensor stereo only",
       {"stereo-images-channel", "stereo-calibration-channel"}},
      {stereo || stereo_depth, "for the sensors stereo and stereo-depth only", {"baseline-m"}},
      {stereo_depth || depth,
       "for the sensors stereo-depth and depth only",
       {"noise", "color", "depth-images-channel"}},
      {options.report || options.set != "sequence",
       "for other sets than sequence",
       {"min-distance-m", "occluder-share", "head-above-share"}},
      // Distances may be a camera's that sees people in other sets.
      {has_people,
       "for frames with people only",
       {"occluder-share", "head-above-share", "child-share", "coat-share"}},
      {live, "for live frames only", {"rate"}},
      {!to_folder,
       "for logs and live frames only",
       {"sensor-name", "stereo-images-channel", "stereo-calibration-channel",
        "depth-images-channel", "point-cloud-channel", "truth-channel"}},
      {to_folder && !laser, "for pictures in a folder only", {"blind"}}};
  for (const Owner& owner : owners) {
    const std::string given = owner.is_chosen ? "" : parser.on_command_line(owner.keys);
    if (!given.empty())
      throw config::UsageError("command line: leave out " + given + " (" + owner.name + ")");
  }
}

}  // namespace limbcast::simulate
