#include "modules/segmenter/growing/filters.hpp"

namespace limbcast::segmenter {

std::optional<Rejection> check_validity(const ClusterFigures& figures, const FilterParams& params) {
  const auto points = static_cast<float>(figures.points);
  // Limits are areas, so that they hold at any distance and resolution; the figures are points, as
  // in the paper.
  const float points_per_m2 = figures.area_m2 > 0.0F ? points / figures.area_m2 : 0.0F;
  if (figures.area_m2 < params.min_area_m2) {
    return Rejection{SegmentFilter::kTooFewPoints, points, params.min_area_m2 * points_per_m2};
  }
  if (figures.area_m2 > params.max_area_m2) {
    return Rejection{SegmentFilter::kTooManyPoints, points, params.max_area_m2 * points_per_m2};
  }
  if (figures.seed_over_centroid_m < params.min_seed_over_centroid_m) {
    return Rejection{SegmentFilter::kSeedNotHead, figures.seed_over_centroid_m,
                     params.min_seed_over_centroid_m};
  }
  if (figures.seed_beside_centroid_m > params.max_seed_beside_centroid_m) {
    return Rejection{SegmentFilter::kSeedNotHead, figures.seed_beside_centroid_m,
                     params.max_seed_beside_centroid_m};
  }
  if (figures.density < params.min_density) {
    return Rejection{SegmentFilter::kTooSparse, figures.density, params.min_density};
  }
  return std::nullopt;
}

}  // namespace limbcast::segmenter
