// A rigid porous plate that carries a payload, in free flight.
#include "ripstop/fsi/free_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plate.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/transfer.h"

namespace ripstop {
namespace {

using namespace plate_flight;

/// Of the plate held in the stream, in the mean over the last half of `duration`.
double drag_when_held(double speed, double duration) {
  CartesianSettings settings;
  settings.threads = 1, settings.compressible = false;
  const auto engine = make_cartesian(settings);
  FlowProblem flow = air(speed, linear);
  const CanopyMesh mesh = plate();
  flow.bodies[0].surface = surface_of(cells_of(mesh), mesh.start);
  const auto held = engine->start(flow);
  double time = 0, sum = 0, weight = 0;
  while (time < duration) {
    const double length = held->longest_step(0.5);
    const FlowStep taken = held->step(length);
    time += length;
    if (time > 0.5 * duration) sum += length * taken.force.z, weight += length;
  }
  return sum / weight;
}

// At its terminal speed the drag of the plate, held in a stream of that speed, is the weight.
TEST(FreeFlight, PorousPlateFallsAtTheTerminalSpeedOfItsDrag) {
  FreeFlight flight(problem(6, linear));
  FreeFlightState state = flight.start();
  double sum = 0, weight = 0;
  while (state.coupled.cloth.time < 1.6) {
    const FreeFlightRow row = flight.advance(state);
    if (row.time > 1.2) sum += row.step * -row.velocity.z, weight += row.step;
  }
  const double speed = sum / weight;
  EXPECT_GT(std::abs(speed - 6), 0.3) << "it has changed its speed";
  const double drag = drag_when_held(speed, 0.8);
  // The drag is between linear and quadratic in the speed: 1 % of the speed is at least 1 % of the drag.
  EXPECT_NEAR(drag / (flight.mass() * gravity), 1, 0.01);
}

TEST(FreeFlight, WithoutDragItFallsFreely) {
  FreeFlight flight(problem(6, 1e-9));
  FreeFlightState state = flight.start();
  FreeFlightRow row;
  while (state.coupled.cloth.time < 0.1) row = flight.advance(state);
  EXPECT_NEAR(-row.velocity.z, 6 + gravity * row.time, 1e-6);
  EXPECT_NEAR(row.payload.z, -6 * row.time - 0.5 * gravity * row.time * row.time, 1e-3);
  EXPECT_NEAR(norm(row.line_force), 0, 1e-3);
  EXPECT_LT(flight.balance(state, row).momentum_residual, 1e-6);
}

// In the first step the drag of the payload is that of its velocity relative to the wind.
TEST(FreeFlight, PayloadIsDraggedAlongByTheWind) {
  FlightProblem given = problem(6, 1e-9);
  given.payload_drag_area = 0.5;
  given.settings.velocity_m_s = Vec3{0, 0, -6};
  given.settings.wind.speed_m_s = 4;
  FreeFlight flight(std::move(given));
  FreeFlightState state = flight.start();
  const FreeFlightRow row = flight.advance(state);
  const double on_speed = 0.5 * 1.2 * 0.5 * std::hypot(4, 6), weight = flight.mass() * gravity;
  EXPECT_NEAR(row.payload_drag, on_speed * std::hypot(4, 6), 1e-6);
  EXPECT_NEAR(norm(state.impulse / row.time - Vec3{4 * on_speed, 0, 6 * on_speed - weight}), 0, 1e-6);
  EXPECT_LT(flight.balance(state, row).momentum_residual, 1e-6);
}

// Springs that are stretched at the start come to rest, with nothing but their own dampers.
TEST(FreeFlight, VibrationsOfTheMeshAreDamped) {
  FlightProblem given = problem(6, 1e-9);
  for (Vec3& p : given.shape) p = 1.001 * p;
  FreeFlight flight(std::move(given));
  FreeFlightState state = flight.start();
  while (state.coupled.cloth.time < 0.02) flight.advance(state);
  EXPECT_GT(state.elastic_at_start, 0.01);
  EXPECT_LT(elastic_energy(flight.cloth(), state.coupled.cloth), 0.01 * state.elastic_at_start);
}

// A canopy that is deployed along the horizon may first be next to its payload, and later not.
TEST(FreeFlight, TurnedOverIsWiderOnlyUntilADeployedCanopyIsUpright) {
  FlightProblem given = problem(6, linear);
  OpeningEnd end;
  end.speed = 6, end.shape = given.shape;
  end.velocity.assign(end.shape.size(), {});
  given.from = end;
  FreeFlight flight(std::move(given));
  FreeFlightState state;
  FreeFlightRow row;
  row.angle = 110;
  EXPECT_EQ(flight.failure(state, row), "");
  row.angle = 130;
  EXPECT_NE(flight.failure(state, row), "");
  state.upright = true;
  row.angle = 110;
  EXPECT_NE(flight.failure(state, row), "");
  FreeFlight released(problem(6, linear));
  FreeFlightState start = released.start();
  EXPECT_FALSE(start.upright);
  EXPECT_LT(released.advance(start).angle, 60);
  EXPECT_TRUE(start.upright);
}

TEST(FreeFlight, RefusesAPayloadWithoutMassAndSeveralPayloads) {
  FlightProblem weightless = problem(6, linear);
  weightless.payload_mass = 0;
  EXPECT_THROW(FreeFlight{std::move(weightless)}, Error);
  FlightProblem two = problem(6, linear);
  two.mesh.fixed = {0, 1};
  EXPECT_THROW(FreeFlight{std::move(two)}, Error);
}

}  // namespace
}  // namespace ripstop
