// A flight that continues from the end of a coupled inflation: nothing jumps, and both are one run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "ripstop/case/deployment.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/flight/flight_folder.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/report/report.h"
#include "ripstop/run/used_run.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// On cells as coarse as can show a canopy.
Case small_deployment() {
  Case given = small_payload_case(8);
  given.inflation.initial_radius_m = 0.12;
  given.inflation.duration_s = 0.02, given.inflation.frames = 4;
  given.inflation.cloth_damping_s =
      0;  // damped cloth has a larger load at the end, and all differences with it
  given.flight.start = FlightSettings::Start::inflation;
  given.flight.cells_across = 12;
  given.flight.duration_s = 0.03;
  given.flight.shapes_per_s = 250;
  return given;
}

class ContinuedFlight : public testing::Test {
 protected:
  TemporaryFolder root{"ripstop-continued-flight"};
  FlightObserver nobody;

  void inflate(const std::string& name, const Settings& resolved) {
    InflationObserver quiet;
    const LoadSource source = load_source(resolved);
    run_inflation_in(
        {{root.path / name, false, true, false}, 1}, resolved, source,
        [&] { return opening_problem(resolved, source, 1); }, quiet);
  }
  FlightSolution flown(const Case& given, const std::string& from) {
    return run_flight(flight_settings(checked(given), root.path / from), 1, nobody, root.path / from);
  }
};

// The inflation that continues, and the flight from its middle, have the same air and the same cloth.
TEST_F(ContinuedFlight, MovesAsTheInflationWouldHaveMoved) {
  Case given = small_deployment();
  inflate("first", flight_settings(checked(given)));
  const FlightSolution flight = flown(given, "first");
  ASSERT_TRUE(flight.result.handover);
  EXPECT_TRUE(flight.result.handover->same_flow);
  given.inflation.duration_s = 0.03, given.inflation.frames = 6;
  inflate("all", flight_settings(checked(given)));

  const CsvTable first = read_csv(root.path / "first/air.csv"), all = read_csv(root.path / "all/air.csv");
  const std::vector<double> times = all.column("time_s"), speeds = all.column("speed_m_s"),
                            drags = all.column("drag_n"), fallen = all.column("height_lost_m");
  ASSERT_EQ(first.column("drag_n").back(), drags.at(first.rows.size() - 1)) << "the same inflation";
  const auto at = [&](const std::vector<double>& values, double time) {
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (time - times.at(i - 1)) / (times.at(i) - times.at(i - 1));
    return values[i - 1] + share * (values[i] - values[i - 1]);
  };
  const double largest = *std::max_element(drags.begin(), drags.end());
  int compared = 0;
  double more = 0;  // impulse that the flight has more [N s]
  for (const FreeFlightRow& row : flight.history.rows) {
    if (row.time >= times.back()) break;
    ++compared;
    EXPECT_NEAR(-row.velocity.z, at(speeds, row.time), 0.005 * 8) << row.time;
    EXPECT_NEAR(row.payload.z, -at(fallen, row.time), 1e-3) << row.time;
    const double difference = row.air_force.z - at(drags, row.time);
    if (compared == 1) {
      EXPECT_LT(std::abs(difference), 0.05 * largest);
    }
    more += row.step * difference;
  }
  EXPECT_GE(compared, 3);
  // On cells so coarse the force of a single step jumps where cloth passes a cell.
  EXPECT_LT(std::abs(more), 0.02 * largest * (times.back() - flight.history.rows.front().time));
}

TEST_F(ContinuedFlight, HandsOverVelocityLoadAndEnergy) {
  Case given = small_deployment();
  given.inflation.flight_angle_deg = 30;
  inflate("first", flight_settings(checked(given)));
  const FlightSolution flight = flown(given, "first");
  const Handover& h = *flight.result.handover;
  EXPECT_NEAR(h.time, 0.02, 1e-12);
  EXPECT_NEAR(h.elastic_after, h.elastic_before, 1e-9 * h.elastic_before);
  const FreeFlightRow& row = flight.history.rows.front();
  const double below = h.path_angle * std::numbers::pi / 180;
  const Vec3 before = h.opening_speed * Vec3{std::cos(below), 0, -std::sin(below)};
  EXPECT_NEAR(h.path_angle, 30, 2);
  const double gained = row.step * (9.81 + h.load_before / 0.8);  // at most, in the first step
  EXPECT_LT(norm(row.velocity - before), 1.2 * gained);
  const double way =
      h.height_lost / std::tan(below) + row.step * before.x;  // over the ground, on a straight path
  EXPECT_NEAR(row.payload.x, way, 0.05 * way);
  EXPECT_NEAR(row.angle, 60, 3) << "the canopy trails behind the payload";
  EXPECT_LT(flight.result.momentum_residual, 0.01);
  EXPECT_LT(flight.result.mass_defect, 0.01);
  // The warnings of the inflation are those of the flight too.
  const std::vector<std::string>& all = flight.result.warnings;
  for (const std::string& text : end_of_run(root.path / "first").texts)
    EXPECT_TRUE(std::find(all.begin(), all.end(), text) != all.end() ||
                std::find(all.begin(), all.end(), (root.path / "first").string() + ": " + text) != all.end())
        << text;
}

// Other boundaries, or other cells: the flow is interpolated, and the result states so.
TEST_F(ContinuedFlight, FromAnInflationInAnotherFlowIsInterpolated) {
  Case given = small_deployment();
  Case alone = given;
  alone.inflation.air = AirModel::coupled, alone.inflation.mass = InflationSettings::Mass::payload;
  alone.flow.cells = {36, 36, 44};
  inflate("alone", resolve(opening_case(checked(alone))));
  given.flight.duration_s = 0.004;
  // The loads of the first step differ, since boundaries or cells do; velocity and cloth continue.
  const auto continues = [](const FlightSolution& flight) {
    const Handover& h = *flight.result.handover;
    EXPECT_FALSE(h.same_flow);
    EXPECT_NEAR(h.elastic_after, h.elastic_before, 1e-9 * h.elastic_before);
    EXPECT_NEAR(norm(flight.history.rows.front().velocity), h.opening_speed, 0.02 * h.opening_speed);
    EXPECT_NE(h.drag_after, h.drag_before);
  };
  continues(flown(given, "alone"));
  given.origins["flight.cells_across"] = {};
  given.flight.cells_across = 16;
  continues(flown(given, "alone"));
}

struct KilledInTheInflation : FlightObserver {
  struct : InflationObserver {
    void advanced(const Opening&, const InflationState& state, const InflationHistory&,
                  const InflationFrame*) override {
      if (state.blocks == 5) throw std::runtime_error("killed");
    }
  } inflation;
  InflationObserver& opening() override { return inflation; }
};
struct KilledInTheFlight : FlightObserver {
  void advanced(FreeFlight&, const FreeFlightState& state, const FlightHistory&, bool) override {
    if (state.coupled.air.steps == 5) throw std::runtime_error("killed");
  }
};

TEST_F(ContinuedFlight, IsOneRunThatResumesInBothPartsByteForByte) {
  const Settings resolved = flight_settings(checked(small_deployment()));
  const auto fly = [&](const char* name, FlightObserver& observer) {
    return run_flight_in({{root.path / name}, 1, 0}, resolved, observer);
  };
  ASSERT_TRUE(fly("whole", nobody));
  KilledInTheInflation early;
  EXPECT_THROW(fly("parts", early), std::runtime_error);
  KilledInTheFlight late;
  EXPECT_THROW(fly("parts", late), std::runtime_error);
  ASSERT_TRUE(fly("parts", nobody));
  for (const char* file : {"path.csv", "opening/history.csv", "vtk/canopy_0002.vtp"})
    EXPECT_EQ(read_file(root.path / "whole" / file), read_file(root.path / "parts" / file)) << file;

  const ReportRun shown = report_of(root.path / "whole");
  EXPECT_EQ(shown.kind, "flight");
  const auto& frames = shown.shape.frames;
  ASSERT_EQ(frames.size(), 5u + 7u) << "four of the inflation and its start, seven of the flight";
  EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end(),
                             [](const ShapeFrame& a, const ShapeFrame& b) { return a.time <= b.time; }));
  EXPECT_EQ(frames.front().time, 0);
  EXPECT_NEAR(frames.back().time, 0.02 + 7.0 / 250, 1e-9);
  EXPECT_EQ(shown.shape.path.size(), 3 * shown.shape.path_times.size());
  EXPECT_EQ(shown.plots.front().series.size(), 2u) << "load of the inflation and of the flight";
}

// Extraction, reefed stage, open canopy and flight are one case.
TEST_F(ContinuedFlight, FliesFromTheBagThroughAReefedStage) {
  Case given = small_deployment();
  given.deployment = DeploymentKeys{};
  given.inflation.reefing = {{1.2, 0.01, {}}};
  const Settings resolved = flight_settings(checked(given));
  const LoadSource source = load_source(resolved);
  InflationObserver quiet;
  const InflationSolution inflation =
      run_inflation(resolved, source, opening_problem(resolved, source, 1), quiet);
  const Deployment deployment = deployment_of(resolved).value();
  const std::vector<AirRow>& air = inflation.history.air;
  EXPECT_NEAR(air.front().speed, deployment.phase(canopy_leaves)->payload_speed, 9.81 * air.front().length);
  ASSERT_EQ(inflation.result.stages->size(), 2u);
  EXPECT_NEAR(inflation.result.stages->front().end, 0.01, 0.0021)
      << "a line is cut at the next check of the step";
  EXPECT_EQ(inflation.result.stages->front().line, 1.2);
  EXPECT_LT(air.back().speed, air.front().speed) << "drag exceeds the weight";

  const FlightSolution flight = run_flight(resolved, 1, nobody);
  EXPECT_EQ(flight.result.ended_by, "duration");
  EXPECT_NEAR(norm(flight.history.rows.front().velocity), air.back().speed, 0.05 * air.back().speed);
}

TEST_F(ContinuedFlight, RefusesRunsFromWhichNothingFliesOn) {
  Case given = small_deployment();
  const auto refused = [&](const std::function<void()>& call, const char* names) {
    try {
      call();
      ADD_FAILURE() << names;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(names), std::string::npos) << error.what();
    }
  };
  given.inflation.duration_s = 0.004, given.inflation.frames = 1;
  inflate("short", flight_settings(checked(given)));
  Case other = given;
  other.payload.mass_kg = 3;
  refused([&] { flown(other, "short"); }, "payload.mass_kg = 3");
  other = given;
  other.parachute.gores = 10, other.parachute.lines.count = 10;
  refused([&] { flown(other, "short"); }, "different parachute");
  fs::remove_all(root.path / "short/end");
  refused([&] { flown(given, "short"); }, "no state of the air");

  Case held = given;
  held.inflation.air = AirModel::coupled;
  held.inflation.duration_s = 0.002;
  held.flow.cells = {28, 28, 36};
  inflate("held", resolve(opening_case(checked(held))));
  refused([&] { flown(given, "held"); }, "without a payload");
  Case reefed = given;
  reefed.inflation.reefing = {{1.2, 0.004, {}}};
  refused([&] { flight_settings(checked(reefed)); }, "inflation.reefing[0].cut_s = 0.004");
  given.flow.speed_m_s.reset();
  refused([&] { flight_settings(checked(given)); }, "payload.deployment_speed_m_s");
}

}  // namespace
}  // namespace ripstop
