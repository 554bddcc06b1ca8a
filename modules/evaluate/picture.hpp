#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/evaluate/evaluation.hpp"

namespace limbcast::evaluate {

/// Cumulative distributions of the errors: joints by kind on the left (0 to 30 cm, of all visible
/// joints, so that a curve ends below 100 % where joints are missing), directions on the right (0
/// to 30 degrees).
cv::Mat draw_error_distribution(const Tally& tally);

}  // namespace limbcast::evaluate
