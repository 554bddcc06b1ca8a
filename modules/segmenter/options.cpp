#include "modules/segmenter/options.hpp"

#include <map>
#include <string>
#include <utility>

#include "common/formatted.hpp"

namespace limbcast::segmenter {

namespace {

void declare_filters(config::Section& section, const std::string& prefix, const std::string& note,
                     FilterParams& filters) {
  section.add(prefix + "min-area-m2", filters.min_area_m2, "m^2",
              "visible surface of the smallest person" + note, {0.0F, 10.0F});
  section.add(prefix + "max-area-m2", filters.max_area_m2, "m^2",
              "visible surface of the largest person" + note, {0.0F, 100.0F});
  section.add(prefix + "min-seed-over-centroid-m", filters.min_seed_over_centroid_m, "m",
              "how far a head stands over its cluster's centroid" + note, {-2.0F, 2.0F});
  section.add(prefix + "max-seed-beside-centroid-m", filters.max_seed_beside_centroid_m, "m",
              "how far a head stands beside its cluster's centroid" + note, {0.0F, 2.0F});
  section.add(prefix + "min-density", filters.min_density, "",
              "share of a cluster's outline that its points must fill" + note, {0.0F, 1.0F});
}

void check(const SegmenterOptions& options) {
  const Params& params = options.params;
  for (const auto& [prefix, filters] :
       {std::pair("", &params.filters), std::pair("paper-", &params.paper_filters)}) {
    if (filters->min_area_m2 < filters->max_area_m2) continue;
    throw config::UsageError(formatted("%smin-area-m2 (%g) must be less than %smax-area-m2 (%g)",
                                       prefix, filters->min_area_m2, prefix, filters->max_area_m2));
  }
}

}  // namespace

void declare(config::Section& section, SegmenterOptions& options) {
  section.add_choice(
      "seeds", options.seeds, {"auto", "skin", "shape", "both"},
      "where growing starts: skin-coloured parts (the paper), heads by their shape, both, or "
      "what the cloud offers");
  section.add_choice("growing", options.growing, {"refined", "paper"},
                     "all heads together along the surface, or Algorithm 1 of the paper");
  section.add_choice("search", options.search, {"auto", "kdtree", "lattice"},
                     "how Algorithm 1 looks up neighbours");
  Params& params = options.params;
  section.add("max-distance-m", params.paper.max_distance_m, "m", "d_max of Algorithm 1",
              {0.005F, 1.0F});
  section.add("max-iterations", params.paper.max_iterations, "points", "i_max of Algorithm 1",
              {1, 100000000});
  section.add("reach-radius-m", params.reach.radius_m, "m",
              "radius of the cylinder a human can reach", {0.3F, 3.0F});
  section.add("ground-cut-m", params.joint.ground_cut_m, "m", "points lower than this are ground",
              {-1.0F, 0.5F});
  declare_filters(section, "", "", params.filters);
  declare_filters(section, "paper-", " (growing paper)", params.paper_filters);
  section.add("min-skin-log-ratio", params.skin.min_log_ratio, "",
              "log likelihood ratio above which a colour is skin", {-20.0F, 20.0F});
  section.add("faces", params.faces.enabled,
              "look for faces, which tell front from back; 2 to 3 ms of CPU a person");
  section.add(
      "pose-network", params.pose_network.enabled,
      "see each person's joints with a network in the colour image; 4 to 6 ms of CPU a person");
  section.add(
      "second-pose-network", params.second_pose_network.enabled,
      "see them with a second network too, which errs elsewhere; 8 to 22 ms of CPU a person");
  section.add("depth-pose", params.depth_pose.enabled,
              "see them in depths alone with limbcast's own network, which tells left from right "
              "without colours; 8 ms of CPU a person");
  section.add(
      "portable-networks", options.portable_networks,
      "compute networks in 32 bits as every processor can, so that other computers give the "
      "same poses; at half the speed where the processor has AVX2 and no AVX-512, or brain floats "
      "of 16 bits");
  section.add("range-image-margin-m", params.range_image_margin_m, "m",
              "space kept around a person in the range image", {0.0F, 2.0F});
}

Params to_params(const SegmenterOptions& options) {
  check(options);
  static const std::map<std::string, SeedSource> seeds = {{"auto", SeedSource::kAuto},
                                                          {"skin", SeedSource::kSkin},
                                                          {"shape", SeedSource::kShape},
                                                          {"both", SeedSource::kBoth}};
  static const std::map<std::string, Growing> growing = {{"refined", Growing::kRefined},
                                                         {"paper", Growing::kPaper}};
  static const std::map<std::string, SearchStructure> search = {
      {"auto", SearchStructure::kAuto},
      {"kdtree", SearchStructure::kKdTree},
      {"lattice", SearchStructure::kLattice}};
  Params params = options.params;
  params.seeds = seeds.at(options.seeds);
  params.growing = growing.at(options.growing);
  params.search = search.at(options.search);
  if (options.portable_networks)
    params.faces.library = params.pose_network.library = params.second_pose_network.library =
        params.depth_pose.library = NetworkLibrary::kXnnpack;
  return params;
}

}  // namespace limbcast::segmenter
