#include "ripstop/flow/cartesian/multigrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace ripstop::cartesian {
namespace {

Axis uniform(int n, double size, End low, End high) {
  std::vector<double> edges(n + 1);
  for (int i = 0; i <= n; ++i) edges[i] = size * i / n;
  return make_axis(edges, low, high);
}

// Conductances of div(g grad p) with g = 1, but `weak` inside a thin wall across the box with a hole in it.
void fill(MultigridLevel& level, const Axis& x, const Axis& y, const Axis& z, float weak) {
  const Layout& lay = level.layout;
  for (int k = 0; k <= lay.nz; ++k) {
    for (int j = 0; j < lay.ny; ++j) {
      for (int i = 0; i < lay.nx; ++i) {
        const bool hole = i > lay.nx / 3 && i < lay.nx / 2;
        const float g = k == lay.nz / 2 && !hole ? weak : 1;
        const std::ptrdiff_t at = lay.at(i, j, k);
        level.cz[at] = g * static_cast<float>(z.inverse_distance[k] * x.width[i] * y.width[j]);
        if (k == lay.nz) continue;
        level.cx[at] = g * static_cast<float>(x.inverse_distance[i] * y.width[j] * z.width[k]);
        level.cy[at] = g * static_cast<float>(y.inverse_distance[j] * x.width[i] * z.width[k]);
        level.rhs[at] = static_cast<float>(std::sin(0.9 * i + 0.4 * j * j + 1.7 * k) + (k == 3 ? 0.5 : 0.0));
      }
    }
  }
}

TEST(Multigrid, EveryCycleTakesAwayMostOfTheResidualOnOddGridsToo) {
  for (const int n : {32, 25, 38}) {
    const Axis x = uniform(n, 2, End::zero_gradient, End::zero_gradient);
    const Axis y = uniform(n - 3, 2, End::zero_gradient, End::zero_gradient);
    const Axis z = uniform(2 * n - 1, 4, End::zero_gradient, End::fixed_value);
    // Interpolation ignores the wall, so a wall ten times tighter than the air costs cycles.
    const std::pair<float, double> cases[] = {{1.0f, 0.35}, {0.1f, 0.6}};
    for (const auto& [weak, slowest] : cases) {
      Multigrid multigrid(x, y, z);
      fill(multigrid.finest(), x, y, z, weak);
      ThreadTeam team(1);
      multigrid.solve(team, 0, 1);
      const double one = multigrid.residual();
      multigrid.solve(team, 0, 4);
      const double rate = std::cbrt(multigrid.residual() / one);
      EXPECT_LT(rate, slowest) << n << " cells, wall of conductance " << weak;
    }
  }
}

// A wall with a hole, whose right side changes by a twentieth from one solution to the next.
TEST(Multigrid, TheSolutionOfASimilarProblemSavesHalfTheCycles) {
  const Axis x = uniform(25, 2, End::zero_gradient, End::zero_gradient);
  const Axis z = uniform(40, 4, End::zero_gradient, End::fixed_value);
  Multigrid multigrid(x, x, z);
  ThreadTeam team(1);
  MultigridLevel& level = multigrid.finest();
  const auto like = [&](int which) {
    fill(level, x, x, z, 0.02f);
    for (std::size_t n = 0; n < level.rhs.size(); ++n)
      level.rhs[n] *= 1 + 0.05f * static_cast<float>(which * std::sin(0.1 * double(n)));
  };
  constexpr double reduction = 0.01;
  constexpr int most = 20;
  Array<float> last(level.layout.values());
  like(0);
  const int from_zero = multigrid.solve_conjugate(team, 0, reduction, most, &last);
  like(0);
  EXPECT_EQ(multigrid.solve_conjugate(team, 0, reduction, most, &last), 0) << "the same problem";
  like(1);
  const int from_nothing = multigrid.solve_conjugate(team, 0, reduction, most);
  const Array<float> answer = level.e;
  like(1);
  const int from_last = multigrid.solve_conjugate(team, 0, reduction, most, &last);
  EXPECT_EQ(from_zero, from_nothing);
  EXPECT_LE(2 * from_last, from_nothing);
  double apart = 0, size = 0;
  for (std::size_t n = 0; n < answer.size(); ++n) {
    apart += std::pow(answer[n] - level.e[n], 2), size += std::pow(answer[n], 2);
    EXPECT_EQ(last[n], level.e[n]);
  }
  EXPECT_LT(std::sqrt(apart / size), 2 * reduction);
}

// For a zero solution it is the right-hand side, over all cells.
TEST(Multigrid, TheResidualIsTheSumOverAllCellsWithoutTheirSigns) {
  const Axis x = uniform(9, 2, End::zero_gradient, End::zero_gradient);
  const Axis z = uniform(12, 4, End::zero_gradient, End::fixed_value);
  Multigrid multigrid(x, x, z);
  MultigridLevel& level = multigrid.finest();
  fill(level, x, x, z, 1);
  double sum = 0;
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i) sum += std::abs(level.rhs[level.layout.at(i, j, k)]);
  EXPECT_NEAR(multigrid.residual() / sum, 1, 1e-6);
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 9; ++i) level.rhs[level.layout.at(i, j, k)] = 0;
  EXPECT_EQ(multigrid.residual(), 0);
}

}  // namespace
}  // namespace ripstop::cartesian
