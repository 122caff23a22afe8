// Conserved quantities of the forces, and their potential.
#include <gtest/gtest.h>

#include <cmath>

#include "builders.h"
#include "ripstop/cloth/stability_limit.h"

namespace ripstop {
namespace {

using namespace testing;

// Force on the free nodes, read off the change of velocity in one small step.
std::vector<Vec3> forces(const Mesh& mesh, const Cloth& cloth, const std::vector<Vec3>& x,
                         const Loads& loads = {}) {
  ClothState state = start_state(cloth);
  set_positions(state, cloth, x);
  ThreadTeam team(1);
  const double dt = 1e-9;
  step(state, cloth, loads, dt, 1, team);
  const std::vector<Vec3> v = velocities(state, cloth);
  const std::vector<double> mass = reference_masses(mesh);
  std::vector<Vec3> f(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) f[i] = (mass[i] / dt) * v[i];
  return f;
}

TEST(ClothLaws, ATiedNodeTransfersTheForcesOfTheSpringsOnBothSides) {
  const Mesh mesh = medley(0, true);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, shaken(mesh.start, 2e-3, 7));
  const std::vector<Vec3> x = positions(state, *cloth);
  Mesh loose = mesh;
  loose.ties.clear(), loose.fixed.clear();
  const std::vector<Vec3> pulls =
      reference_forces(loose, {}, {}, x, std::vector<Vec3>(static_cast<std::size_t>(mesh.node_count())));
  const std::vector<Vec3> handed_on = tie_forces(*cloth, state);
  ASSERT_EQ(handed_on.size(), mesh.ties.size());
  for (std::size_t k = 0; k < mesh.ties.size(); ++k) {
    const Vec3 wanted = pulls[mesh.ties[k].node];
    EXPECT_NEAR(norm(handed_on[k] - wanted), 0, 1e-9 * (1 + norm(wanted))) << k;
  }
}

TEST(ClothLaws, InternalForcesAndMomentsSumToZero) {
  const Mesh mesh = medley(0.02, false);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, shaken(mesh.start, 0.0015, 4));
  set_velocities(state, *cloth, shaken(std::vector<Vec3>(mesh.node_count()), 2, 5));
  const std::vector<Vec3> x = positions(state, *cloth), before = velocities(state, *cloth);
  ThreadTeam team(1);
  step(state, *cloth, {}, 1e-7, 1, team);
  const std::vector<Vec3> after = velocities(state, *cloth);
  const std::vector<double> mass = reference_masses(mesh);
  Vec3 force, moment;
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec3 push = mass[i] * (after[i] - before[i]);
    force += push;
    moment += cross(x[i], push);
    sum += norm(push);
  }
  EXPECT_LT(norm(force), 1e-12 * sum);
  EXPECT_LT(norm(moment), 1e-12 * sum);
}

TEST(ClothLaws, ARigidMotionMakesNoTension) {
  Mesh mesh = tied_strips({});
  mesh.laws.push_back({{3064.2, 68823.4}, 1});
  mesh.parts.push_back("tape");
  for (int i = 0; i < 8; ++i) mesh.springs.push_back({i, i + 1, 0.02, 0.02, 0, 0, 0});
  const ClothPtr cloth = make_cloth(mesh);
  const double c = std::cos(1.1), s = std::sin(1.1);
  std::vector<Vec3> x = mesh.start;
  for (Vec3& p : x) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
    p += {3, -2, 5};
  }
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, x);
  for (double tension : spring_tensions(*cloth, state)) EXPECT_LT(std::abs(tension), 1e-8);
  for (const CellStress& stress : cell_stress(*cloth, state)) EXPECT_LT(std::abs(stress.principal_max), 1e-8);
  EXPECT_LT(elastic_energy(*cloth, state), 1e-20);
  for (Vec3 f : forces(mesh, *cloth, x)) EXPECT_LT(norm(f), 1e-8);
}

TEST(ClothLaws, TheForceIsMinusTheGradientOfTheElasticEnergy) {
  for (int degree : {1, 2, 3, 4})
    for (bool linear : {false, true}) {
      const Mesh mesh = medley(0, true, degree);
      const ClothPtr cloth = make_cloth(mesh, {linear, 0});
      ClothState state = start_state(*cloth);
      set_positions(state, *cloth, shaken(mesh.start, 0.002, 10 + degree));
      const std::vector<Vec3> x = positions(state, *cloth);
      const std::vector<Vec3> f = forces(mesh, *cloth, x);
      std::vector<char> skip(mesh.node_count(), 0);
      for (const Tie& tie : mesh.ties) skip[tie.node] = 1;
      for (int node : mesh.fixed) skip[node] = 1;
      double scale = 0;
      for (Vec3 force : f) scale = std::max(scale, norm(force));
      const double h = 2e-7;
      for (int node = 0; node < mesh.node_count(); node += 3) {
        if (skip[node]) continue;
        const auto energy = [&](Vec3 shift) {
          std::vector<Vec3> moved = x;
          moved[node] += shift;
          set_positions(state, *cloth, moved);
          return elastic_energy(*cloth, state);
        };
        const Vec3 gradient{(energy({h, 0, 0}) - energy({-h, 0, 0})) / (2 * h),
                            (energy({0, h, 0}) - energy({0, -h, 0})) / (2 * h),
                            (energy({0, 0, h}) - energy({0, 0, -h})) / (2 * h)};
        EXPECT_LT(norm(f[node] + gradient), 2e-6 * scale) << "node " << node << " degree " << degree;
      }
    }
}

void expect_kept_over_a_million_steps(double buckling_strain) {
  FabricSpec fabric;
  fabric.buckling_strain = buckling_strain;
  const Mesh mesh = rectangle(5, 8, 0.01, fabric);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  set_velocities(state, *cloth, shaken(std::vector<Vec3>(mesh.node_count(), {1, 0.5, -0.3}), 0.8, 6));
  const double dt = 0.2 * stability_limit(*cloth, state).stable_step;
  const Vec3 start = momentum(*cloth, state);
  const std::vector<double> mass = reference_masses(mesh);
  double scale = 0;
  const std::vector<Vec3> v = velocities(state, *cloth);
  for (std::size_t i = 0; i < v.size(); ++i) scale += mass[i] * norm(v[i]);
  ThreadTeam team(1);
  double low = 1e300, high = 0;
  for (int i = 0; i < 1000; ++i) {
    step(state, *cloth, {}, dt, 1000, team);
    const double energy = elastic_energy(*cloth, state) + kinetic_energy(*cloth, state);
    low = std::min(low, energy), high = std::max(high, energy);
  }
  EXPECT_EQ(state.steps, 1000000);
  EXPECT_LT(norm(momentum(*cloth, state) - start), 1e-12 * scale);
  // Semi-implicit Euler keeps a nearby energy: it swings by about omega dt / 2 and does not drift.
  EXPECT_LT((high - low) / low, 0.1);
}

TEST(ClothLaws, AFreeClothKeepsMomentumAndEnergyOverAMillionSteps) {
  expect_kept_over_a_million_steps(std::numeric_limits<double>::infinity());
}
TEST(ClothLaws, ClothThatWrinklesKeepsThemAsWell) {
  expect_kept_over_a_million_steps(1e-6);
}

TEST(ClothLaws, TiesKeepTheMass) {
  const Mesh mesh = medley(0, false);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  set_velocities(state, *cloth, std::vector<Vec3>(mesh.node_count(), {2, -1, 3}));
  double mass = 0;
  for (double m : mesh.mass) mass += m;
  EXPECT_NEAR(momentum(*cloth, state).x, 2 * mass, 1e-14 * mass);
  EXPECT_NEAR(kinetic_energy(*cloth, state), 7 * mass, 1e-13 * mass);
}

TEST(ClothLaws, AbsoluteDampingGivesTheExactTerminalSpeed) {
  const double pressure = 500, c = 8.2;  // [Pa], [N s/m3]
  const Mesh mesh = rectangle(9, 14, 0.01);
  const ClothPtr cloth = make_cloth(mesh, {false, c});
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  const Loads loads{std::vector<double>(mesh.cell_count(), pressure), {}};
  step(state, *cloth, loads, 5e-6, 60000, team);  // 60 times m / (C_a A) = 0.0407 / 8.2 s
  for (Vec3 v : velocities(state, *cloth)) EXPECT_LT(norm(v - Vec3{0, 0, pressure / c}), 1e-9 * pressure / c);
}

TEST(ClothLaws, AClosedSurfaceFeelsNoNetPressure) {
  // A box's mantle without lids under p: the net force is p times the difference of its openings, here 0.
  Mesh mesh;
  PatchSpec tube;
  tube.rows = 9, tube.columns = 21, tube.periodic = true;
  tube.position = [](int row, int column) {
    const double t = 2 * std::acos(-1.0) * column / 21;
    return Vec3{0.1 * std::cos(t), 0.1 * std::sin(t), 0.02 * row};
  };
  add_patch(mesh, tube, {});
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  std::vector<Vec3> x = shaken(mesh.start, 0.004, 8);
  for (int column = 0; column < 21; ++column) x[8 * 21 + column] = x[column] + Vec3{0, 0, 0.16};
  set_positions(state, *cloth, x);
  const Loads loads{std::vector<double>(mesh.cell_count(), 1000.0), {}};
  EXPECT_LT(norm(pressure_force(*cloth, state, loads)), 1e-13 * 1000);
}

TEST(ClothLaws, OnAFlatClothThePressureIsTheSumOfTheNodalLoads) {
  const Mesh mesh = rectangle(6, 9, 0.02);
  const ClothPtr cloth = make_cloth(mesh);
  const Loads loads{std::vector<double>(mesh.cell_count(), 300.0), {}};
  const AppliedLoad load = applied_load(*cloth, start_state(*cloth), loads, {0.08, 0.05, 0});
  const double whole = 300 * (5 * 8 * 0.02 * 0.02);
  EXPECT_NEAR(load.sum, whole, 1e-12 * whole);
  EXPECT_LT(load.norm, whole);
  EXPECT_NEAR(norm(load.moment), 0, 1e-12 * whole);  // about the middle
}

TEST(ClothLaws, ALineThatGoesSlackPushesNothing) {
  for (double compression : {0.0, 1.0}) {
    Mesh mesh = chain(4, {0, 0, 0}, {0, 0, 1}, 0.25, {{1000, 500}, compression}, 0.002);
    const ClothPtr cloth = make_cloth(mesh);
    std::vector<Vec3> x = mesh.start;
    for (Vec3& p : x) p *= 0.9;
    ClothState state = start_state(*cloth);
    set_positions(state, *cloth, x);
    for (double tension : spring_tensions(*cloth, state)) EXPECT_NEAR(tension, -100 * compression, 1e-10);
    EXPECT_NEAR(norm(forces(mesh, *cloth, x).back()), 100 * compression, 1e-6);
    EXPECT_NEAR(norm(force_on_fixed(*cloth, state)), 100 * compression, 1e-10);
    for (Vec3& p : x) p *= 1.1 / 0.9;
    set_positions(state, *cloth, x);
    for (double tension : spring_tensions(*cloth, state)) EXPECT_NEAR(tension, 105, 1e-10);
  }
}

TEST(ClothLaws, TheLinearSwitchKeepsTheFirstCoefficientOnly) {
  const Mesh mesh = chain(3, {0, 0, 0}, {0, 0, 1.2 * 0.75}, 0.25, {{1000, 500, -70}, 0}, 0.002);
  const ClothPtr nonlinear = make_cloth(mesh), linear = make_cloth(mesh, {true, 0});
  for (double t : spring_tensions(*nonlinear, start_state(*nonlinear)))
    EXPECT_NEAR(t, 1000 * 0.2 + 500 * 0.04 - 70 * 0.008, 1e-10);
  for (double t : spring_tensions(*linear, start_state(*linear))) EXPECT_NEAR(t, 1000 * 0.2, 1e-10);
}

}  // namespace
}  // namespace ripstop
