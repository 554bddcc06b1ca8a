#include "modules/segmenter/segmenter.hpp"

#include <gtest/gtest.h>

namespace limbcast::segmenter {
namespace {

TEST(Segmenter, FindsNobodyInAnEmptyCloud) { EXPECT_TRUE(segment(Cloud{}).segments.empty()); }

}  // namespace
}  // namespace limbcast::segmenter
