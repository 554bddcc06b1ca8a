#pragma once

#include <string>

#include "common/config/options.hpp"
#include "modules/pose_fitter/paper/paper_params.hpp"
#include "modules/pose_fitter/refined/refined_params.hpp"

namespace limbcast::pose_fitter {

/// Options of the pose fitter: what users turn, with their defaults.
struct PoseFitterOptions {
  std::string method = "refined";         ///< refined, paper
  std::string scale_average = "mean";     ///< mean, median
  std::string scale_deviation = "fixed";  ///< fixed, pose
  PaperFitterParams paper;
  RefinedParams refined;
};

/// Binds the keys of section [pose_fitter].
void declare(config::Section& section, PoseFitterOptions& options);

/// The paper's parameters that the options ask for.
PaperFitterParams to_paper_params(const PoseFitterOptions& options);

}  // namespace limbcast::pose_fitter
