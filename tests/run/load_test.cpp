#include "ripstop/run/load.h"

#include <gtest/gtest.h>

#include <cmath>

#include "finished_run.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"
#include "ripstop/output/csv.h"

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
  EXPECT_NE(refused(request(2, 0)).find("speed"), std::string::npos);
  EXPECT_NE(refused(request(50, 10)).find("above the 10 m/s of the deployment"), std::string::npos);
  LoadRequest asked = request();
  asked.reefing = {{0.4, 2}, {0.1, 2}};
  EXPECT_NE(refused(asked).find("reefed stage"), std::string::npos);
  asked = request();
  asked.ground = 600;
  EXPECT_NE(refused(asked).find("above the ground"), std::string::npos);
  asked = request();
  asked.steady = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run"), std::string::npos);
  asked.steady.clear();
  asked.opening = "/nowhere";
  EXPECT_NE(refused(asked).find("no finished run of ripstop inflate"), std::string::npos);
}

TEST(Load, ItsFilesHaveTheWholeWay) {
  const TemporaryFolder folder("load");
  const LoadResult r = run_load(flat_circular(), request());
  write_load(folder.path, r);
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
