#include "modules/segmenter/growing/filters.hpp"

#include <gtest/gtest.h>

#include "modules/segmenter/growing/cluster_figures.hpp"

namespace limbcast::segmenter {
namespace {

/// A standing person's, seen from 2 m: passes all filters.
ClusterFigures person() {
  ClusterFigures figures;
  figures.points = 10000;
  figures.area_m2 = 0.5F;
  figures.seed_over_centroid_m = 0.6F;
  figures.density = 0.8F;
  return figures;
}

TEST(Filters, PassAPerson) { EXPECT_FALSE(check_validity(person(), {}).has_value()); }

TEST(Filters, RejectTooFewPoints) {
  ClusterFigures figures = person();
  figures.points = 200;
  figures.area_m2 = 0.01F;
  const auto rejection = check_validity(figures, {});
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kTooFewPoints);
  EXPECT_FLOAT_EQ(rejection->figure, 200.0F);
  EXPECT_FLOAT_EQ(rejection->limit, 600.0F);  // 0.03 m^2 * 200 points / 0.01 m^2
}

TEST(Filters, RejectTooManyPoints) {
  ClusterFigures figures = person();
  figures.points = 44000;
  figures.area_m2 = 4.4F;
  const auto rejection = check_validity(figures, {});
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kTooManyPoints);
  EXPECT_FLOAT_EQ(rejection->figure, 44000.0F);
  EXPECT_FLOAT_EQ(rejection->limit, 22000.0F);  // 2.2 m^2 * 44000 points / 4.4 m^2
}

TEST(Filters, RejectASeedThatIsNotOverTheCentroid) {
  ClusterFigures figures = person();
  figures.seed_over_centroid_m = -0.2F;  // a hand that hangs down
  const auto rejection = check_validity(figures, {});
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kSeedNotHead);
  EXPECT_FLOAT_EQ(rejection->figure, -0.2F);
  EXPECT_FLOAT_EQ(rejection->limit, FilterParams().min_seed_over_centroid_m);
}

TEST(Filters, RejectASeedFarBesideTheCentroid) {
  ClusterFigures figures = person();
  figures.seed_beside_centroid_m = 0.5F;  // a hand raised high, at the end of an arm
  const auto rejection = check_validity(figures, kPaperFilters);
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kSeedNotHead);
  EXPECT_FLOAT_EQ(rejection->figure, 0.5F);
  EXPECT_FLOAT_EQ(rejection->limit, kPaperFilters.max_seed_beside_centroid_m);
}

TEST(Filters, OfThePaperAreStricterThanThoseOfJointGrowing) {
  const FilterParams loose;
  EXPECT_GT(kPaperFilters.min_area_m2, loose.min_area_m2);
  EXPECT_LT(kPaperFilters.max_area_m2, loose.max_area_m2);
  EXPECT_GT(kPaperFilters.min_seed_over_centroid_m, loose.min_seed_over_centroid_m);
  EXPECT_LT(kPaperFilters.max_seed_beside_centroid_m, loose.max_seed_beside_centroid_m);
  EXPECT_GT(kPaperFilters.min_density, loose.min_density);
  EXPECT_FALSE(check_validity(person(), kPaperFilters).has_value());
}

TEST(Filters, RejectALowDensity) {
  ClusterFigures figures = person();
  figures.density = 0.1F;
  const auto rejection = check_validity(figures, {});
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kTooSparse);
  EXPECT_FLOAT_EQ(rejection->figure, 0.1F);
  EXPECT_FLOAT_EQ(rejection->limit, FilterParams().min_density);
}

TEST(Filters, RejectAClusterWithoutPoints) {
  const auto rejection = check_validity(ClusterFigures{}, {});
  ASSERT_TRUE(rejection.has_value());
  EXPECT_EQ(rejection->filter, SegmentFilter::kTooFewPoints);
  EXPECT_FLOAT_EQ(rejection->limit, 0.0F);
}

}  // namespace
}  // namespace limbcast::segmenter
