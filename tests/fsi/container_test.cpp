// A canopy that opens while it leaves its container.
#include "ripstop/fsi/container.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../small_case.h"
#include "ripstop/case/opening.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/coupled_opening.h"

namespace ripstop {
namespace {

InflationProblem opening_from_a_container() {
  Case given = small_opening_in_air();
  given.deployment.emplace();
  const Case opening = opening_case(given);
  InflationProblem problem = opening_problem(resolve(opening), load_source(resolve(opening)), 1);
  problem.air->engine = make_cartesian({});
  return problem;
}

TEST(Container, TheShareOutsideIsLinearBetweenItsTimes) {
  const ContainerPath path{{0, 0.1, 0.3}, {0, 0.5, 1}};
  EXPECT_EQ(path.outside(0), 0);
  EXPECT_DOUBLE_EQ(path.outside(0.05), 0.25);
  EXPECT_DOUBLE_EQ(path.outside(0.2), 0.75);
  EXPECT_EQ(path.outside(0.3), 1);
  EXPECT_EQ(path.outside(5), 1);
}

TEST(Container, ConfinesTheClothBeyondTheShareOutside) {
  const CoupledOpening opening(opening_from_a_container());
  const std::vector<Vec3>& folded = opening.folded().positions;
  const Container container({{0, 1}, {0, 1}}, opening.mesh(), folded);
  EXPECT_TRUE(container.guided(1).empty());
  double skirt = 1e9, vent = -1e9;
  for (const Patch& patch : opening.mesh().patches)
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node)
      skirt = std::min(skirt, folded[node].z), vent = std::max(vent, folded[node].z);
  std::vector<int> inside;
  const std::vector<int> held = container.guided(0.4);
  for (int node = 0; node < opening.mesh().node_count(); ++node)
    if (folded[node].z > skirt + 0.4 * (vent - skirt)) inside.push_back(node);
  EXPECT_GT(held.size(), 100u);
  EXPECT_EQ(held, inside);
}

/// How far nodes have moved across the axis from their folded place, those inside the container and the others. Tied
/// nodes follow nodes on either side of the border.
struct Sideways {
  double inside = 0, outside = 0;
};
Sideways moved_sideways(const Opening& opening, const ClothState& state, const std::vector<int>& held) {
  std::vector<char> is_inside(opening.mesh().node_count(), 0);
  for (const int node : held) is_inside[node] = 1;
  for (const Tie& tie : opening.mesh().ties) is_inside[tie.node] = 2;
  const std::vector<Vec3> x = positions(state, opening.cloth());
  Sideways moved;
  for (std::size_t node = 0; node < x.size(); ++node) {
    if (is_inside[node] == 2) continue;
    const Vec3 d = x[node] - opening.folded().positions[node];
    double& largest = is_inside[node] ? moved.inside : moved.outside;
    largest = std::max(largest, std::hypot(d.x, d.y));
  }
  return moved;
}

TEST(Container, ConfinesClothUnderPressureAndTheEnergyBalanceCloses) {
  const CoupledOpening opening(opening_from_a_container());
  const Cloth& cloth = opening.cloth();
  const Container container({{0, 1}, {0, 1}}, opening.mesh(), opening.folded().positions);
  const std::vector<int> held = container.guided(0.3);
  Loads loads{std::vector<double>(opening.mesh().cell_count(), 300.0), {}, held};
  const ClothState start = opening.start().cloth;
  const double dt = 0.5 * stability_limit(cloth, start).stable_step;
  const auto after = [&](int threads, StepRecord* record) {
    ClothState state = start;
    ThreadTeam team(threads);
    step(state, cloth, loads, dt, static_cast<int>(0.01 / dt), team, record);
    return state;
  };
  StepRecord record;
  const ClothState end = after(1, &record);
  EXPECT_EQ(end.x, after(2, nullptr).x);
  const Sideways moved = moved_sideways(opening, end, held);
  EXPECT_LT(moved.inside, 1e-12);
  EXPECT_GT(moved.outside, 0.02);
  const double balance =
      kinetic_energy(cloth, end) + elastic_energy(cloth, end) + record.damped - elastic_energy(cloth, start);
  EXPECT_NEAR(balance / record.pressure_work, 1, 0.01);
  loads.guided.clear();
  EXPECT_GT(moved_sideways(opening, after(1, nullptr), held).inside, 0.02);
}

TEST(Container, ACoupledOpeningHasThatOfItsDeploymentAndOpensFromTheSkirt) {
  InflationProblem problem = opening_from_a_container();
  ASSERT_TRUE(problem.air->container);
  const ContainerPath path = *problem.air->container;
  EXPECT_EQ(path.share.front(), 0);
  EXPECT_EQ(path.share.back(), 1);
  EXPECT_GT(path.time.back(), 0);
  problem.air->container = ContainerPath{{0, 0.04}, {0, 1}};
  problem.settings.duration_s = 0.03;
  CoupledOpening opening(problem);
  InflationState state = opening.start();
  while (state.blocks < opening.blocks()) opening.advance(state);
  const Container container(*problem.air->container, opening.mesh(), opening.folded().positions);
  const Sideways moved = moved_sideways(opening, state.cloth, container.guided(state.cloth.time));
  EXPECT_LT(moved.inside, 1e-12);
  EXPECT_GT(moved.outside, 0.02);
}

}  // namespace
}  // namespace ripstop
