#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/rows.h"
#include "ripstop/flow/steady.h"

namespace ripstop {
namespace {

using cartesian::Axis;
using cartesian::ConvectionRow;
using cartesian::End;

// Edges of n cells on [0, 1], each `growth` times as wide over the whole length.
Axis axis_of(int n, double growth) {
  std::vector<double> edges(n + 1);
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    edges[i] = growth == 1 ? t : (std::pow(growth, t) - 1) / (growth - 1);
  }
  return cartesian::make_axis(edges, End::zero_gradient, End::zero_gradient);
}

double smooth(double x, double y, double z) {
  return std::exp(x + 0.7 * y - 0.4 * z);
}

// Mean error of convection by a uniform stream (a, b, c), upwind and with the correction, of a
// field that has no extremum.
struct Errors {
  double upwind = 0, limited = 0;
};
Errors errors(int n, double growth, double a, double b, double c) {
  const Axis x = axis_of(n, growth);
  const int pad = 8, row = n + 2 * pad;
  const std::ptrdiff_t sy = row, sz = static_cast<std::ptrdiff_t>(row) * n;
  std::vector<double> q(static_cast<std::size_t>(sz) * n), fx(q.size(), a), fy(q.size(), b), fz(q.size(), c),
      source(q.size());
  const auto centre = [&](int i) { return 0.5 * (x.edge[i] + x.edge[i + 1]); };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) q[pad + i + sy * j + sz * k] = smooth(centre(i), centre(j), centre(k));
    }
  }
  Errors sum;
  int count = 0;
  for (int k = 2; k < n - 2; ++k) {
    for (int j = 2; j < n - 2; ++j) {
      const std::ptrdiff_t at = pad + sy * j + sz * k;
      ConvectionRow r;
      r.n = n;
      r.x = &x;
      r.y = cartesian::face_metrics(x, j), r.z = cartesian::face_metrics(x, k);
      r.sy = sy, r.sz = sz, r.south2 = -2 * sy, r.north2 = 2 * sy, r.below2 = -2 * sz, r.above2 = 2 * sz;
      r.flux = {&fx[at], &fy[at], &fz[at]}, r.q = &q[at], r.source = &source[at];
      cartesian::convection_row(r);
      for (int i = 2; i < n - 2; ++i) {
        const double* p = &q[at + i];
        const auto upwind = [&](double f, std::ptrdiff_t s, int cell) {
          return f * (f > 0 ? p[0] - p[-s] : p[s] - p[0]) / x.width[cell];
        };
        const double first = upwind(a, 1, i) + upwind(b, sy, j) + upwind(c, sz, k);
        const double exact = (a + 0.7 * b - 0.4 * c) * smooth(centre(i), centre(j), centre(k));
        sum.upwind += std::abs(first - exact);
        sum.limited += std::abs(first - source[at + i] - exact);
        ++count;
      }
    }
  }
  return {sum.upwind / count, sum.limited / count};
}

TEST(Convection, TheUpwindSchemeIsOfFirstOrderAndTheLimitedOneOfSecond) {
  for (const double growth : {1.0, 4.0}) {
    for (const auto& [a, b, c] : {std::tuple{1.0, 0.6, 0.8}, std::tuple{-1.0, 0.6, -0.8}}) {
      const Errors coarse = errors(16, growth, a, b, c), fine = errors(64, growth, a, b, c);
      EXPECT_NEAR(std::log2(coarse.upwind / fine.upwind) / 2, 1, 0.25) << growth << " " << a;
      EXPECT_GT(std::log2(coarse.limited / fine.limited) / 2, 1.6) << growth << " " << a;
      EXPECT_LT(fine.limited, 0.1 * fine.upwind);
    }
  }
}

TEST(Convection, TheSecondOrderWakeConservesMomentumAndIsLessDiffuse) {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, 26, 26, 40};
  problem.air.velocity = {0, 0, 10};
  problem.sides = Sides::slip;
  problem.stopping.max_iterations = 600;
  problem.bodies = {sheet_body(disk(0.5, {0, 0, 1.5}), {12, 0})};
  problem.outlet = Outlet::still_air;
  const auto wake = [&](bool second) {
    CartesianSettings settings;
    settings.threads = 1;
    settings.second_order = second;
    const FlowField field = solve(*make_cartesian(settings), problem);
    EXPECT_TRUE(field.converged);
    EXPECT_NEAR(field.momentum_deficit.z / field.porous_force.z, 1, 0.005);
    return field.velocity[field.grid.index(13, 13, 35)].z;  // on the axis, far behind
  };
  EXPECT_LT(wake(true), wake(false) - 0.1);
}

}  // namespace
}  // namespace ripstop
