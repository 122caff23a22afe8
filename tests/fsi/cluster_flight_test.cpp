// Two porous plates on long struts to one payload: a cluster in free flight.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plate.h"
#include "ripstop/core/error.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/parachute/cluster.h"

namespace ripstop {
namespace {

using namespace plate_flight;

constexpr double long_struts = 12, spread = 6 * std::numbers::pi / 180;  // [m], [rad]

/// Fine cells for both plates.
FlowGrid wide_grid() {
  const FlowGrid box{{-3, -1.5, 0}, {6, 3, 3.2}, 64, 24, 28};
  return graded(box, {-2, -0.4, 0.9}, {2, 0.4, 1.6}, 1.3);
}

FlightProblem pair_of_plates(double speed, double payload_mass) {
  FlightProblem pair = problem(speed, linear);
  pair.mesh = join_risers(Cluster(plate(long_struts), {2, spread}).mesh()).mesh;
  pair.shape = pair.mesh.start;
  pair.payload_mass = payload_mass;
  pair.air.flow.grid = wide_grid();
  return pair;
}

struct Flown {
  std::vector<FreeFlightRow> rows;
  std::vector<CanopyRow> canopies;
  FreeFlight::Balance balance;
  double mass = 0;
};
Flown flown(FlightProblem given, double duration) {
  FreeFlight flight(std::move(given));
  FreeFlightState state = flight.start();
  Flown flown;
  flown.mass = flight.mass();
  while (state.coupled.cloth.time < duration) {
    flown.rows.push_back(flight.advance(state));
    if (flight.canopies() > 1)
      for (const CanopyRow& row : flight.canopy_rows(state)) flown.canopies.push_back(row);
  }
  flown.balance = flight.balance(state, flown.rows.back());
  return flown;
}

// The single plate is inclined as each of the pair, because the wake of a plate across the stream sheds later.
TEST(ClusterFlight, TwoPlatesFarApartFallAsOneWithHalfThePayload) {
  FlightProblem one = problem(6, linear);
  one.mesh = plate(long_struts), one.shape = one.mesh.start;
  one.air.flow.grid = wide_grid();
  one.settings.angle_deg = spread * 180 / std::numbers::pi;
  constexpr double duration = 0.3;
  const Flown single = flown(std::move(one), duration),
              pair = flown(pair_of_plates(6, 2 * payload), duration);
  EXPECT_NEAR(pair.mass / single.mass, 2, 1e-12);
  const double from = single.rows.back().velocity.z, to = pair.rows.back().velocity.z;
  EXPECT_GT(from + 6, 0.5) << "the speed has changed";
  EXPECT_NEAR(to / from, 1, 0.01) << from << " " << to;
  Vec3 of_one, of_pair;
  for (const FreeFlightRow& row : single.rows) of_one += row.step * row.air_force;
  for (const FreeFlightRow& row : pair.rows) of_pair += row.step * row.air_force;
  EXPECT_NEAR(of_pair.z / of_one.z, 2, 0.02);
  EXPECT_LT(std::abs(pair.balance.energy_residual), 0.01);
  EXPECT_LT(pair.balance.momentum_residual, 1e-5);
}

// The flow is symmetric within the tolerance of its pressure solver.
TEST(ClusterFlight, ASymmetricPairHasTheSameRiserLoadsAndAngles) {
  const Flown pair = flown(pair_of_plates(6, 2 * payload), 0.05);
  ASSERT_GT(pair.canopies.size(), 6u);
  for (std::size_t i = 0; i + 1 < pair.canopies.size(); i += 2) {
    const CanopyRow &a = pair.canopies[i], &b = pair.canopies[i + 1];
    EXPECT_EQ(a.time, b.time);
    EXPECT_GT(a.riser_load, 0.1);
    EXPECT_NEAR(a.riser_load / b.riser_load, 1, 1e-3);
    EXPECT_NEAR(a.spread, b.spread, 1e-6);
    EXPECT_NEAR(a.spread, 6, 0.05);
    EXPECT_NEAR(std::abs(std::remainder(a.azimuth - b.azimuth, 360)), 180, 1e-6);
    EXPECT_NEAR(a.gap, b.gap, 1e-12);
    EXPECT_NEAR(a.gap, 2 * (long_struts * std::sin(spread) - 0.5 * side * std::cos(spread)), 0.01);
    EXPECT_NEAR(a.mouth_area, side * side, 1e-3);
  }
}

TEST(ClusterFlight, TheRiserLoadsAreTheForceOnThePayload) {
  const Flown pair = flown(pair_of_plates(6, 2 * payload), 0.1);
  double loads = 0, force = 0;
  for (std::size_t i = pair.rows.size() / 2; i < pair.rows.size(); ++i)
    loads += std::cos(spread) * (pair.canopies[2 * i].riser_load + pair.canopies[2 * i + 1].riser_load),
        force += norm(pair.rows[i].line_force);
  EXPECT_NEAR(loads / force, 1, 0.01);
}

TEST(ClusterFlight, ACanopyThatCollapsesEndsTheFlightWithItsNumber) {
  FreeFlight flight(pair_of_plates(6, 2 * payload));
  FreeFlightState state = flight.start();
  std::vector<Vec3> x = positions(state.coupled.cloth, flight.cloth());
  const Patch& second = flight.mesh().patches[1];
  const Vec3 middle = x[second.node(second.rows / 2, second.columns / 2)];
  for (int n = second.first_node; n < second.first_node + second.rows * second.columns; ++n)
    x[n] = middle + 0.1 * (x[n] - middle);
  set_positions(state.coupled.cloth, flight.cloth(), x);
  FreeFlightRow row;
  row.time = 1, state.collapsed_since = 0.2;
  EXPECT_EQ(flight.failure(state, row), "canopy 2 of the cluster collapsed at 0.2 s");
}

/// The mesh about its fixed node in another size.
CanopyMesh in_size(CanopyMesh mesh, double ratio) {
  const Vec3 end = mesh.start[mesh.fixed[0]];
  for (Vec3& p : mesh.start) p = end + ratio * (p - end);
  for (double& m : mesh.mass) m *= ratio * ratio;
  for (Spring& spring : mesh.springs) spring.rest_length *= ratio;
  for (Patch& patch : mesh.patches) {
    for (double& area : patch.cell_area) area *= ratio * ratio;
    for (int d = 0; d < direction_count; ++d) {
      for (double& length : patch.rest_length[d]) length *= ratio;
      for (double& width : patch.width[d]) width *= ratio;
    }
  }
  return mesh;
}

TEST(ClusterFlight, ASmallCanopyIsNotACollapsedOne) {
  FlightProblem pair = pair_of_plates(6, 2 * payload);
  const std::vector<CanopyMesh> sizes{plate(long_struts), in_size(plate(long_struts), 0.3)};
  pair.mesh = join_risers(Cluster(sizes, {2, spread}).mesh()).mesh, pair.shape = pair.mesh.start;
  pair.air.flow.grid = {{-3, -1.5, -10}, {6, 3, 13.2}, 48, 24, 96};
  FreeFlight flight(std::move(pair));
  FreeFlightState state = flight.start();
  flight.advance(state);
  EXPECT_LT(state.collapsed_since, 0) << "its mouth has 0.08 of the area of both, which is that of its size";
  const std::vector<CanopyRow> rows = flight.canopy_rows(state);
  EXPECT_NEAR(rows[1].mouth_area / rows[0].mouth_area, 0.09, 1e-3);
}

TEST(ClusterMotion, SmallestDistanceIsThatOfAllPairs) {
  std::vector<Vec3> a, b;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.7 * i;
    a.push_back({std::cos(t), std::sin(1.3 * t), 0.1 * std::cos(3 * t)});
    b.push_back({1.2 + std::cos(1.7 * t), std::sin(t), 0.8 * std::sin(5 * t)});
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 p : a)
    for (const Vec3 q : b) least = std::min(least, norm(p - q));
  EXPECT_EQ(smallest_distance(a, b), least);
  EXPECT_EQ(smallest_distance(b, a), least);
  EXPECT_EQ(smallest_distance(a, a), 0);
  EXPECT_NEAR(smallest_distance({{0.1, 0, 0}, {0, 5, 0}}, {{1.3, 0, 0}, {1.1, 5, 0}}), 1.1, 1e-12);
}

TEST(ClusterMotion, MeansAreOverTimeAfterTheStartUp) {
  // Steps of 1 s and 3 s; the first one is the start-up.
  std::vector<CanopyRow> rows;
  const auto add = [&](double time, double spread_1, double spread_2, double load, double gap) {
    rows.push_back({time, 1, spread_1, 0, load, 1, gap});
    rows.push_back({time, 2, spread_2, 180, 2 * load, 1, gap});
  };
  add(1, 10, 10, 9, 0.5);
  add(2, 20, 24, 1, 0.01);
  add(5, 30, 26, 2, 0.2);
  const ClusterMotion motion = summarise_cluster(rows, 2, 0, 1, 0.05);
  EXPECT_NEAR(motion.canopies[0].mean_spread, (20 + 3 * 30) / 4.0, 1e-12);
  EXPECT_NEAR(motion.canopies[1].mean_spread, (24 + 3 * 26) / 4.0, 1e-12);
  EXPECT_NEAR(motion.canopies[0].spread_deviation, std::sqrt(0.25 * 0.75) * 10, 1e-9);
  EXPECT_NEAR(motion.mean_spread, (22 + 3 * 28) / 4.0, 1e-12);
  EXPECT_NEAR(motion.spread_deviation, std::sqrt(0.25 * 0.75) * 6, 1e-9);
  EXPECT_NEAR(motion.canopies[1].mean_load, 2 * (1 + 3 * 2) / 4.0, 1e-12);
  EXPECT_EQ(motion.canopies[1].largest_load, 18);
  EXPECT_EQ(motion.canopies[1].largest_load_time, 1);
  EXPECT_EQ(motion.smallest_gap, 0.01);
  EXPECT_EQ(motion.first_contact.value(), 2);
  EXPECT_NEAR(motion.contact_share, 0.2, 1e-12);
  EXPECT_THROW(summarise_cluster(rows, 2, 0, 5, 0.05), Error);
}

}  // namespace
}  // namespace ripstop
