// A short flight of two small canopies, in a folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "ripstop/case/flying.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/flight/flight_folder.h"
#include "tests/refusal.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

/// On cells as coarse as can show a canopy, in a small box, for some steps of the flow.
Case two_canopies() {
  Case given = small_payload_case(5);
  given.payload.mass_kg = 1.6;
  given.parachute.riser.length_m = 0.5;
  given.cluster = ClusterKeys{2, 24, false, {}, 0.7, 26};
  given.flow.max_iterations = 30;
  given.coupling.max_iterations = 2;
  given.flight.cells_across = 8;
  given.flight.angle_deg = 0;
  given.flight.duration_s = 0.06;
  given.flight.shapes_per_s = 20;
  return given;
}

TEST(ClusterFlightRun, HasTheCanopiesInItsResultAndFiles) {
  const TemporaryFolder folder("cluster-flight");
  FlightObserver nobody;
  const auto result =
      run_flight_in({{folder.path / "run"}, 1, 30}, flight_settings(checked(two_canopies())), nobody);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->ended_by, "duration");
  EXPECT_LT(result->momentum_residual, 0.01);
  EXPECT_LT(std::abs(result->energy_residual), 0.01);
  ASSERT_TRUE(result->cluster && result->cluster->motion);
  const FlightCluster& cluster = *result->cluster;
  EXPECT_EQ(cluster.canopies, 2);
  EXPECT_NEAR(cluster.factor.value(), *result->coefficient / 0.7, 1e-12);
  ASSERT_EQ(cluster.motion->canopies.size(), 2u);
  // The risers carry the payload: 1.6 kg, accelerated by little.
  const double loads = cluster.motion->canopies[0].mean_load + cluster.motion->canopies[1].mean_load;
  EXPECT_NEAR(loads * std::cos(cluster.motion->mean_spread * std::acos(-1.0) / 180) / (1.6 * 9.80665), 1,
              0.3);
  EXPECT_NEAR(cluster.motion->canopies[0].mean_spread, cluster.motion->canopies[1].mean_spread, 2);
  const CsvTable rows = read_csv(folder.path / "run" / "canopies.csv"),
                 path = read_csv(folder.path / "run" / "path.csv");
  EXPECT_EQ(rows.rows.size(), 2 * path.rows.size());
  const auto json = nlohmann::json::parse(read_file(folder.path / "run" / "result.json"));
  EXPECT_TRUE(json.at("cluster").at("motion").contains("smallest_gap_m"));
  // Both risers are in the margins: their hardware carries both.
  const auto& members = result->margins->members;
  const auto riser =
      std::find_if(members.begin(), members.end(), [](const Margin& m) { return m.member == "riser"; });
  ASSERT_NE(riser, members.end());
  EXPECT_NEAR(riser->load / std::max(cluster.motion->canopies[0].largest_load,
                                     cluster.motion->canopies[1].largest_load),
              1, 0.2);
}

/// Ends in the middle, after a checkpoint.
struct KilledClusterFlight : FlightObserver {
  void advanced(FreeFlight&, const FreeFlightState& state, const FlightHistory&, bool) override {
    if (state.coupled.air.steps == 6) throw std::runtime_error("killed");
  }
};
struct ResumedClusterFlight : FlightObserver {
  std::size_t rows = 0;
  void begin(FreeFlight&, FreeFlightState&, FlightHistory& history) override {
    rows = history.canopies.size();
  }
};

TEST(ClusterFlightRun, KilledAndResumedHasTheSameCanopiesByteForByte) {
  const TemporaryFolder folder("cluster-flight-killed");
  Case given = two_canopies();
  given.coupling.max_iterations = 1, given.flight.duration_s = 0.03;
  const Settings resolved = flight_settings(checked(given));
  FlightObserver nobody;
  ASSERT_TRUE(run_flight_in({{folder.path / "whole"}, 1, 0}, resolved, nobody));
  KilledClusterFlight killed;
  EXPECT_THROW(run_flight_in({{folder.path / "parts"}, 1, 0}, resolved, killed), std::runtime_error);
  ResumedClusterFlight resumed;
  ASSERT_TRUE(run_flight_in({{folder.path / "parts"}, 1, 0}, resolved, resumed));
  EXPECT_GE(resumed.rows, 8u);
  for (const char* file : {"path.csv", "canopies.csv", "result.json"})
    EXPECT_EQ(read_file(folder.path / "whole" / file), read_file(folder.path / "parts" / file)) << file;
}

}  // namespace
}  // namespace ripstop
