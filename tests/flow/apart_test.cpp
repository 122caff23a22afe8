// Surfaces and lines that intersect rigid bodies.
#include "ripstop/flow/apart.h"

#include <gtest/gtest.h>

#include "../refusal.h"
#include "ripstop/flow/bodies.h"

namespace ripstop {
namespace {

TEST(Apart, ALinePiercesATriangleBetweenItsEndsOnly) {
  const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(pierces({0.2, 0.2, -1}, {0.2, 0.2, 1}, t));
  EXPECT_FALSE(pierces({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, t));
  EXPECT_FALSE(pierces({0.8, 0.8, -1}, {0.8, 0.8, 1}, t));
  EXPECT_FALSE(pierces({0, 0.2, 0}, {1, 0.2, 0}, t)) << "in its plane";
}

TEST(Apart, ABodyEnclosesThePointsWithinIt) {
  const std::vector<Triangle> body = nosed_cylinder(1, 3, 0.5, {0.3, 0, 2});
  EXPECT_TRUE(encloses(body, {0.3, 0, 1}));
  EXPECT_TRUE(encloses(body, {0.75, 0, 1.9}));
  EXPECT_FALSE(encloses(body, {0.85, 0, 1.9}));
  EXPECT_FALSE(encloses(body, {0.3, 0, 2.1}));
  EXPECT_FALSE(encloses(body, {0.75, 0, -0.9})) << "next to the nose";
}

TEST(Apart, ACanopyThatIntersectsABodyOrIsInItIsRefusedWithItsName) {
  const std::vector<FlowBody> bodies = {sheet_body({}, {0, 1}),
                                        sheet_body(block({1, 1, 1}, {0, 0, 0}), impermeable, "rocket")};
  EXPECT_NO_THROW(require_apart(disk(3, {0, 0, 0.1}), bodies));
  EXPECT_NO_THROW(require_apart(disk(0.5, {2, 0, -0.5}), bodies));
  EXPECT_NO_THROW(require_apart({}, bodies));
  const auto why = [&](const std::vector<Triangle>& canopy) {
    return refusal_of([&] { require_apart(canopy, bodies); }, ExitCode::usage);
  };
  EXPECT_NE(why(disk(3, {0, 0, -0.5})).find("touches the body \"rocket\""), std::string::npos);
  EXPECT_NE(why(square_plate(3, {0, 0, -0.5})).find("touches the body \"rocket\""), std::string::npos)
      << "no corner of its triangles is in the body";
  EXPECT_NE(why(disk(0.3, {0, 0, -0.5})).find("touches the body \"rocket\""), std::string::npos) << "inside";
}

}  // namespace
}  // namespace ripstop
