#include "modules/reconstructor/gaps.hpp"

#include <cmath>
#include <opencv2/core.hpp>

namespace limbcast::reconstructor {
namespace {

void fill_gaps_in_rows(const GapParams& params, cv::Mat1f& disparity_px) {
  for (int v = 0; v < disparity_px.rows; ++v) {
    float* row = disparity_px[v];
    int before = -1;  // the last pixel with a disparity
    for (int u = 0; u < disparity_px.cols; ++u) {
      if (row[u] <= 0.0F) continue;
      const int length = u - before - 1;
      if (before >= 0 && length > 0 && length <= params.max_length_px &&
          std::abs(row[u] - row[before]) < params.same_surface_px) {
        const float slope = (row[u] - row[before]) / static_cast<float>(u - before);
        for (int i = 1; i <= length; ++i)
          row[before + i] = row[before] + static_cast<float>(i) * slope;
      }
      before = u;
    }
  }
}

}  // namespace

void fill_gaps(const GapParams& params, cv::Mat1f& disparity_px) {
  fill_gaps_in_rows(params, disparity_px);
  cv::Mat1f transposed = disparity_px.t();
  fill_gaps_in_rows(params, transposed);
  cv::transpose(transposed, disparity_px);
}

}  // namespace limbcast::reconstructor
