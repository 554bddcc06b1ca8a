#include "common/lcm_io/segments_codec.hpp"

#include <gtest/gtest.h>

#include "common/lcm_io/message_error.hpp"
#include "common/lcm_io/point_cloud_codec.hpp"
#include "tests/common/codec/codec_values.hpp"
#include "tests/common/infinite_numbers.hpp"

namespace limbcast::lcm_io {
namespace {

Segments test_segments() {
  const Cloud cloud = from_message(to_message(camera_cloud()));
  Segments segments;
  segments.stamp = cloud.stamp;
  Segment person;
  person.seed_m = {0.1F, 0.2F, 2.0F};
  person.seed_kind = SeedKind::kHeadShape;
  RangeImage image;
  image.camera = *cloud.camera;
  image.full_width = cloud.width;
  image.full_height = cloud.height;
  for (std::size_t i = 0; i < cloud.points_m.size(); ++i) {
    const bool inside = !cloud.is_hole(i) && i % 3 == 0;
    image.depth_m.push_back(cloud.points_m[i].z());
    image.labels.push_back(cloud.is_hole(i) ? PixelLabel::kUnknown
                                            : (inside ? PixelLabel::kPerson : PixelLabel::kOther));
    image.is_skin.push_back(i % 5 == 0 ? 1 : 0);
    if (!inside) continue;
    person.points_m.push_back(cloud.points_m[i]);
    person.is_skin.push_back(i % 5 == 0 ? 1 : 0);
  }
  person.range_image = image;
  Segment rejected;
  rejected.id = 1;
  rejected.rejected_by = SegmentFilter::kTooFewPoints;
  rejected.filter_figure = 12.0F;
  rejected.filter_limit = 300.0F;
  rejected.points_m = {{0.5F, 0.5F, 2.0F}};
  segments.segments = {person, rejected};
  return segments;
}

TEST(SegmentsCodec, GivesPointsWindowAndRejectionBack) {
  const Segments segments = test_segments();
  const Segments back = from_message(to_message(segments));
  ASSERT_EQ(back.segments.size(), 2U);
  EXPECT_EQ(back.segments[0].points_m, segments.segments[0].points_m);
  EXPECT_EQ(back.segments[0].is_skin, segments.segments[0].is_skin);
  EXPECT_EQ(back.segments[0].range_image->labels, segments.segments[0].range_image->labels);
  EXPECT_EQ(back.segments[0].range_image->depth_m, segments.segments[0].range_image->depth_m);
  EXPECT_TRUE(back.segments[0].image_poses.empty());
  EXPECT_EQ(back.segments[1].rejected_by, SegmentFilter::kTooFewPoints);
  EXPECT_EQ(back.segments[1].filter_figure, 12.0F);
  EXPECT_EQ(back.segments[1].points_m.size(), 1U);
}

TEST(SegmentsCodec, RejectsWindowsAndPointsThatDoNotFit) {
  const segments_t good = to_message(test_segments());
  segments_t bad = good;
  bad.segments[0].num_points += 1;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[0].windows[0].width = 39;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[1].seed_m[0] = kNaN;
  EXPECT_THROW(from_message(bad), MessageError);
  bad = good;
  bad.segments[0].windows[0].frame_from_image[0] = 3.0F;
  EXPECT_THROW(from_message(bad), MessageError);
}

}  // namespace
}  // namespace limbcast::lcm_io
