// Rigid bodies that move with the payload of a flight.
#include "ripstop/fsi/carried_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "plate.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/extent.h"

namespace ripstop {
namespace {

using namespace plate_flight;

constexpr double degree = std::numbers::pi / 180;

/// Below the payload of the plate, with its aft end there.
std::vector<FlowBody> with_box(Vec3 size, double aft) {
  std::vector<FlowBody> bodies = {sheet_body({}, {linear, 0}),
                                  sheet_body(block(size, {0, 0, aft}), impermeable, "rocket")};
  bodies[1].moment_about = {0, 0, aft};
  return bodies;
}

CarriedBodies::Pose inclined(double deg, double azimuth, Vec3 payload) {
  const double a = deg * degree, b = azimuth * degree;
  return {payload, {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)}};
}

TEST(CarriedBodies, TurnWithTheLineToTheSkirtAboutThePayload) {
  const CarriedBodies bodies(with_box({0.2, 0.2, 0.4}, -0.1), {{0, 0, 0}, {0, 0, 1}});
  const CarriedBodies::Pose to = inclined(90, 0, {1, 2, 3});
  const auto placed = bodies.placed(to, to, 1);
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].body, 1u);
  // The line points to +x: the body lies on the other side, from 0.1 to 0.5 m beyond the payload.
  const Extent e = extent_of(placed[0].surface);
  EXPECT_NEAR(e.low[0], 1 - 0.5, 1e-12);
  EXPECT_NEAR(e.high[0], 1 - 0.1, 1e-12);
  EXPECT_NEAR(e.low[1], 1.9, 1e-12);
  EXPECT_NEAR(e.high[2], 3.1, 1e-12);
}

// In a step of 1 ms, to the second order of the step.
TEST(CarriedBodies, HaveTheVelocityOfTheirPoints) {
  const CarriedBodies bodies(with_box({0.2, 0.3, 0.4}, -0.1), {{0, 0, 0}, inclined(3, 10, {}).line});
  constexpr double length = 1e-3;
  const CarriedBodies::Pose now = inclined(20, 30, {1, 2, 3}),
                            next = inclined(20.2, 31, {1.002, 2.001, 2.99});
  const auto from = bodies.placed(now, next, length)[0], to = bodies.placed(next, next, length)[0];
  for (std::size_t t = 0; t < from.surface.size(); ++t) {
    const Vec3 moved = (to.surface[t].a - from.surface[t].a) / length,
               middle = 0.5 * (to.surface[t].a + from.surface[t].a);
    EXPECT_NEAR(norm(from.motion.rigid->at(middle - 0.5 * length * from.motion.rigid->velocity) - moved), 0,
                1e-3 * norm(from.motion.rigid->spin));
  }
  EXPECT_NEAR(norm(from.motion.rigid->velocity - Vec3{2, 1, -10}), 0, 1e-9);
}

FlightProblem with_rocket(double diameter, double aft) {
  FlightProblem flight = problem(6, linear);
  flight.air.flow.bodies.push_back(sheet_body(sphere(diameter, {0, 0, aft}), impermeable, "rocket"));
  flight.air.flow.bodies[1].moment_about = {0, 0, aft};
  return flight;
}

TEST(CarriedBodies, HaveLoadsInFlightThatDoNotActOnThePayload) {
  FlightProblem given = with_rocket(0.3, 0.5);
  given.settings.angle_deg = 15;
  FreeFlight flight(std::move(given));
  FreeFlightState state = flight.start();
  FreeFlightRow row;
  double sum = 0;
  int steps = 0;
  while (state.coupled.cloth.time < 0.3) {
    row = flight.advance(state);
    EXPECT_LT(row.momentum_gap, 1e-6 * flight.mass() * gravity);
    if (state.coupled.cloth.time > 0.15) sum += row.bodies.at(0).drag_area, ++steps;
  }
  // As without the sphere, whose drag would add 0.4.
  EXPECT_LT(flight.balance(state, row).momentum_residual, 2e-3);
  // On coarse cells, near the plate.
  const double area = std::numbers::pi / 4 * 0.3 * 0.3;
  EXPECT_GT(sum / steps / area, 0.3);
  EXPECT_LT(sum / steps / area, 1.5);
  const FlightBodyRow& body = row.bodies.at(0);
  // The aft end is 0.1 m below the payload, on the line from the skirt.
  const Vec3 line = row.canopy - row.payload;
  EXPECT_NEAR(norm(body.aft - (row.payload - 0.1 / norm(line) * line)), 0, 0.05);
  EXPECT_NEAR(norm(body.force) * norm(body.force), body.drag * body.drag + body.side * body.side, 1e-9);
  EXPECT_EQ(body.resolved, 0) << "the fine cells are about the plate";
  EXPECT_EQ(row.payload_drag, 0);
}

TEST(CarriedBodies, ThatLeaveTheDomainEndTheFlight) {
  FlightProblem given = with_rocket(0.3, 0.45);
  FlowGrid& grid = given.air.flow.grid;
  grid = graded({{-0.9, -0.9, 0}, {1.8, 1.8, 3.2}, 20, 20, 28}, {-0.4, -0.4, 0.9}, {0.4, 0.4, 1.6}, 1.3);
  given.settings.angle_deg = 65;
  FreeFlight flight(std::move(given));
  FreeFlightState state = flight.start();
  try {
    flight.advance(state);
    FAIL() << "it is 0.9 m below the plate, 0.82 m aside";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::not_converged);
    const std::string said = error.what();
    EXPECT_NE(said.find("the body \"rocket\" has left the flow domain"), std::string::npos) << said;
    EXPECT_NE(said.find("the domain from -0.9 to 0.9 m"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace ripstop
