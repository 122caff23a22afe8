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

/// Of 1 kg with the canopy of 1 m in it.
Container heavy_container() {
  return {.mass = 0.9, .canopy_mass = 0.1, .canopy_length = 1, .strip_force = 20};
}

/// Motion after `duration` [s] behind cloth whose speed is `cloth_speed` at a time [s].
template <class Speed>
ContainerMotion moved(ContainerMotion motion, const Container& container, double duration, Speed cloth_speed,
                      double density = 1.2) {
  constexpr int steps = 10000;
  for (int n = 0; n < steps && motion.farthest < container.canopy_length; ++n)
    move_container(motion, container, cloth_speed((n + 0.5) * duration / steps), duration / steps, density,
                   0);
  return motion;
}

TEST(ContainerMotion, WithoutStripForceItsDragLeavesTheCanopyBehindThePayload) {
  Container container = heavy_container();
  container.canopy_mass = 1e-9, container.strip_force = 0, container.drag_area = 0.1;
  const double v = 20, t = 0.15, c = 0.5 * 1.2 * container.drag_area / container.mass;
  const ContainerMotion end = moved({.speed = v}, container, t, [&](double) { return v; });
  EXPECT_NEAR(end.speed, v / (1 + c * v * t), 1e-3);
  EXPECT_NEAR(end.farthest, v * t - std::log(1 + c * v * t) / c, 1e-3);
}

TEST(ContainerMotion, AStripForceAboveItsDragKeepsItAtThePayload) {
  Container container = heavy_container();
  container.drag_area = 0.05;  // 12 N
  const ContainerMotion held = moved({.speed = 20}, container, 1, [](double) { return 20.0; });
  EXPECT_NEAR(held.speed, 20, 1e-9);
  EXPECT_NEAR(held.farthest, 0, 1e-9);
  container.strip_force = 10;
  EXPECT_GT(moved({.speed = 20}, container, 1, [](double) { return 20.0; }).farthest, 0.3);
}

TEST(ContainerMotion, ItsForceIsTheMomentumThatItGains) {
  Container container = heavy_container();
  container.canopy_mass = 0;
  ContainerMotion motion{.speed = 15};
  double impulse = 0;
  for (int n = 0; n < 100; ++n) impulse += 1e-3 * move_container(motion, container, 20, 1e-3, 1.2, 0);
  EXPECT_NEAR(impulse, container.mass * (motion.speed - 15), 1e-12);
  EXPECT_NEAR(impulse, 20 * 0.1, 1e-12);  // the strip force all the time
}

TEST(ContainerMotion, NoClothReturnsIntoItAndItIsFreeUntilTheClothIsTautAgain) {
  const Container container = heavy_container();
  // The payload brakes from 20 to 10 m/s, below the container, and later moves at 30 m/s.
  const ContainerMotion first = moved({.speed = 18}, container, 0.05, [](double) { return 20.0; });
  const ContainerMotion slack = moved(first, container, 0.1, [](double) { return 10.0; });
  EXPECT_GT(first.farthest, 0);
  EXPECT_EQ(slack.farthest, first.farthest);
  EXPECT_LT(slack.apart, first.apart);
  EXPECT_EQ(slack.speed, first.speed);  // no drag area, and no force
  const ContainerMotion behind = moved(slack, container, 0.01, [](double) { return 30.0; });
  EXPECT_LT(behind.apart, first.farthest);
  EXPECT_EQ(behind.speed, slack.speed);
  const ContainerMotion taut = moved(slack, container, 0.2, [](double) { return 30.0; });
  EXPECT_GT(taut.farthest, first.farthest);
  EXPECT_GT(taut.speed, slack.speed);
}

TEST(ContainerMotion, WithoutMassItIsStoppedByItsDrag) {
  Container container = heavy_container();
  container.mass = 0, container.drag_area = 1;
  const ContainerMotion end = moved({.speed = 20}, container, 1, [](double) { return 20.0; });
  EXPECT_GE(end.farthest, container.canopy_length);
  EXPECT_TRUE(std::isfinite(end.speed));
}

TEST(Container, ConfinesTheClothBeyondTheShareOutside) {
  const CoupledOpening opening(opening_from_a_container());
  const std::vector<Vec3>& folded = opening.folded().positions;
  const ContainedCloth contained(opening.mesh(), folded);
  EXPECT_TRUE(contained.beyond(1).empty());
  double skirt = 1e9, vent = -1e9;
  for (const Patch& patch : opening.mesh().patches)
    for (int node = patch.first_node; node < patch.first_node + patch.rows * patch.columns; ++node)
      skirt = std::min(skirt, folded[node].z), vent = std::max(vent, folded[node].z);
  std::vector<int> inside;
  const std::vector<int> held = contained.beyond(0.4);
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
  const std::vector<int> held = ContainedCloth(opening.mesh(), opening.folded().positions).beyond(0.3);
  Loads loads{std::vector<double>(opening.mesh().cell_count(), 300.0), {}, guided_along({0, 0, 1}, held)};
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
  Container& container = *problem.air->container;
  EXPECT_GT(container.mass, 0);
  EXPECT_GT(container.relative_speed, 0);
  container.relative_speed = 0.7 * container.canopy_length / 0.03, container.drag_area = 0,
  container.strip_force = 0;
  problem.settings.duration_s = 0.03;
  CoupledOpening opening(problem);
  InflationState state = opening.start();
  while (state.blocks < opening.blocks()) opening.advance(state);
  const ContainerMotion& motion = *state.air.container;
  EXPECT_FALSE(motion.left);
  const double outside = motion.farthest / container.canopy_length;
  EXPECT_GT(outside, 0.4);
  EXPECT_LT(outside, 0.9);
  const Sideways moved = moved_sideways(
      opening, state.cloth, ContainedCloth(opening.mesh(), opening.folded().positions).beyond(outside));
  EXPECT_LT(moved.inside, 1e-12);
  EXPECT_GT(moved.outside, 0.02);
}

TEST(Container, TheCanopyThatBrakesThePayloadDelaysItsOwnExit) {
  const auto outside_after = [](double payload_mass) {
    InflationProblem problem = opening_from_a_container();
    Container& container = *problem.air->container;
    container.relative_speed = 0.5 * container.canopy_length / 0.03, container.drag_area = 0;
    problem.air->payload = Payload{payload_mass};
    problem.settings.duration_s = 0.03;
    CoupledOpening opening(problem);
    InflationState state = opening.start();
    while (state.blocks < opening.blocks()) opening.advance(state);
    return state.air.container->farthest;
  };
  EXPECT_LT(outside_after(0.3), 0.95 * outside_after(1000));
}

/// Pressures on the cells after some steps of an opening [Pa].
std::vector<double> pressures_of(const InflationProblem& problem) {
  CoupledOpening opening(problem);
  InflationState state = opening.start();
  opening.advance(state);
  return state.air.pressure;
}

// Free cloth moves with air as heavy as this. Inside it is as rigid as very heavy cloth.
TEST(Container, ClothInsideIsRigidForTheAir) {
  InflationProblem problem = opening_from_a_container();
  problem.air->flow.air.density *= 30;
  problem.air->container->strip_force = 1e9, problem.air->container->relative_speed = 0;
  const std::vector<double> inside = pressures_of(problem);
  problem.air->container.reset();
  const std::vector<double> free = pressures_of(problem);
  for (double& mass : problem.mesh.mass) mass *= 1e6;
  const std::vector<double> rigid = pressures_of(problem);
  const auto difference = [&](const std::vector<double>& p) {
    double squares = 0, sum = 0;
    for (std::size_t n = 0; n < rigid.size(); ++n)
      squares += std::pow(p[n] - rigid[n], 2), sum += std::pow(rigid[n], 2);
    return std::sqrt(squares / sum);
  };
  EXPECT_LT(difference(inside), 0.01);
  EXPECT_GT(difference(free), 0.5);
}

}  // namespace
}  // namespace ripstop
