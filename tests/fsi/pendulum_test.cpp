// A rigid disk that hangs from a pivot in still air and swings broadside: the air that moves with it slows the swing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/coupled_step.h"

namespace ripstop {
namespace {
namespace swinging_disk {

using std::numbers::pi;

constexpr int n = 9;  // nodes along and across the disk
constexpr double radius = 0.25, arm = 0.6, areal_mass = 0.25, stiffness = 2e4, gravity = 9.81, density = 1.2;
constexpr double released_at = 3 * pi / 180, time_step = 0.01;  // [rad], [s]

/// In the plane x = 0 about the origin. Struts to the pivot above and to three light nodes make one rigid body of it.
CanopyMesh pendulum() {
  CanopyMesh mesh;
  Patch patch;
  patch.name = "disk", patch.rows = patch.columns = n;
  patch.cell_area.assign(n * n, 0.0);
  for (int d = 0; d < direction_count; ++d) {
    patch.law[d].coefficients = {stiffness};
    patch.rest_length[d].assign(n * n, 1.0), patch.width[d].assign(n * n, 0.0);
  }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {  // a square that is mapped to a disk
      const double u = 2.0 * column / (n - 1) - 1, v = 2.0 * row / (n - 1) - 1;
      mesh.start.push_back(radius * Vec3{0, u * std::sqrt(1 - 0.5 * v * v), v * std::sqrt(1 - 0.5 * u * u)});
    }
  mesh.mass.assign(n * n, 1e-9);
  for (int row = 0; row + 1 < n; ++row)
    for (int column = 0; column + 1 < n; ++column) {
      const int corner[] = {patch.node(row, column), patch.node(row, column + 1),
                            patch.node(row + 1, column + 1), patch.node(row + 1, column)};
      const double area = norm(area_vector(mesh.start[corner[0]], mesh.start[corner[1]],
                                           mesh.start[corner[2]], mesh.start[corner[3]]));
      patch.cell_area[row * n + column] = area;
      for (const int node : corner) mesh.mass[node] += 0.25 * areal_mass * area;
    }
  mesh.fabric_names = {"disk"};
  mesh.patches.push_back(patch);
  mesh.laws.emplace_back().coefficients = {stiffness};
  mesh.parts = {"strut"};
  const int pivot = n * n;
  for (const Vec3 p : {Vec3{0, 0, arm}, Vec3{0.4, 0.1, 0.1}, Vec3{-0.3, 0.3, 0}, Vec3{-0.3, -0.4, -0.1}})
    mesh.start.push_back(p), mesh.mass.push_back(1e-3);
  for (int to = pivot; to < pivot + 4; ++to)
    for (int from = 0; from < to; ++from)
      mesh.springs.push_back({from, to, norm(mesh.start[from] - mesh.start[to])});
  mesh.fixed = {pivot};
  return mesh;
}

FlowProblem still_air() {
  FlowProblem flow;
  flow.grid =
      graded({{-1.5, -1.5, -1.5}, {3, 3, 3}, 32, 32, 32}, {-0.32, -0.32, -0.32}, {0.32, 0.32, 0.32}, 1.25);
  flow.air.velocity = {0, 0, 0.01};  // a flow needs a stream
  flow.air.density = density;
  flow.sides = Sides::far_field;
  flow.bodies = {sheet_body({}, {1e6, 0})};
  return flow;
}

/// Small-oscillation period of a rigid body with this inertia and that of the air about the pivot [s].
double period_of(const CanopyMesh& mesh, double inertia_of_air) {
  double inertia = inertia_of_air, restoring = 0;
  for (std::size_t i = 0; i < mesh.start.size(); ++i) {
    const Vec3 from = mesh.start[i] - mesh.start[n * n];
    inertia += mesh.mass[i] * (from.x * from.x + from.z * from.z);
    restoring -= mesh.mass[i] * gravity * from.z;
  }
  return 2 * pi * std::sqrt(inertia / restoring);
}

/// Twice the time between two passages of the vertical.
double measured_period(const CanopyMesh& mesh) {
  CartesianSettings settings;
  settings.threads = 1, settings.compressible = false;
  ThreadTeam team(1);
  const ClothPtr cloth = make_cloth(mesh, {});
  CoupledFlow air({still_air(), 0.5, make_cartesian(settings)}, mesh);
  const AdaptiveStepper stepper(AdaptiveStepper::Step::renewed, 0.5, time_step, team);
  std::vector<Vec3> x = mesh.start;
  const Vec3 pivot = mesh.start[n * n];
  for (Vec3& p : x) {
    const Vec3 from = p - pivot;
    p = pivot + Vec3{std::cos(released_at) * from.x - std::sin(released_at) * from.z, from.y,
                     std::sin(released_at) * from.x + std::cos(released_at) * from.z};
  }
  InflationState state;
  state.cloth = start_state(*cloth);
  set_positions(state.cloth, *cloth, x);
  state.step = stepper.allowed_step(state, *cloth);
  Surroundings around;
  around.moves = true, around.stream = {0, 0, 0.01}, around.on_mass = {0, 0, -gravity};
  std::vector<double> passed;
  double before = x[n * n / 2].x;
  for (long long row = 0; passed.size() < 2 && row < 400; ++row) {
    take_coupled_step(air, stepper, *cloth, {row, 1, 1}, around, team, state);
    const double now = positions(state.cloth, *cloth)[n * n / 2].x;
    if (now * before < 0) passed.push_back(state.cloth.time - time_step * now / (now - before));
    before = now;
  }
  return passed.size() < 2 ? 0 : 2 * (passed[1] - passed[0]);
}

// Added mass 8/3 rho a^3 and added inertia 16/45 rho a^5 about a diameter (Lamb, Hydrodynamics, 108 and 114).
TEST(Pendulum, HasThePeriodOfItsMassAndAddedMass) {
  const CanopyMesh mesh = pendulum();
  const double added =
      8.0 / 3 * density * std::pow(radius, 3) * arm * arm + 16.0 / 45 * density * std::pow(radius, 5);
  const double expected = period_of(mesh, added), in_vacuum = period_of(mesh, 0);
  EXPECT_GT(expected, 1.3 * in_vacuum) << "the air matters";
  const double measured = measured_period(mesh);
  RecordProperty("measured_over_expected", std::to_string(measured / expected));
  EXPECT_NEAR(measured, expected, 0.05 * expected);
}

}  // namespace swinging_disk
}  // namespace
}  // namespace ripstop
