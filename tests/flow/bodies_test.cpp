#include "ripstop/flow/bodies.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "../refusal.h"
#include "ripstop/flow/extent.h"

namespace ripstop {
namespace {

constexpr double pi = std::numbers::pi;

double volume(const std::vector<Triangle>& surface) {
  double sum = 0;
  for (const Triangle& t : surface) sum += dot(t.a, cross(t.b, t.c)) / 6;
  return sum;
}

TEST(ClosedBodies, HaveTheVolumeAndFrontalAreaOfTheirShape) {
  const Vec3 at = {0.3, -0.2, 1};
  const struct {
    std::vector<Triangle> surface;
    double volume, front, length;
  } bodies[] = {{sphere(2, at), 4 * pi / 3, pi, 2},
                {nosed_cylinder(2, 5, 0, at), 5 * pi, pi, 5},
                {nosed_cylinder(2, 5, 3, at), 2 * pi + 2 * pi, pi, 5},
                {nosed_cylinder(2, 3, 3, at), 2 * pi, pi, 3},
                // Half a sphere of radius 1, then a cone of length 2 from radius 1 to 0.5.
                {capsule(2, 3, 1, 1, at), 2 * pi / 3 + pi * 2 / 3 * (1 + 0.5 + 0.25), pi, 3},
                {block({1, 2, 3}, at), 6, 2, 3}};
  for (const auto& body : bodies) {
    EXPECT_NO_THROW(check_closed(body.surface, "body"));
    EXPECT_NEAR(volume(body.surface), body.volume, 1e-3 * body.volume);
    EXPECT_NEAR(frontal_area(body.surface), body.front, 1e-3 * body.front);
    const Extent extent = extent_of(body.surface);
    EXPECT_NEAR(extent.high[2], at.z, 1e-12);
    EXPECT_NEAR(extent.low[2], at.z - body.length, 1e-12);
  }
}

TEST(ClosedBodies, WithAHoleOrTurnedInsideOutAreRefused) {
  const auto refusal = [](const std::vector<Triangle>& surface, const std::string& name) {
    return refusal_of([&] { check_closed(surface, name); }, ExitCode::bad_data);
  };
  std::vector<Triangle> open = block({1, 1, 1}, {});
  open.pop_back();
  EXPECT_NE(refusal(open, "rocket").find("body \"rocket\": its surface is not closed: 3 of 18 edges"),
            std::string::npos);
  std::vector<Triangle> inward = sphere(1, {});
  for (Triangle& t : inward) std::swap(t.b, t.c);
  EXPECT_NE(refusal(inward, "ball").find("body \"ball\": the normals of its surface point inward"),
            std::string::npos);
  EXPECT_NE(refusal({}, "none").find("\"none\""), std::string::npos);
}

}  // namespace
}  // namespace ripstop
