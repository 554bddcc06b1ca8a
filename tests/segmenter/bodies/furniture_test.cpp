#include "modules/segmenter/bodies/furniture.hpp"

#include <gtest/gtest.h>

#include "tests/segmenter/scene/drawn_scene.hpp"

namespace limbcast::segmenter {
namespace {

/// A trunk under a head at 0.8 m, and an arm stretched sideways at 0.5 m.
bool is_body(float right_m, float up_m) {
  const bool head = std::abs(right_m) < 0.1F && up_m > 0.6F && up_m < 0.92F;
  const bool trunk = std::abs(right_m) < 0.2F && up_m <= 0.6F && up_m > -0.6F;
  const bool arm = right_m >= 0.2F && right_m < 0.8F && std::abs(up_m - 0.5F) < 0.05F;
  return head || trunk || arm;
}

std::vector<std::int16_t> labels_without_furniture(const Lattice& lattice) {
  JointGrowth growth(lattice, {head_at(lattice, 0.0F, 0.8F)}, {}, {});
  leave_furniture(lattice, {}, growth);
  return growth.labels();
}

TEST(Furniture, IsNoneOnABodyAlone) {
  const Lattice lattice =
      look_at([](float right_m, float up_m) { return is_body(right_m, up_m) ? kBody_m : 0.0F; });
  const std::vector<HeadCandidate> heads = {head_at(lattice, 0.0F, 0.8F)};
  const auto labels = grow_together(lattice, heads, {}, {});
  EXPECT_TRUE(find_furniture(lattice, heads[0], labels, points_by_label(labels, 1)[0], {}).empty());
}

TEST(Furniture, IsTheSofaBesideABody) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    const bool sofa = up_m < 0.2F && up_m > -0.5F;
    return sofa || is_body(right_m, up_m) ? kBody_m : 0.0F;
  });
  const auto labels = labels_without_furniture(lattice);
  EXPECT_EQ(labels[index_at(lattice, 0.6F, -0.1F)], kNobody);
  EXPECT_EQ(labels[index_at(lattice, 0.0F, -0.5F)], 0);
  EXPECT_EQ(labels[index_at(lattice, 0.7F, 0.5F)], 0) << "the arm is thin";
}

TEST(Furniture, IsTheWallAboveAHeadThatLeansOnIt) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    return up_m > -0.6F ? kBody_m + (is_body(right_m, up_m) ? 0.0F : 0.03F) : 0.0F;
  });
  EXPECT_EQ(labels_without_furniture(lattice)[index_at(lattice, 0.0F, 1.2F)], kNobody);
}

TEST(Furniture, LeavesAnArmBeforeASofa) {
  const Lattice lattice = look_at([](float right_m, float up_m) {
    if (is_body(right_m, up_m)) return kBody_m;
    return up_m < 0.7F && up_m > -0.5F ? kBody_m + 0.05F : 0.0F;
  });
  const auto labels = labels_without_furniture(lattice);
  EXPECT_EQ(labels[index_at(lattice, 0.6F, 0.0F)], kNobody);
  EXPECT_EQ(labels[index_at(lattice, 0.7F, 0.5F)], 0);
}

}  // namespace
}  // namespace limbcast::segmenter
