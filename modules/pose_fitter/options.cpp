#include "modules/pose_fitter/options.hpp"

namespace limbcast::pose_fitter {
namespace {

void declare_model(config::Section& section, HumanModelFiles& files) {
  section.add("model", files.links,
              "links of method paper: anthropometric, table1, or the path of a model file");
  section.add("joint-limits", files.joint_limits,
              "intervals of the 28 angles: joint_limits, or the path of a file");
  section.add("typical-poses", files.typical_poses,
              "the 27 poses and their rotations: typical_poses, or the path of a file");
}

void declare_error(config::Section& section, PaperFitterParams& paper) {
  section.add("alpha-distance", paper.alpha_distance, "1/m",
              "Eq. 1: weight of the distance between reference and found ends", {0.0, 1000.0});
  section.add("alpha-missing", paper.alpha_missing, "", "Eq. 1: weight of missing links",
              {0.0, 1000.0});
  section.add("alpha-unused", paper.alpha_unused, "",
              "Eq. 1: weight of the share of points that are not near the pose", {0.0, 1000.0});
  section.add("alpha-density", paper.alpha_density, "", "Eq. 1: weight of links of low density",
              {0.0, 1000.0});
}

}  // namespace

void declare(config::Section& section, PoseFitterOptions& options) {
  PaperFitterParams& paper = options.paper;
  section.add_choice(
      "method", options.method, {"refined", "paper"},
      "refined: body surface fitted to all points; paper: typical poses, link by link");
  declare_model(section, paper.model_files);
  section.add("max-passes", paper.max_passes, "",
              "method paper: fits of a person, each with the lengths that Eq. 2 found before",
              {1, 10});
  section.add("near-radius-m", paper.near_radius_m, "m",
              "method paper: link ends are searched this far from the reference point",
              {0.02, 1.0});
  declare_error(section, paper);
  section.add_choice("scale-average", options.scale_average, {"mean", "median"},
                     "Eq. 2: the paper says median and writes a mean");
  section.add_choice("scale-deviation", options.scale_deviation, {"fixed", "pose"},
                     "2 sigma rule: scale-sigma, or the deviation of the pose's own scales");
  section.add("scale-sigma", paper.scale_sigma, "",
              "2 sigma rule: deviation of a link's scale from the mean, as a share of it",
              {0.01, 10.0});
  section.add("angle-tolerance-deg", paper.angle_tolerance_deg, "deg",
              "method paper: joint limits may be passed by this much", {0.0, 180.0});
  section.add("max-elbow-bend-deg", paper.pointing.max_elbow_bend_deg, "deg",
              "method paper: an arm that bends more does not point", {0.0, 180.0});
  section.add("min-raise-deg", paper.pointing.min_raise_deg, "deg",
              "method paper: an arm nearer to the trunk does not point", {0.0, 180.0});
}

PaperFitterParams to_paper_params(const PoseFitterOptions& options) {
  PaperFitterParams paper = options.paper;
  paper.scale_average =
      options.scale_average == "median" ? ScaleAverage::kMedian : ScaleAverage::kMean;
  paper.scale_deviation =
      options.scale_deviation == "pose" ? ScaleDeviation::kPose : ScaleDeviation::kFixed;
  return paper;
}

}  // namespace limbcast::pose_fitter
