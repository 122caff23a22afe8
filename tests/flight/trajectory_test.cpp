#include "ripstop/flight/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/flight/opening_load.h"

namespace ripstop {
namespace {

constexpr double degree = std::numbers::pi / 180;

Leg leg(DragArea area, double duration, double step) {
  Leg leg;
  leg.drag_area = std::move(area);
  leg.duration = duration;
  leg.step = step;
  return leg;
}

// m dv/dt = m g - k v^2: v = v_e tanh(g t / v_e) from rest; the density changes by 0.2 % over this fall.
TEST(Trajectory, AFallFromNearRestIsTheClosedForm) {
  FlightState state{0, 0, 0, 20, 1e-9, 90};
  const std::vector<FlightRow> rows = fly(state, 5, leg([](double, double) { return 1.0; }, 1.5, 0.01));
  const double v = terminal_speed(5, 1, standard_air(10).density);
  EXPECT_NEAR(rows.back().state.speed / (v * std::tanh(9.80665 * 1.5 / v)), 1, 1e-3);
  EXPECT_NEAR(rows.back().state.path_angle, 90, 1e-9);
}

TEST(Trajectory, WithoutDragItIsAParabola) {
  FlightState state{0, 0, 0, 1000, 30, -40};
  fly(state, 1, leg([](double, double) { return 0.0; }, 4, 0.5));
  EXPECT_NEAR(state.range, 30 * std::cos(40 * degree) * 4, 1e-9);
  EXPECT_NEAR(state.height, 1000 + 30 * std::sin(40 * degree) * 4 - 0.5 * standard_gravity * 16, 1e-9);
}

/// A deployment from a level way at 60 m/s, 500 m high.
std::vector<FlightRow> deployment(double step, double mass = 12) {
  FlightState state{0, 0, 0, 500, 60, 10};
  return fly(state, mass, leg(filling(0, 8, 0.7, 2, 1.5), 12, step));
}

// By the trapezoidal rule over the rows, which have no part in how they were computed.
TEST(Trajectory, KeepsMomentumAndEnergy) {
  const double mass = 12;
  const std::vector<FlightRow> rows = deployment(1e-3);
  double level = 0, down = 0, work = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const FlightRow &a = rows[i - 1], &b = rows[i];
    const double dt = b.state.time - a.state.time;
    level +=
        dt / 2 *
        (a.force * std::cos(a.state.path_angle * degree) + b.force * std::cos(b.state.path_angle * degree));
    down +=
        dt / 2 *
        (a.force * std::sin(a.state.path_angle * degree) + b.force * std::sin(b.state.path_angle * degree));
    work += dt / 2 * (a.force * a.state.speed + b.force * b.state.speed);
  }
  const FlightState &a = rows.front().state, &b = rows.back().state;
  const double whole = mass * a.speed;
  EXPECT_NEAR(
      mass * (b.speed * std::cos(b.path_angle * degree) - a.speed * std::cos(a.path_angle * degree)) + level,
      0, 1e-6 * whole);
  EXPECT_NEAR(mass * (b.speed * std::sin(b.path_angle * degree) - a.speed * std::sin(a.path_angle * degree)) +
                  down - mass * standard_gravity * (b.time - a.time),
              0, 1e-6 * whole);
  EXPECT_NEAR(0.5 * mass * (b.speed * b.speed - a.speed * a.speed) +
                  mass * standard_gravity * (b.height - a.height) + work,
              0, 1e-6 * 0.5 * mass * a.speed * a.speed);
}

TEST(Trajectory, IsOfFourthOrderOnASmoothLaw) {
  const auto end = [](double step) {
    FlightState state{0, 0, 0, 500, 60, 10};
    fly(state, 12, leg([](double t, double) { return 8 * t * t / 4; }, 2, step));
    return state.speed;
  };
  const double exact = end(0.0005), coarse = std::abs(end(0.1) - exact), fine = std::abs(end(0.05) - exact);
  EXPECT_GT(coarse / fine, 12);
  EXPECT_LT(coarse / fine, 22);
}

// Without gravity's part, fast and heavy, a level way has the peak of the closed form.
TEST(Trajectory, ItsPeakIsThatOfTheClosedFormWhereGravityIsSmall) {
  const double mass = 3, speed = 300, area = 4, time = 0.05, density = standard_air(1000).density;
  FlightState state{0, 0, 0, 1000, speed, 0};
  double peak = 0;
  for (const FlightRow& row : fly(state, mass, leg(filling(0, area, time, 2, 1.8), 0.2, 1e-5)))
    peak = std::max(peak, row.force);
  const OpeningConditions c{mass, speed, density, area, time, 2, 1.8, 0};
  EXPECT_NEAR(peak / ludtke_load(c).load, 1, 2e-3);
}

TEST(Trajectory, EndsInTheSteadyDescent) {
  FlightState state{0, 0, 0, 800, 50, 20};
  Leg down = leg(filling(0, 6, 1, 2, 1), 200, 0.01);
  down.until_steady = true;
  fly(state, 10, down);
  EXPECT_NEAR(state.speed / terminal_speed(10, 6, standard_air(state.height).density), 1, 1e-3);
  EXPECT_NEAR(state.path_angle, 90, 0.1);
  EXPECT_GT(state.height, 700);
}

TEST(Trajectory, EndsOnTheGround) {
  FlightState state{0, 0, 0, 30, 20, 90};
  const std::vector<FlightRow> rows = fly(state, 10, leg([](double, double) { return 6.0; }, 100, 0.01));
  EXPECT_EQ(state.height, 0);
  EXPECT_LT(state.time, 10);
  EXPECT_GT(rows.size(), 100u);
}

// From 20 m/s down, h = 20 t + g t^2 / 2, where the ground ends a step in its middle.
TEST(Trajectory, LandsWhenItReachesTheGround) {
  FlightState state{0, 0, 0, 50, 20, 90};
  fly(state, 1, leg([](double, double) { return 0.0; }, 10, 0.3));
  const double exact = (std::sqrt(400 + 2 * standard_gravity * 50) - 20) / standard_gravity;
  EXPECT_NEAR(state.time, exact, 0.003);
  EXPECT_NEAR(state.speed, 20 + standard_gravity * exact, 0.03);
}

TEST(Trajectory, AFillingGrowsToItsPeakAndComesBack) {
  const DragArea area = filling(1, 5, 2, 2, 1.6);
  EXPECT_DOUBLE_EQ(area(0, 0), 1);
  EXPECT_DOUBLE_EQ(area(2, 0), 5);
  const double top = 2 * std::sqrt(1.6);
  EXPECT_NEAR(area(top, 0), 8, 1e-12);
  EXPECT_NEAR(area(top + 1, 0), 6.5, 1e-12);
  EXPECT_NEAR(area(top + 2, 0), 5, 1e-12);
  EXPECT_NEAR(area(100, 0), 5, 1e-12);
  const DragArea level = filling(3, 3, 1, 2, 1);  // a reefed canopy with a constant drag area
  for (const double t : {0.0, 0.3, 1.0, 2.0}) EXPECT_DOUBLE_EQ(level(t, 0), 3);
}

TEST(Trajectory, ARecordIsReadOverDistanceAndContinuesWithTheSteadyArea) {
  const DragArea area = from_record({1, 2, 4}, {2, 6, 4}, 5);
  EXPECT_DOUBLE_EQ(area(0, 0.5), 1);
  EXPECT_DOUBLE_EQ(area(0, 1.5), 4);
  EXPECT_DOUBLE_EQ(area(9, 3), 5);
  EXPECT_DOUBLE_EQ(area(0, 4.5), 5);
  EXPECT_THROW(from_record({1, 2}, {1}, 1), Error);
}

TEST(Trajectory, QuantitiesThatAreNotAboveZeroAreRefused) {
  const DragArea one = [](double, double) { return 1.0; };
  FlightState state{0, 0, 0, 100, 10, 90};
  EXPECT_THROW(fly(state, -1, leg(one, 1, 0.1)), Error);
  EXPECT_THROW(fly(state, 1, leg(one, 1, 0)), Error);
  state.height = 99000;
  EXPECT_THROW(fly(state, 1, leg(one, 1, 0.1)), Error);
}

TEST(Trajectory, InAirOfAnotherDensityHasItsDrag) {
  Leg thin = leg([](double, double) { return 1.0; }, 20, 0.01);
  thin.ground = -2000, thin.density_ratio = 0.8;
  FlightState state{0, 0, 0, 1000, 30, 90};
  const std::vector<FlightRow> rows = fly(state, 10, thin);
  EXPECT_NEAR(rows.front().force, 0.5 * 0.8 * standard_air(1000).density * 900, 1e-9);
  const double density = 0.8 * standard_air(state.height).density;
  EXPECT_NEAR(rows.back().density, density, 1e-12);
  EXPECT_NEAR(state.speed / std::sqrt(2 * 10 * standard_gravity / density), 1, 1e-2);
}

}  // namespace
}  // namespace ripstop
