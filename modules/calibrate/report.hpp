#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "modules/calibrate/seen_area.hpp"
#include "modules/calibrate/stereo_fit.hpp"

namespace limbcast::calibrate {

/// A line for each view with its errors.
std::string view_table(const std::vector<ViewFit>& figures);
/// A line for each pair that was not used, with the reason.
std::string rejected_table(const std::vector<RejectedView>& rejected);
/// A line for each image of which points were left out: how many, and how far the farthest was off.
std::string left_out_table(const std::vector<OutlyingPoint>& left_out);
/// What was found: errors, focal lengths, how much of what the cameras see was covered, baseline.
std::string summary_text(const StereoFit& fit, const SeenAreas& seen);

/// Both images with the boards' points and where they stood, over the errors of each view, 8-bit
/// BGR.
cv::Mat draw_report(const StereoFit& fit, const SeenAreas& seen);

}  // namespace limbcast::calibrate
