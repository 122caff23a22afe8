// [cluster]: the domain makes room for the canopies, and a case that cannot have them is refused.
#include "ripstop/case/cluster.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/flight_cells.h"
#include "ripstop/case/flying.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop {
namespace {

Case cluster_case(int canopies, double spread_angle_deg) {
  Case given = flat_circular_case(1, 500, 20);
  given.parachute.riser.length_m = 1;
  given.parachute.mesh.line_segment_m = 0.25;
  given.cluster = ClusterKeys{canopies, spread_angle_deg, false, {}};
  return given;
}

Settings without_cluster(Case given) {
  given.cluster.reset();
  return resolve(checked(given));
}

TEST(ClusterCase, TheDomainIsAsWideACanopyWithCellsNoLarger) {
  for (const int canopies : {2, 3, 4}) {
    const Settings many = resolve(checked(cluster_case(canopies, 20)));
    const Settings one = without_cluster(cluster_case(canopies, 20));
    const Vec3 box = many.flow().box_m, of_one = one.flow().box_m;
    EXPECT_GE(box.x * box.y, canopies * of_one.x * of_one.y * (1 - 1e-9));
    const Vec3 cell = flow_grid(many.flow()).spacing(), cell_of_one = flow_grid(one.flow()).spacing();
    for (const double ratio : {cell.x / cell_of_one.x, cell.y / cell_of_one.y, cell.z / cell_of_one.z}) {
      EXPECT_LE(ratio, 1.02);
      EXPECT_GE(ratio, 0.9);
    }
    EXPECT_NEAR(cost_of(many).nodes, canopies * cost_of(one).nodes, 1e-9);
  }
}

TEST(ClusterCase, AnInflatedCanopyIsWithinTheFineCells) {
  const Settings resolved = resolve(checked(cluster_case(3, 30)));
  const SteadyProblem problem = steady_problem(resolved);
  const Vec3 core = resolved.flow().core.size_m;
  const double start = resolved.flow().core.start_m;
  for (const Cell& cell : cells_of(problem.mesh))
    for (const int node : cell.corner) {
      if (node < 0) continue;
      // The start shape is flat and wider than the inflated one.
      const Vec3 p = problem.mesh.start[node];
      EXPECT_LT(std::abs(p.x), 0.5 * core.x + 0.1);
      EXPECT_LT(std::abs(p.y), 0.5 * core.y + 0.1);
      EXPECT_GT(p.z, start - 0.1);
      EXPECT_LT(p.z, start + core.z);
    }
  EXPECT_NEAR(problem.reference_area, 3 * nominal_area(resolved.parachute()), 1e-12);
}

TEST(ClusterCase, TheDomainOfASearchIsThatOfItsLargestAngle) {
  Case given = cluster_case(2, 16);
  given.cluster->equilibrium = true;
  const SpreadRange range = spread_range(given);
  EXPECT_NEAR(range.largest, 16 + spread_search, 1e-9);
  EXPECT_GT(range.least, 16 - spread_search);
  const Settings searched = resolve(checked(given)),
                 widest = resolve(checked(cluster_case(2, 16 + spread_search)));
  EXPECT_EQ(searched.flow().box_m, widest.flow().box_m);
  EXPECT_EQ(searched.flow().core.size_m, widest.flow().core.size_m);
  EXPECT_EQ(searched.flow().cells, widest.flow().cells);
  // Another angle keeps the domain, and turns the canopies about the confluence.
  const Settings turned = at_spread_angle(searched, 25);
  EXPECT_EQ(turned.flow(), searched.flow());
  EXPECT_NEAR(cluster_of(turned)->layout().spread, 25 * std::acos(-1.0) / 180, 1e-12);
  // Not below the angle at which the canopies touch, nor above the largest one of the key.
  const std::string touching = refusal_of([&] { checked(cluster_case(2, 5)); }, ExitCode::usage);
  EXPECT_NE(touching.find(fmt::format("at least {:.1f}", std::ceil(10 * range.least) / 10)),
            std::string::npos)
      << touching;
  given.cluster->spread_angle_deg = 55;
  EXPECT_NEAR(spread_range(given).largest, 60, 1e-9);
}

TEST(ClusterCase, ImpossibleOnesAreRefusedWithTheirKey) {
  const auto key_of = [](auto edit) {
    Case given = cluster_case(3, 20);
    edit(given);
    const std::vector<Problem> problems = validate(given);
    return problems.size() == 1 ? problems.front().key : std::to_string(problems.size()) + " problems";
  };
  EXPECT_EQ(key_of([](Case& c) { c.cluster->canopies = 5; }), "cluster.canopies");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->canopies = 1; }), "cluster.canopies");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->spread_angle_deg = 5; }), "cluster.spread_angle_deg");
  EXPECT_EQ(key_of([](Case& c) { c.flow.box_m = Vec3{2, 6, 6}; }), "flow.box_m[0]");
  EXPECT_EQ(key_of([](Case& c) { c.payload.mass_kg = 5, c.cluster->equilibrium = true; }),
            "cluster.equilibrium");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->widest_spread_angle_deg = 19; }),
            "cluster.widest_spread_angle_deg");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->size_ratios = {1, 0.8}; }), "cluster.size_ratios");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->size_ratios = {0.9, 0.8, 0.7}; }), "cluster.size_ratios");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->size_ratios = {1, 0.8, 1.2}; }), "cluster.size_ratios[2]");
  EXPECT_EQ(key_of([](Case& c) {
              c.cluster->size_ratios = {1, 0.8, 0.8}, c.cluster->equilibrium = true,
              c.cluster->spread_angle_deg = 25;
            }),
            "cluster.equilibrium");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->delays_s = {0, 0.1}; }), "cluster.delays_s");
  EXPECT_EQ(key_of([](Case& c) { c.cluster->delays_s = {0, 0.1, -0.1}; }), "cluster.delays_s[2]");
  EXPECT_EQ(key_of([](Case& c) { c.bodies["box"].shape = BoxKeys{{0.1, 0.1, 0.1}}; }), "body.box");
}

TEST(ClusterCase, CanopiesThatTouchAreRefusedWithTheAngleAndTheRiserThatSeparateThem) {
  Case given = cluster_case(3, 8);
  const std::vector<Problem> problems = validate(given);
  ASSERT_EQ(problems.size(), 1u);
  const std::string allowed = problems.front().allowed;
  ASSERT_TRUE(allowed.starts_with("at least ")) << allowed;
  given.cluster->spread_angle_deg = std::stod(allowed.substr(9));
  EXPECT_TRUE(validate(given).empty());
  EXPECT_NE(problems.front().message.find("lengthen the riser ("), std::string::npos)
      << problems.front().message;
}

TEST(ClusterCase, CanopiesOfOtherSizesHaveTheirOwnAreaMassAndCells) {
  Case given = cluster_case(2, 20);
  given.payload.mass_kg = 5;
  const Settings equal = resolve(checked(given));
  given.cluster->size_ratios = {1, 0.6};
  const Settings sizes = resolve(checked(given));
  EXPECT_EQ(sizes.flow().box_m, equal.flow().box_m) << "the domain is that of the larger canopy";
  const double area = nominal_area(sizes.parachute());
  EXPECT_NEAR(steady_problem(sizes).reference_area, 1.36 * area, 1e-12);
  EXPECT_EQ(steady_problem(sizes).full_box_because, "the canopies of the cluster have different sizes");
  EXPECT_NEAR(cells_across(sizes), 0.6 * cells_across(equal), 1e-12);
  const Settings small = canopy_settings(sizes, 1);
  EXPECT_NEAR(nominal_area(small.parachute()), 0.36 * area, 1e-12);
  EXPECT_NEAR(mass_of_canopies(sizes), parachute_mass(canopy_settings(sizes, 0)) + parachute_mass(small),
              1e-12);
  EXPECT_NEAR(mass_of_canopies(equal), 2 * parachute_mass(equal), 1e-12);
  // The mass of the flying mesh is that of both parachutes, with hems and allowances.
  const CanopyMesh mesh = cluster_as_cut(sizes).mesh();
  double mass = 0;
  for (const double node : mesh.mass) mass += node;
  EXPECT_NEAR(mass, mass_of_canopies(sizes), 1e-9);
  EXPECT_NEAR(load_after_failure(given), 1.36 / 0.36, 1e-12);
  EXPECT_NEAR(load_after_failure(equal.written()), 2, 1e-12);
  given.flow.symmetry = FlowSymmetry::quarter;
  EXPECT_NE(refusal_of([&] { steady_problem(resolve(checked(given))); }, ExitCode::usage)
                .find("because the canopies of the cluster have different sizes"),
            std::string::npos);
}

TEST(ClusterCase, DelaysThatARunDoesNotUseAreReported) {
  Case given = cluster_case(2, 20);
  EXPECT_TRUE(unused_delays(given, "a steady run").empty());
  given.cluster->delays_s = {0, 0.1};
  const std::vector<std::string> texts = unused_delays(given, "a steady run");
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts.front().find("cluster.delays_s: not used; a steady run"), 0u) << texts.front();
}

TEST(ClusterCase, OtherCommandsComputeOneCanopy) {
  const Settings resolved = resolve(checked(cluster_case(3, 20)));
  EXPECT_EQ(
      refusal_of([&] { require_one_canopy(resolved, "an opening load"); }, ExitCode::usage),
      "cluster.canopies = 3: an opening load computes one canopy; only a steady run, a sweep, a flight and a "
      "coupled inflation compute a cluster (remove the table, or --unset cluster)");
}

TEST(ClusterCase, TheFineCellsOfAFlightContainTheCanopiesUpToTheWidestAngle) {
  Case given = cluster_case(2, 20);
  given.payload.mass_kg = 5;
  EXPECT_NEAR(widest_in_flight(*given.cluster), 45, 1e-12);
  given.cluster->widest_spread_angle_deg = 50;
  const Settings flight = resolve(flight_case(checked(given)));
  const FlowGrid grid = flow_grid(flight.flow());
  EXPECT_NEAR(grid.spacing().x, 1.0 / given.flight.cells_across, 0.1 / given.flight.cells_across);
  EXPECT_EQ(grid.nx, grid.ny) << "a cluster turns freely about its axis";
  EXPECT_EQ(grid.nx % 4, 0);
  const Settings at_widest = at_spread_angle(flight, 50);
  const CanopyMesh mesh = flying_mesh(at_widest);
  const double radius = 0.5 * inflated_diameter(flight.parachute());
  for (int k = 0; k < 2; ++k) {
    Vec3 skirt;
    const std::vector<int> nodes = of_canopy(mesh.rigging.skirt_nodes, k, 2);
    for (const int node : nodes) skirt += mesh.start[node] / double(nodes.size());
    for (const double at : {skirt.x - radius, skirt.x + radius}) {
      EXPECT_GT(at, grid.grading[0].core_low);
      EXPECT_LT(at, grid.grading[0].core_high);
    }
    EXPECT_GT(skirt.z - radius, grid.grading[2].core_low);
    EXPECT_LT(skirt.z + radius, grid.grading[2].core_high);
  }
}

TEST(ClusterCase, AFlightOfAClusterIsRefusedFromAnInflationAndWithoutMemory) {
  Case given = cluster_case(2, 20);
  given.payload.mass_kg = 5;
  given.flight.start = FlightSettings::Start::inflation;
  EXPECT_NE(refusal_of([&] { flight_case(checked(given)); }, ExitCode::usage).find("leave out --deploy"),
            std::string::npos);
  EXPECT_NE(refusal_of([] { require_memory(1e18, "a flight", 4); }, ExitCode::resources)
                .find("or canopies (cluster.canopies = 4)"),
            std::string::npos);
}

TEST(ClusterCase, ThePayloadIsCarriedByAllCanopies) {
  Case given = cluster_case(3, 20);
  given.payload.mass_kg = 9;
  given.flow.speed_m_s.reset();
  const Settings many = resolve(checked(given));
  given.payload.mass_kg = 3, given.cluster.reset();
  const Settings one = resolve(checked(given));
  EXPECT_NEAR(many.flow().speed_m_s, one.flow().speed_m_s, 1e-12);
  EXPECT_NEAR(suspended_weight(many, 9), 3 * suspended_weight(one, 3), 1e-9);
}

}  // namespace
}  // namespace ripstop
