#include "modules/reconstructor/gaps.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace limbcast::reconstructor {
namespace {

/// Filled along the row and, turned, along the column.
void expect_filled(const cv::Mat1f& row_px, const cv::Mat1f& expected_px) {
  cv::Mat1f row = row_px.clone(), column = row_px.t();
  fill_gaps({2, 1.5F}, row);
  fill_gaps({2, 1.5F}, column);
  EXPECT_EQ(cv::countNonZero(row != expected_px), 0) << row;
  EXPECT_EQ(cv::countNonZero(column != expected_px.t()), 0) << column;
}

TEST(FillGaps, JoinsBothSidesByALine) {
  expect_filled((cv::Mat1f(1, 7) << 0, 10, 0, 0, 10.75F, 0, 11),
                (cv::Mat1f(1, 7) << 0, 10, 10.25F, 10.5F, 10.75F, 10.875F, 11));
}

TEST(FillGaps, LeavesLongOnesThoseAtBordersAndThoseBetweenSurfaces) {
  for (const cv::Mat1f& row_px : {cv::Mat1f((cv::Mat1f(1, 5) << 10, 0, 0, 0, 10)),
                                  cv::Mat1f((cv::Mat1f(1, 5) << 0, 10, 10, 0, 0)),
                                  cv::Mat1f((cv::Mat1f(1, 5) << 10, 0, 11.5F, 0, 10)),
                                  cv::Mat1f((cv::Mat1f(1, 5) << 0, 0, 0, 0, 0))})
    expect_filled(row_px, row_px);
}

}  // namespace
}  // namespace limbcast::reconstructor
