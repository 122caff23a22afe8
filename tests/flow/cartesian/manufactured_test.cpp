// Order of the whole solution, by a manufactured flow: a uniform stream and a smooth eddy in it, maintained by the
// force on the air that the Navier-Stokes equations require.
#include <gtest/gtest.h>

#include <cmath>

#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"

namespace ripstop::manufactured {
namespace {

constexpr double stream = 10, eddy = 0.2, density = 1.2, viscosity = 0.24, swing = 20;

// b(s) = (1 - s^2)^5 for |s| < 1, and its derivatives: smooth at the rim, nothing beyond it.
struct Bump {
  double value = 0, first = 0, second = 0, third = 0;
  explicit Bump(double s) {
    const double q = 1 - s * s;
    if (q <= 0) return;
    value = std::pow(q, 5);
    first = -10 * s * std::pow(q, 4);
    second = -10 * std::pow(q, 4) + 80 * s * s * std::pow(q, 3);
    third = 240 * s * std::pow(q, 3) - 480 * s * s * s * q * q;
  }
};

struct Flow {
  Vec3 velocity, force;
};

// u = U e_z + curl(psi e_y), psi = A b(x) b(y) b(z), p = P b(x) b(y) b(z); the eddy is
// of unit size about `c`.
Flow made_up(Vec3 at, Vec3 c) {
  const Bump x(at.x - c.x), y(at.y - c.y), z(at.z - c.z);
  const double a = eddy * stream;
  Flow flow;
  const double u = -a * x.value * y.value * z.first, w = stream + a * x.first * y.value * z.value;
  flow.velocity = {u, 0, w};
  const double ux = -a * x.first * y.value * z.first, uz = -a * x.value * y.value * z.second;
  const double wx = a * x.second * y.value * z.value, wz = a * x.first * y.value * z.first;
  const double laplace_u =
      -a * (x.second * y.value * z.first + x.value * y.second * z.first + x.value * y.value * z.third);
  const double laplace_w =
      a * (x.third * y.value * z.value + x.first * y.second * z.value + x.first * y.value * z.second);
  flow.force = {density * (u * ux + w * uz) + swing * x.first * y.value * z.value - viscosity * laplace_u,
                swing * x.value * y.first * z.value,
                density * (u * wx + w * wz) + swing * x.value * y.value * z.first - viscosity * laplace_w};
  return flow;
}

// Root mean square error of the velocity over U where the eddy is, on n cells a metre. The flow is symmetric about y = 0,
// where the side of half the domain is a mirror.
double error(int n, bool second_order) {
  FlowProblem problem;
  problem.grid = {{-1, 0, 0}, {2, 1, 3}, 2 * n, n, 3 * n};
  // Next to no turbulence: its eddy viscosity is a millionth of the air's.
  problem.air = {.velocity = {0, 0, stream},
                 .density = density,
                 .viscosity = viscosity,
                 .turbulence_intensity = 1e-4,
                 .viscosity_ratio = 1e-6};
  problem.sides = Sides::slip;
  problem.stopping.residual = 1e-4;
  const FlowGrid& grid = problem.grid;
  const Vec3 centre{0, 0, 1.37};
  const auto place = [&](int i, int j, int k) {
    return Vec3{grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)};
  };
  problem.body_force.resize(grid.cells());
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        problem.body_force[grid.index(i, j, k)] = made_up(place(i, j, k), centre).force;
  CartesianSettings settings;
  settings.threads = 1;
  settings.compressible = false;
  settings.second_order = second_order;
  const FlowField field = solve(*make_cartesian(settings), problem);
  EXPECT_TRUE(field.converged);
  double sum = 0;
  int count = 0;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const Vec3 at = place(i, j, k);
        if (norm(at - centre) > 1) continue;
        const Vec3 off = field.velocity[grid.index(i, j, k)] - made_up(at, centre).velocity;
        sum += dot(off, off), ++count;
      }
  return std::sqrt(sum / count) / stream;
}

TEST(MadeUpFlow, TheUpwindSolutionIsOfFirstOrder) {
  const double coarse = error(12, false), fine = error(24, false);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1) << coarse << " to " << fine;
}

// On finer grids than the upwind one: from 12 to 24 cells a metre it still falls faster than it will.
TEST(MadeUpFlow, TheLimitedSolutionIsOfSecondOrder) {
  const double coarse = error(16, true), fine = error(32, true);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25) << coarse << " to " << fine;
  EXPECT_LT(coarse, 0.1 * error(16, false));
}

}  // namespace
}  // namespace ripstop::manufactured
