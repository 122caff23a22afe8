#include "ripstop/flow/sheet_sides.h"

#include <gtest/gtest.h>

#include "ripstop/flow/bodies.h"

namespace ripstop {
namespace {

const FlowGrid grid{{-1, -1, -1}, {2, 2, 2}, 10, 10, 10};

std::vector<Triangle> plate(double z) {
  const Vec3 a{-0.7, -0.7, z}, b{0.7, -0.7, z}, c{0.7, 0.7, z}, d{-0.7, 0.7, z};
  return {{a, b, c}, {a, c, d}};
}

std::vector<Triangle> both(std::vector<Triangle> first, const std::vector<Triangle>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST(SheetSides, OfAClosedSurfaceAndOfOneLayerAllCentresAreApart) {
  EXPECT_DOUBLE_EQ(share_on_different_sides(grid, block({1, 1, 1}, {0.03, 0.02, 0.01})), 1);
  EXPECT_DOUBLE_EQ(share_on_different_sides(grid, plate(0.03)), 1);
}

TEST(SheetSides, TwoLayersBetweenTheSameCentresPartNone) {
  EXPECT_EQ(share_on_different_sides(grid, both(plate(-0.05), plate(0.05))), 0);
  EXPECT_DOUBLE_EQ(share_on_different_sides(grid, both(plate(-0.05), plate(0.15))), 1);
  EXPECT_EQ(share_on_different_sides(grid, {}), 0);
}

}  // namespace
}  // namespace ripstop
