// A cord that slides through rings: one tension, one energy, the polygon that it closes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "builders.h"
#include "ripstop/core/error.h"

namespace ripstop {
namespace {

using namespace testing;

constexpr double cord_stiffness = 5000;  // E A [N]

Drawstring string_through(std::vector<int> rings, double rest_length, double damping = 0) {
  return {std::move(rings), rest_length, {{cord_stiffness}, 0}, damping};
}

/// Bare masses on a circle, and a string round them.
Mesh hoop(int count, double radius, double rest_length, double mass, double damping = 0) {
  Mesh mesh;
  std::vector<int> rings;
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    mesh.start.push_back({radius * std::cos(turn), radius * std::sin(turn), 0});
    mesh.mass.push_back(mass);
    rings.push_back(i);
  }
  mesh.drawstring = string_through(rings, rest_length, damping);
  return mesh;
}

std::vector<Vec3> outward(const Mesh& mesh, double size) {
  std::vector<Vec3> result;
  for (const Vec3 p : mesh.start) result.push_back(size / norm(p) * p);
  return result;
}

/// Through tied nodes, masters, inner nodes and ends of springs, not in any order along the cloth; `slack` times as
/// long as its way.
Mesh drawn_medley(double slack, double damping) {
  Mesh mesh = medley(0, false);
  std::vector<int> rings{mesh.ties.front().node, mesh.ties.front().masters.front().node};
  for (int node = 1; node < mesh.node_count() && rings.size() < 9; node += 7)
    if (std::find(rings.begin(), rings.end(), node) == rings.end()) rings.push_back(node);
  double way = 0;
  for (std::size_t i = 0; i < rings.size(); ++i)
    way += norm(mesh.start[rings[(i + 1) % rings.size()]] - mesh.start[rings[i]]);
  mesh.drawstring = string_through(rings, slack * way, damping);
  return mesh;
}

std::vector<Vec3> pushes(const Mesh& mesh, const Cloth& cloth, ClothState state) {
  const std::vector<Vec3> before = velocities(state, cloth);
  const std::vector<double> mass = reference_masses(mesh);
  constexpr double dt = 1e-9;
  ThreadTeam team(1);
  step(state, cloth, {}, dt, 1, team);
  std::vector<Vec3> force = velocities(state, cloth);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = (mass[i] / dt) * (force[i] - before[i]);
  return force;
}

TEST(Drawstring, TheForceIsMinusTheGradientOfTheEnergy) {
  const Mesh mesh = drawn_medley(0.8, 0);
  Mesh without = mesh;
  without.drawstring.reset();
  const ClothPtr cloth = make_cloth(mesh), free = make_cloth(without);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, shaken(mesh.start, 0.002, 3));
  const std::vector<Vec3> x = positions(state, *cloth);
  const std::vector<Vec3> with_string = pushes(mesh, *cloth, state), springs = pushes(mesh, *free, state);
  ASSERT_GT(drawn_length(*cloth, state), 1.1 * mesh.drawstring->rest_length);
  const auto energy = [&](int node, Vec3 shift) {
    std::vector<Vec3> moved = x;
    moved[node] += shift;
    set_positions(state, *cloth, moved);
    return elastic_energy(*cloth, state) - elastic_energy(*free, state);
  };
  constexpr double h = 1e-6;
  double pulled = 0;
  for (int node = 0; node < mesh.node_count(); ++node) {
    if (std::any_of(mesh.ties.begin(), mesh.ties.end(), [&](const Tie& tie) { return tie.node == node; }))
      continue;
    const Vec3 gradient{(energy(node, {h, 0, 0}) - energy(node, {-h, 0, 0})) / (2 * h),
                        (energy(node, {0, h, 0}) - energy(node, {0, -h, 0})) / (2 * h),
                        (energy(node, {0, 0, h}) - energy(node, {0, 0, -h})) / (2 * h)};
    const Vec3 force = with_string[node] - springs[node];
    pulled = std::max(pulled, norm(force));
    EXPECT_LT(norm(force + gradient), 1e-5 * cord_stiffness) << node;
  }
  EXPECT_GT(pulled, 0.05 * cord_stiffness);
}

TEST(Drawstring, ItsForcesAndMomentsSumToZeroWhileItSlides) {
  const Mesh mesh = drawn_medley(0.8, 0.4);
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  set_positions(state, *cloth, shaken(mesh.start, 0.002, 4));
  set_velocities(state, *cloth, shaken(std::vector<Vec3>(mesh.node_count()), 2, 5));
  const std::vector<Vec3> x = positions(state, *cloth), force = pushes(mesh, *cloth, state);
  Vec3 sum, moment;
  double all = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += force[i], moment += cross(x[i], force[i]), all += norm(force[i]);
  EXPECT_LT(norm(sum), 1e-9 * all);  // the difference of two speeds over 1 ns
  EXPECT_LT(norm(moment), 1e-9 * all);
}

TEST(Drawstring, OneThatIsLongerThanItsWayPullsNothing) {
  const Mesh mesh = hoop(7, 0.5, 3.04, 0.01, 1);  // 14 x 0.5 m sin(pi / 7) = 3.037 m
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  EXPECT_NEAR(drawn_length(*cloth, state), 7 * std::sin(std::numbers::pi / 7), 1e-14);
  set_velocities(state, *cloth, outward(mesh, 1));
  EXPECT_EQ(elastic_energy(*cloth, state), 0);
  for (const Vec3 force : pushes(mesh, *cloth, state)) EXPECT_EQ(norm(force), 0);
}

// F outward on each of N rings: 2 T sin(pi / N) = F, 2 N R sin(pi / N) = L0 (1 + T / EA).
TEST(Drawstring, ARingPulledOutwardIsInEquilibriumWithItsTension) {
  for (const int count : {3, 8, 18}) {
    constexpr double load = 30, length = 2, mass = 0.01;
    const double sine = std::sin(std::numbers::pi / count), tension = load / (2 * sine);
    const double radius = length * (1 + tension / cord_stiffness) / (2 * count * sine);
    const double breathing = 2 * sine * std::sqrt(count * cord_stiffness / length / mass);  // [1/s]
    const double damping = 0.5 * cord_stiffness / length / breathing;
    const Mesh mesh = hoop(count, 0.98 * radius, length, mass, damping);
    const ClothPtr cloth = make_cloth(mesh);
    ClothState state = start_state(*cloth);
    ThreadTeam team(1);
    StepRecord record;
    const double dt = 0.2 * stability_limit(*cloth, state).stable_step;
    step(state, *cloth, {{}, outward(mesh, load)}, dt, static_cast<int>(200 / breathing / dt), team, &record);
    for (const Vec3 p : positions(state, *cloth)) EXPECT_NEAR(norm(p), radius, 1e-9 * radius) << count;
    EXPECT_NEAR(record.drawstring.back(), tension, 1e-6 * tension) << count;
  }
}

TEST(Drawstring, TheStableStepIsThatOfARingThatBreathes) {
  constexpr int count = 12;
  constexpr double mass = 0.02, radius = 0.7;
  const double sine = std::sin(std::numbers::pi / count), length = 2 * count * radius * sine;
  const Mesh mesh = hoop(count, radius, length, mass);
  const ClothPtr cloth = make_cloth(mesh);
  const double breathing = 2 * sine * std::sqrt(count * cord_stiffness / length / mass);
  EXPECT_NEAR(stability_limit(*cloth, start_state(*cloth)).stable_step, 2 / breathing, 1e-9 / breathing);
}

// By power iteration on M^-1 K, K from the forces.
TEST(Drawstring, TheStableStepIsValidForRingsInDisorderAndNotMuchTooSmall) {
  for (const unsigned seed : {1, 2, 3, 4}) {
    Mesh mesh = hoop(11, 0.4, 1, 0.01);
    mesh.start = shaken(mesh.start, 0.3, seed);
    for (std::size_t i = 0; i < mesh.mass.size(); ++i) mesh.mass[i] *= 1 + 0.1 * static_cast<double>(i);
    mesh.drawstring->rest_length = 0.97 * drawn_length(*make_cloth(mesh), start_state(*make_cloth(mesh)));
    const ClothPtr cloth = make_cloth(mesh);
    ClothState state = start_state(*cloth);
    const auto forces_at = [&](const std::vector<Vec3>& shift, double h) {
      std::vector<Vec3> x = mesh.start;
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * shift[i];
      set_positions(state, *cloth, x);
      return pushes(mesh, *cloth, state);
    };
    std::vector<Vec3> mode = shaken(std::vector<Vec3>(mesh.node_count()), 1, seed + 9);
    double squared = 0;
    for (int i = 0; i < 200; ++i) {
      constexpr double h = 1e-6;
      const std::vector<Vec3> before = forces_at(mode, -h), after = forces_at(mode, h);
      double size = 0;
      for (std::size_t n = 0; n < mode.size(); ++n) {
        mode[n] = (before[n] - after[n]) / (2 * h * mesh.mass[n]);
        size += mesh.mass[n] * dot(mode[n], mode[n]);
      }
      squared = std::sqrt(size);
      for (Vec3& part : mode) part = part / squared;
    }
    set_positions(state, *cloth, mesh.start);
    const double allowed = stability_limit(*cloth, state).stable_step, largest = 2 / std::sqrt(squared);
    EXPECT_LT(allowed, 1.0001 * largest) << seed;
    EXPECT_GT(allowed, 0.6 * largest) << seed;
  }
}

TEST(Drawstring, FarFromTautItTakesNothingOfTheStep) {
  Mesh mesh = drawn_medley(100, 10);
  const ClothPtr drawn = make_cloth(mesh);
  mesh.drawstring->rest_length *= 0.0099;
  const ClothPtr taut = make_cloth(mesh);
  mesh.drawstring.reset();
  const ClothPtr without = make_cloth(mesh);
  const double step = stability_limit(*without, start_state(*without)).stable_step;
  EXPECT_EQ(stability_limit(*drawn, start_state(*drawn)).stable_step, step);
  EXPECT_LT(stability_limit(*taut, start_state(*taut)).stable_step, 0.9 * step);
}

TEST(Drawstring, ItsDamperAbsorbsTheEnergyOfTheRing) {
  const Mesh mesh = hoop(9, 0.5, 3.0, 0.01, 0.3);
  const ClothPtr cloth = make_cloth(mesh);
  const auto lost = [&](int steps) {
    ClothState state = start_state(*cloth);
    set_velocities(state, *cloth, outward(mesh, 6));
    const double before = kinetic_energy(*cloth, state) + elastic_energy(*cloth, state);
    ThreadTeam team(1);
    StepRecord record;
    step(state, *cloth, {}, 5e-3 / steps, steps, team, &record);
    EXPECT_GT(record.damped, 0.1 * before);
    return std::abs(kinetic_energy(*cloth, state) + elastic_energy(*cloth, state) + record.damped - before) /
           before;
  };
  const double coarse = lost(500), fine = lost(5000);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.2 * coarse);
}

TEST(Drawstring, AnyNumberOfThreadsStepsItAlike) {
  const Mesh mesh = drawn_medley(0.98, 0.02);
  const ClothPtr cloth = make_cloth(mesh, {false, 8.2, 0});
  const auto stepped = [&](int threads, StepRecord& record) {
    ClothState state = start_state(*cloth);
    ThreadTeam team(threads);
    step(state, *cloth, {}, 0.5 * stability_limit(*cloth, state).stable_step, 400, team, &record);
    return state;
  };
  StepRecord one, three;
  const ClothState a = stepped(1, one), b = stepped(3, three);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(one.drawstring, three.drawstring);
  EXPECT_EQ(one.damped, three.damped);
  EXPECT_GT(one.drawstring.front(), 0);
}

TEST(Drawstring, ARelaxationFindsTheRingThatItsAnchorsAndItsStringHold) {
  constexpr int count = 10;
  constexpr double anchor_length = 0.2, anchor = 800;  // [m], [N]
  Mesh mesh = hoop(count, 0.5, 2.8, 0.01);
  mesh.laws = {{{anchor}, 1}};
  mesh.parts = {"anchor"};
  for (int i = 0; i < count; ++i) {
    mesh.start.push_back(1.4 * mesh.start[i]);
    mesh.mass.push_back(0.01);
    mesh.fixed.push_back(count + i);
    mesh.springs.push_back({i, count + i, anchor_length, 1, 0, 0, 0});
  }
  const ClothPtr cloth = make_cloth(mesh);
  ClothState state = start_state(*cloth);
  ThreadTeam team(1);
  RelaxOptions options;
  options.tolerance = 1e-9;
  options.least_load = 100;
  EXPECT_TRUE(relax(state, *cloth, {}, options, team).converged);
  const double sine = std::sin(std::numbers::pi / count);
  const double tension = cord_stiffness * (drawn_length(*cloth, state) / 2.8 - 1);
  const double radius = norm(positions(state, *cloth)[3]);
  EXPECT_GT(tension, 50);
  EXPECT_NEAR(2 * tension * sine, anchor * ((0.7 - radius) / anchor_length - 1), 1e-5 * tension);
}

TEST(Drawstring, OneThroughNodesThatAreNotThereIsRefused) {
  Mesh mesh = hoop(5, 1, 6, 0.01);
  mesh.drawstring->rings.push_back(5);
  EXPECT_THROW(make_cloth(mesh), Error);
  mesh.drawstring->rings = {0};
  EXPECT_THROW(make_cloth(mesh), Error);
}

}  // namespace
}  // namespace ripstop
