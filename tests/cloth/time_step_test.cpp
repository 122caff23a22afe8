// Order of the integrator, and how good the bound on its step is.
#include <gtest/gtest.h>

#include <cmath>

#include "builders.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

using namespace testing;

Loads weight_of(const Mesh& mesh) {
  Loads loads;
  for (double mass : reference_masses(mesh)) loads.node_force.push_back({0, 0, -gravity * mass});
  return loads;
}

// Position of the last node after `time` with `count` steps.
Vec3 last_position(const Mesh& mesh, const Loads& loads, const std::vector<Vec3>& speed, double time,
                   int count) {
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  if (!speed.empty()) set_velocities(state, *cloth, speed);
  ThreadTeam team(1);
  step(state, *cloth, loads, time / count, count, team);
  return positions(state, *cloth).back();
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(TimeStep, AnOscillatingSpringConvergesInFirstOrder) {
  const double k = 50, length = 1, mass = 0.2;  // T = K e: stiffness K / L
  Mesh mesh = chain(1, {0, 0, 0}, {0, 0, 1.1}, length, {{k}, 1}, 0);
  mesh.mass = {mass, mass};
  const double omega = std::sqrt(k / length / mass), time = 5.3 / omega;
  const double exact = 1 + 0.1 * std::cos(omega * time);
  std::vector<double> error;
  for (int count : {400, 800, 1600})
    error.push_back(std::abs(last_position(mesh, {}, {}, time, count).z - exact));
  EXPECT_NEAR(order(error[0], error[1]), 1, 0.05);
  EXPECT_NEAR(order(error[1], error[2]), 1, 0.03);
}

// [NFM] Eq. 8: one spring against one mass.
TEST(TimeStep, ThePrintedOneIsTheRootOfTheLeastMassOverStiffness) {
  Mesh mesh = chain(2, {0, 0, 0}, {0, 0, 2}, 1, {{50}, 1}, 0);
  mesh.mass = {0.5, 0.5, 0.2};
  const ClothPtr cloth = make_cloth(mesh);
  EXPECT_NEAR(stability_limit(*cloth, start_state(*cloth)).printed_step, std::sqrt(0.2 / 50), 1e-12);
}

TEST(TimeStep, AnElasticPendulumConvergesInFirstOrder) {
  const double k = 400, mass = 0.1;
  Mesh mesh = chain(1, {0, 0, 0}, {0.8, 0, -0.6}, 1.0, {{k, 100}, 1}, 0);
  mesh.mass = {mass, mass};
  const double time = 0.7;
  // Reference: classical Runge-Kutta on (r, v) with a step that leaves 1e-9.
  const auto acceleration = [&](Vec3 r) {
    const double e = norm(r) - 1;
    const double tension = e >= 0 ? k * e + 100 * e * e : k * e;
    return (-tension / mass / norm(r)) * r + Vec3{0, 0, -gravity};
  };
  Vec3 r = mesh.start[1], v;
  const int count = 20000;
  const double h = time / count;
  for (int i = 0; i < count; ++i) {
    const Vec3 v1 = v, a1 = acceleration(r), v2 = v + 0.5 * h * a1, a2 = acceleration(r + 0.5 * h * v1);
    const Vec3 v3 = v + 0.5 * h * a2, a3 = acceleration(r + 0.5 * h * v2), v4 = v + h * a3,
               a4 = acceleration(r + h * v3);
    r += (h / 6) * (v1 + 2 * v2 + 2 * v3 + v4);
    v += (h / 6) * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  std::vector<double> error;
  for (int steps : {2000, 4000, 8000})
    error.push_back(norm(last_position(mesh, weight_of(mesh), {}, time, steps) - r));
  EXPECT_NEAR(order(error[0], error[1]), 1, 0.05);
  EXPECT_NEAR(order(error[1], error[2]), 1, 0.03);
}

TEST(TimeStep, AHangingChainThatSwingsConvergesInFirstOrder) {
  const Mesh mesh = chain(8, {0, 0, 0}, {0.8, 0, 0}, 0.1, {{200}, 0}, 0.1);
  std::vector<Vec3> end;
  for (int steps : {4000, 8000, 16000, 32000})
    end.push_back(last_position(mesh, weight_of(mesh), {}, 0.25, steps));
  EXPECT_NEAR(order(norm(end[0] - end[1]), norm(end[1] - end[2])), 1, 0.1);
  EXPECT_NEAR(order(norm(end[1] - end[2]), norm(end[2] - end[3])), 1, 0.05);
}

struct Probe {
  const char* name;
  Mesh mesh;
  double stretch;
};

std::vector<Probe> probes(double damping) {
  FabricSpec fabric;
  fabric.damping = damping;
  std::vector<Probe> list;
  list.push_back({"lattice", rectangle(14, 14, 0.01, fabric), 1.0});
  list.push_back({"stretched coupon", rectangle(6, 30, 0.01, fabric), 1.1});
  Mesh line = chain(30, {0, 0, 0}, {0, 0, 1.5}, 0.05, {{211895, 489633}, 0}, 0.002);
  for (Spring& s : line.springs) s.damping = 20 * damping;
  line.mass.back() *= 2;
  list.push_back({"line", line, 1.02});
  list.push_back({"tied mesh", tied_strips(fabric), 1.0});
  return list;
}

// Speed after `count` steps from a small shake, over the first.
double growth(const Probe& probe, double step_over_bound, int count) {
  const ClothPtr cloth = make_cloth(probe.mesh);
  std::vector<Vec3> x = probe.mesh.start;
  for (Vec3& p : x) p = {p.x * probe.stretch, p.y, p.z * probe.stretch};
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, x);
  const double dt = step_over_bound * stability_limit(*cloth, state).stable_step;
  // Hold the stretched shape: its internal force, reversed, is the load.
  Loads loads;
  loads.node_force = reference_forces(probe.mesh, {}, {}, x, std::vector<Vec3>(x.size()));
  for (Vec3& f : loads.node_force) f = -f;
  set_velocities(state, *cloth, shaken(std::vector<Vec3>(x.size()), 1e-6, 7));
  const double before = kinetic_energy(*cloth, state);
  state.steps = 1;  // the check of the step comes with step 2048
  ThreadTeam team(1);
  step(state, *cloth, loads, dt, count, team);
  return std::sqrt(kinetic_energy(*cloth, state) / before);
}

TEST(TimeStep, TheStabilityLimitIsStableAndAQuarterMoreDiverges) {
  for (double damping : {0.0, 0.002})
    for (const Probe& probe : probes(damping)) {
      EXPECT_LT(growth(probe, 0.999, 2000), 30) << probe.name << ", damping " << damping;
      EXPECT_GT(growth(probe, 1.25, 20), 1e4) << probe.name << ", damping " << damping;
    }
}

TEST(TimeStep, TheBoundOfAnAlignedLatticeIsTheSumOfItsFamilies) {
  // omega^2 = 4 (k_ax + k_sh + k_b) / m for the wave that moves neighbours against each other: per axis two
  // axial springs, four shear springs at 45 degrees, two bending springs.
  const double h = 0.01, w = h, m = 0.0407 * h * h;
  const SpringLaw whole{f111_curve, 1};
  const double axial = 0.79 * 30006 * w / h, shear = 0.1 * 30006 * w / (std::sqrt(2.0) * h),
               bend = 0.005 * 30006 * w / (2 * h);
  const double omega2 = 4 * (axial + shear + bend) / m;
  const Mesh mesh = rectangle(20, 20, h);
  const ClothPtr cloth = make_cloth(mesh);
  // The middle of the cloth; its edges have half the mass and about half the stiffness.
  EXPECT_NEAR(stability_limit(*cloth, start_state(*cloth)).stable_step / (2 / std::sqrt(omega2)), 1, 0.06);
}

TEST(TimeStep, ANodeThatIsTiedToOneOtherMovesAsThatOneDoes) {
  for (const double stiff : {0.01, 100.0}) {  // the spring of the tied node over the other one
    Mesh sewn = chain(2, {0, 0, 0}, {0, 0, 2}, 1, {{50}, 1}, 0);
    sewn.springs[1].scale *= stiff;
    sewn.mass = {5, 0.2, 0.05};
    Mesh tied = sewn;
    tied.start.push_back(tied.start[1]);
    tied.mass = {5, 0.1, 0.05, 0.1};
    tied.ties.push_back({3, {{1, 1.0}}});
    Spring& last = tied.springs[1];
    (last.a == 1 ? last.a : last.b) = 3;
    const ClothPtr one = make_cloth(sewn), two = make_cloth(tied);
    const StabilityLimit a = stability_limit(*one, start_state(*one)),
                         b = stability_limit(*two, start_state(*two));
    EXPECT_DOUBLE_EQ(a.stable_step, b.stable_step) << stiff;
    EXPECT_DOUBLE_EQ(a.printed_step, b.printed_step) << stiff;
  }
}

TEST(TimeStep, AStepAboveTheBoundIsRefusedWithItsPlace) {
  const Mesh mesh = medley(0, true);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  const StabilityLimit limit = stability_limit(*cloth, state);
  try {
    step(state, *cloth, {}, 1.5 * limit.stable_step, 10, team);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::diverged);
    EXPECT_NE(std::string(error.what()).find(limit.part), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("step 0"), std::string::npos) << error.what();
  }
}

TEST(TimeStep, LoadsThatAreNotFiniteAreFound) {
  const Mesh mesh = rectangle(5, 5, 0.01);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  Loads loads;
  loads.node_force.assign(mesh.node_count(), {});
  loads.node_force[12].y = std::nan("");
  ThreadTeam team(1);
  EXPECT_THROW(step(state, *cloth, loads, 1e-7, 10, team), Error);
  EXPECT_THROW(step(state, *cloth, {{1.0, 2.0}, {}}, 1e-7, 10, team), Error);  // wrong length
  state = start_state(*cloth);
  try {  // before the others have heard of it
    step(state, *cloth, loads, 1e-7, 1, team);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("node 12 "), std::string::npos) << error.what();
  }
}

TEST(TimeStep, ClothThatIsTornApartIsReported) {
  Mesh mesh = chain(3, {0, 0, 0}, {0, 0, 0.3}, 0.1, {{10}, 0}, 1.0);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  Loads loads;
  loads.node_force.assign(4, {0, 0, 1000});
  ThreadTeam team(1);
  try {
    step(state, *cloth, loads, 1e-3, 100000, team);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::diverged);
    EXPECT_NE(std::string(error.what()).find("line"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ripstop
