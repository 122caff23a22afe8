#include "ripstop/run/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../small_case.h"
#include "finished_run.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/filling.h"
#include "ripstop/run/inflation_folder.h"

namespace ripstop {
namespace {

Case flat_circular() {
  Overrides overrides;
  overrides.set.push_back({"parachute.mesh.cloth_nodes", "1500"});
  return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/flat-circular/case.toml", overrides);
}

LoadRequest request(double mass = 2.4, double speed = 30) {
  LoadRequest r;
  r.payload_mass = mass, r.speed = speed, r.height = 500;
  return r;
}

const MethodLoad& method(const StageLoads& stage, const std::string& name) {
  for (const MethodLoad& m : stage.methods)
    if (m.method == name) return m;
  throw std::runtime_error("no method " + name);
}

std::string refused(const LoadRequest& asked) {
  try {
    run_load(flat_circular(), asked);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

// n D0 / v for the open canopy, with the root of the share of the area that a stage adds.
TEST(Load, AStageFillsAsItsOwnShareOfTheAreaDoes) {
  LoadRequest asked = request();
  asked.reefing = {{0.1, 2}, {0.4, 2}};
  const LoadResult r = run_load(flat_circular(), asked);
  ASSERT_EQ(r.stages.size(), 3u);
  const double shares[] = {0.1, 0.3, 0.6};
  for (int n = 0; n < 3; ++n)
    EXPECT_NEAR(r.stages[n].filling_time,
                r.filling_constant * r.nominal_diameter / r.stages[n].speed * std::sqrt(shares[n]), 1e-12)
        << n;
}

// Knacke, NWC TP 6575, Table 5-6 (page 5-44), unreefed, and Fig. 5-51 (page 5-59): read in github.com/nrdptel/hpr-sim,
// crates/hpr-sim/src/recovery.rs, which was written beside the print.
TEST(Load, FillingConstantsAreTheHandbooks) {
  EXPECT_EQ(known_filling("flat-circular").constant, 8);
  EXPECT_EQ(known_filling("extended-skirt").constant, 10);
  EXPECT_EQ(known_filling("cross").constant, 11.7);
  EXPECT_EQ(known_filling("ringslot").constant, 14);
  EXPECT_EQ(known_filling("ringsail").constant, 7);
  for (const char* solid : {"flat-circular", "conical", "extended-skirt"})
    EXPECT_EQ(known_filling(solid).exponent, 2) << solid;
  EXPECT_EQ(known_filling("ringslot").exponent, 1);
}

/// Of the methods that apply: what a stage says about all of them.
void expect_judged(const StageLoads& stage) {
  double highest = 0, lowest = 1e300, sum = 0;
  int count = 0;
  for (const MethodLoad& m : stage.methods)
    if (m.applies)
      highest = std::max(highest, m.load), lowest = std::min(lowest, m.load), sum += m.load, ++count;
  ASSERT_GT(count, 0);
  EXPECT_EQ(stage.highest, highest);
  EXPECT_EQ(stage.lowest, lowest);
  EXPECT_NEAR(stage.spread, (highest - lowest) / (sum / count), 1e-12);
}

TEST(Load, PutsTheMethodsSideBySideAndSaysWhichApply) {
  const LoadResult r = run_load(flat_circular(), request());
  ASSERT_EQ(r.stages.size(), 1u);
  const StageLoads& stage = r.stages[0];
  EXPECT_EQ(stage.methods.size(), 5u);
  const double area = r.drag_coefficient * r.reference_area;
  EXPECT_NEAR(method(stage, "infinite mass").load,
              0.5 * standard_air(500).density * 900 * area * r.opening_coefficient, 1e-9);
  EXPECT_NEAR(stage.filling_time, r.filling_constant * r.nominal_diameter / 30, 1e-12);
  for (const MethodLoad& m : stage.methods) {
    EXPECT_GT(m.load, 0) << m.method;
    EXPECT_LE(m.load, method(stage, "infinite mass").load * 1.001) << m.method;
    if (!m.applies) {
      EXPECT_NE(m.note, "") << m.method;
    }
  }
  expect_judged(stage);
  EXPECT_TRUE(method(stage, "trajectory").applies);
}

TEST(Load, EndsInTheSteadyDescentOfItsMass) {
  const LoadResult r = run_load(flat_circular(), request());
  EXPECT_TRUE(r.steady_reached);
  const double density = standard_air(500 - r.steady_drop).density;
  EXPECT_NEAR(r.steady_speed / terminal_speed(r.payload_mass + r.parachute_mass,
                                              r.drag_coefficient * r.reference_area, density),
              1, 2e-3);
}

/// What the way through `rows` leaves open by the trapezoidal rule: of momentum over the first, of energy over the first.
struct Balance {
  double level = 0, down = 0, energy = 0;
};
Balance balance(const std::vector<FlightRow>& rows, double mass) {
  const auto angle = [](const FlightRow& row) { return row.state.path_angle * std::numbers::pi / 180; };
  const auto of = [&](const FlightRow& row) {
    return Vec3{row.force * std::cos(angle(row)), row.force * std::sin(angle(row)),
                row.force * row.state.speed};
  };
  Vec3 sum;
  for (std::size_t i = 1; i < rows.size(); ++i)
    sum = sum + (of(rows[i - 1]) + of(rows[i])) * (0.5 * (rows[i].state.time - rows[i - 1].state.time));
  const FlightState &a = rows.front().state, &b = rows.back().state;
  const auto change = [&](double (*turn)(double)) {
    return mass * (b.speed * turn(angle(rows.back())) - a.speed * turn(angle(rows.front())));
  };
  const double momentum = mass * a.speed, energy = 0.5 * mass * a.speed * a.speed;
  return {
      (change([](double x) { return std::cos(x); }) + sum.x) / momentum,
      (change([](double x) { return std::sin(x); }) + sum.y - mass * standard_gravity * (b.time - a.time)) /
          momentum,
      (0.5 * mass * b.speed * b.speed - energy + mass * standard_gravity * (b.height - a.height) + sum.z) /
          energy};
}

// Over whole flights with every stage and every joint between them. The rule's own error goes with the square of the
// steps, 400 a filling: some 1 / 400^2.
TEST(Load, EveryFlightKeepsMomentumAndEnergy) {
  for (const double angle : {0.0, 45.0, 90.0})
    for (const double mass : {0.5, 8.0, 100.0})
      for (const bool reefed : {false, true}) {
        LoadRequest asked = request(mass, 70);
        asked.path_angle = angle, asked.height = 3000;
        if (reefed) asked.reefing = {{0.1, 2}, {0.4, 2}};
        const LoadResult r = run_load(flat_circular(), asked);
        const Balance left = balance(r.flight, r.payload_mass + r.parachute_mass);
        for (const double open : {left.level, left.down, left.energy})
          EXPECT_NEAR(open, 0, 1e-5) << angle << " " << mass << " " << reefed;
      }
}

TEST(Load, AComputedOpeningIsOneOfTheMethodsThatAreJudged) {
  const TemporaryFolder folder("load-opening");
  const Case given = small_opening();
  InflationObserver quiet;
  run_inflation_in(
      {{folder.path / "run", false}, 1, 0}, given, {"given", {}},
      [&] { return InflationProblem{parachute_mesh(given), given.inflation, 500, false, 1, 6}; }, quiet);
  LoadRequest asked = request();
  asked.opening = folder.path / "run";
  const LoadResult r = run_load(given, asked);
  ASSERT_EQ(r.stages.size(), 1u);
  EXPECT_EQ(method(r.stages[0], "computed opening").load, *r.record_peak_load);
  expect_judged(r.stages[0]);
}

TEST(Load, AHeavyPayloadIsAtInfiniteMass) {
  LoadRequest asked = request(20000, 900);
  asked.path_angle = 0;
  const StageLoads stage = run_load(flat_circular(), asked).stages[0];
  EXPECT_TRUE(method(stage, "infinite mass").applies);
  EXPECT_LT(stage.spread, 0.02);
}

TEST(Load, ReefingInStagesLowersTheHighestLoad) {
  const double open = run_load(flat_circular(), request(8, 60)).peak_load;
  LoadRequest asked = request(8, 60);
  asked.reefing = {{0.1, 2}, {0.4, 2}};
  const LoadResult r = run_load(flat_circular(), asked);
  ASSERT_EQ(r.stages.size(), 3u);
  EXPECT_LT(r.peak_load, 0.6 * open);
  EXPECT_NEAR(r.stages[1].begin, 2, 1e-9);
  EXPECT_NEAR(r.stages[2].begin, 4, 1e-9);
  EXPECT_LT(r.stages[1].speed, 60);
  EXPECT_FALSE(method(r.stages[2], "Pflanz").applies);
}

TEST(Load, WithASnatchSpeedHasTheSnatchLoad) {
  LoadRequest asked = request();
  EXPECT_FALSE(run_load(flat_circular(), asked).snatch);
  asked.snatch_speed = 5;
  const LoadResult r = run_load(flat_circular(), asked);
  ASSERT_TRUE(r.snatch);
  EXPECT_NEAR(r.snatch->line_load * 12, r.snatch->load, 1e-9 * r.snatch->load);
}

TEST(Load, WhatCannotBeIsRefused) {
  EXPECT_NE(refused(request(-2)).find("payload mass (kg) of -2"), std::string::npos);
  EXPECT_NE(refused(request(2, 0)).find("speed at line stretch (m/s) of 0"), std::string::npos);
  EXPECT_NE(refused(request(50, 10)).find("above the 10 m/s of the deployment"), std::string::npos);
  LoadRequest asked = request();
  asked.reefing = {{0.4, 2}, {0.1, 2}};
  EXPECT_NE(refused(asked).find("reefed stage"), std::string::npos);
  asked = request();
  asked.ground = 600;
  EXPECT_NE(refused(asked).find("above the ground"), std::string::npos);
  for (const double angle : {120.0, -91.0, std::nan("")}) {
    asked = request();
    asked.path_angle = angle;
    EXPECT_NE(refused(asked).find("below the horizon"), std::string::npos) << angle;
  }
  asked = request();
  asked.steady = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run"), std::string::npos);
  asked.steady.clear();
  asked.opening = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run of ripstop inflate"), std::string::npos);
}

TEST(Load, ItsFilesHaveTheWholeWay) {
  const TemporaryFolder folder("load");
  LoadResult r = run_load(flat_circular(), request());
  write_load(folder.path, r);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "trajectory_computed.csv"));
  r.record_flight.assign(r.flight.begin(), r.flight.begin() + 10);
  write_load(folder.path, r);
  EXPECT_EQ(read_csv(folder.path / "trajectory_computed.csv").rows.size(), 10u);
  const CsvTable table = read_csv(folder.path / "trajectory.csv");
  EXPECT_EQ(table.rows.size(), r.flight.size());
  const std::vector<double> force = table.column("force_n"), time = table.column("time_s");
  EXPECT_DOUBLE_EQ(*std::max_element(force.begin(), force.end()), r.peak_load);
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  for (const char* file : {"force.png", "speed.png", "result.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / file)) << file;
}

}  // namespace
}  // namespace ripstop
