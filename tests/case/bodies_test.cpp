// [body.<name>]: the domain makes room for the bodies, and a case that cannot have them is refused.
#include "ripstop/case/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/flying.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/flow/extent.h"

namespace ripstop {
namespace {

Case behind_a_cylinder(double trailing_distance_m) {
  Case given = flat_circular_case(0.6, 1000, 20);
  BodyKeys& rocket = given.bodies["rocket"];
  rocket.shape = CylinderKeys{0.2, 1, 0};
  rocket.trailing_distance_m = trailing_distance_m;
  return given;
}

TEST(Bodies, LieUpstreamOfTheSkirtByTheTrailingDistance) {
  const Settings resolved = resolve(checked(behind_a_cylinder(1.5)));
  const FlowProblem problem = flow_problem(resolved);
  ASSERT_EQ(problem.bodies.size(), 2u);
  EXPECT_EQ(problem.bodies[1].name, "rocket");
  const Extent extent = extent_of(problem.bodies[1].surface);
  EXPECT_NEAR(extent.high[2], resolved.flow().canopy_position_m - 1.5, 1e-12);
  EXPECT_NEAR(extent.low[2], resolved.flow().canopy_position_m - 2.5, 1e-12);
}

TEST(Bodies, TheDefaultDomainAndItsCoreBeginUpstreamOfThemWithCellsNoLarger) {
  Case given = behind_a_cylinder(1.5);
  const Settings with = resolve(checked(given));
  given.bodies.clear();
  const Settings without = resolve(checked(given));
  const double front = with.flow().canopy_position_m - 2.5;
  EXPECT_NEAR(front, 4 * 0.2, 1e-9);
  EXPECT_NEAR(with.flow().core.start_m, front - 0.5 * 0.2, 1e-9);
  const auto downstream = [](const Settings& one) {
    return one.flow().box_m.z - one.flow().canopy_position_m;
  };
  EXPECT_NEAR(downstream(with), downstream(without), 1e-9);
  const auto cell = [](const Settings& one) {
    const FlowGrid grid = flow_grid(one.flow());
    return grid.width(2, grid.cell_at(2, one.flow().canopy_position_m));
  };
  EXPECT_LE(cell(with) / cell(without), 1);
  EXPECT_GE(cell(with) / cell(without), 0.85);
}

TEST(Bodies, ACoreOfAnyGivenSizeBeginsHalfAWidthUpstreamOfThem) {
  Case given = behind_a_cylinder(1.5);
  for (const double more : {0.0, 0.3}) {
    given.flow.core.size_m = resolve(checked(behind_a_cylinder(1.5))).flow().core.size_m + Vec3{0, 0, more};
    const Settings resolved = resolve(checked(given));
    EXPECT_NEAR(resolved.flow().core.start_m, resolved.flow().canopy_position_m - 2.5 - 0.1, 1e-9) << more;
  }
}

TEST(Bodies, WithoutADistanceHangAtTheEndOfTheRiser) {
  Case given = behind_a_cylinder(1);
  given.bodies["rocket"].trailing_distance_m.reset();
  given.parachute.riser.length_m = 2;
  given.parachute.riser.material = given.parachute.lines.material;
  const double distance = *resolve(checked(given)).written().bodies.at("rocket").trailing_distance_m;
  const double radius = 0.5 * inflated_diameter(given.parachute);
  EXPECT_NEAR(distance, std::sqrt(0.6 * 0.6 - radius * radius) + 2, 1e-9);
}

TEST(Bodies, ImpossibleOnesAreRefusedWithTheirKey) {
  const auto key_of = [](auto edit) {
    Case given = behind_a_cylinder(1);
    edit(given);
    const std::vector<Problem> problems = validate(given);
    return problems.size() == 1 ? problems.front().key : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(key_of([](Case& c) {
              c.bodies["rocket"].shape = CylinderKeys{0.2, 1, 1.1};
            }),
            "body.rocket.nose_length_m");
  EXPECT_EQ(key_of([](Case& c) {
              c.bodies["rocket"].shape = CapsuleKeys{2, 1, 0.9, 0.5};
            }),
            "body.rocket.nose_radius_m");
  EXPECT_EQ(key_of([](Case& c) {
              c.bodies["rocket"].shape = CapsuleKeys{2, 0.5, 1, 0.5};
            }),
            "body.rocket.length_m");
  EXPECT_EQ(key_of([](Case& c) {
              c.bodies["rocket"].shape = CapsuleKeys{2, 2, 1, 2.5};
            }),
            "body.rocket.base_diameter_m");
  EXPECT_EQ(key_of([](Case& c) { c.bodies["rocket"].trailing_distance_m = 0; }),
            "body.rocket.trailing_distance_m");
  EXPECT_EQ(key_of([](Case& c) {
              c.bodies["canopy"] = c.bodies["rocket"];
              c.bodies.erase("rocket");
            }),
            "body.canopy");
}

TEST(Bodies, AreInTheFineCellsOfAFlightAndInItsDomainAt45Degrees) {
  Case given = behind_a_cylinder(4);
  given.payload.mass_kg = 3;
  const Settings flight = resolve(flight_case(checked(given)));
  const FlowSettings& flow = flight.flow();
  const BodiesAhead ahead = bodies_ahead(given);
  EXPECT_GT(ahead.front, 4);
  EXPECT_LE(flow.core.start_m, flow.canopy_position_m - ahead.front);
  EXPECT_GE(flow.box_m.x, 2 * ahead.front * std::sin(std::acos(-1.0) / 4));
  const double cell = nominal_diameter(given.parachute) / given.flight.cells_across;
  EXPECT_NEAR(flow_grid(flow).spacing().z, cell, 0.15 * cell);
  EXPECT_NEAR(flow_grid(flow).spacing().x, cell, 0.15 * cell);
}

TEST(Bodies, AreInTheFlowOfACoupledInflation) {
  Case given = behind_a_cylinder(1.5);
  given.inflation.air = AirModel::coupled;
  given.inflation.initial_radius_m = 0.05;
  const Settings opening = resolve(opening_case(checked(given)));
  const InflationProblem problem = opening_problem(opening, load_source(opening), 1);
  ASSERT_EQ(problem.air->flow.bodies.size(), 2u);
  EXPECT_EQ(problem.air->flow.bodies[1].name, "rocket");
}

}  // namespace
}  // namespace ripstop
