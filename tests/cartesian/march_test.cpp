// Steps in time: conservation, order, and that nothing but the flow itself decides what comes next.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <tuple>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/solver.h"

namespace ripstop {
namespace {

using std::numbers::pi;

CartesianSettings with_threads(int threads) {
  CartesianSettings settings;
  settings.threads = threads;
  return settings;
}

/// A disk in a box with graded cells; `linear` is the law of its cloth [Pa s/m].
FlowProblem disk_in_a_box(double linear, Sides sides) {
  FlowProblem problem;
  problem.grid = graded({{-2, -2, 0}, {4, 4, 6}, 20, 20, 26}, {-0.7, -0.7, 2}, {0.7, 0.7, 3.5}, 1.2);
  problem.air.speed = 10;
  problem.sides = sides;
  problem.outlet = Outlet::still_air;
  problem.sheets = {{disk(1, {0.01, 0.02, 2.52}), linear, 0}};
  return problem;
}

bool same_bits(const FlowField& a, const FlowField& b) {
  return std::memcmp(a.pressure.data(), b.pressure.data(), a.pressure.size() * sizeof(double)) == 0 &&
         std::memcmp(a.velocity.data(), b.velocity.data(), a.velocity.size() * sizeof(Vec3)) == 0 &&
         a.porous_force == b.porous_force;
}

TEST(March, AUniformStreamStaysUniform) {
  FlowProblem problem = disk_in_a_box(0, Sides::entraining);
  problem.sheets.clear();
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  flow->march(20, 0.7);
  const FlowField field = flow->field();
  for (const Vec3& u : field.velocity) ASSERT_NEAR(norm(u - Vec3{0, 0, 10}), 0, 1e-11);
  for (const double p : field.pressure) ASSERT_NEAR(p, 0, 1e-9);
}

class Ledger : public testing::TestWithParam<std::tuple<double, Sides>> {};

// In the first steps the pressure has to find its way about a body that stands in the stream at once.
TEST_P(Ledger, ClosesInEveryStep) {
  const auto [linear, sides] = GetParam();
  const FlowProblem problem = disk_in_a_box(linear, sides);
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  const double largest = 0.5 * 1.2 * 100 * pi / 4;  // q times the disk's area [N]
  int steps = 0;
  flow->march(60, 0.7, [&](const FlowStep& step) {
    EXPECT_NEAR(step.momentum_gap, 0, 1e-8 * largest) << "step " << step.step;
    EXPECT_LE(step.courant, 0.7 * 1.05) << "step " << step.step;
    if (step.step > 5) {
      EXPECT_LT(step.mass_defect, 1e-3) << "step " << step.step;
    }
    return ++steps < 60;
  });
  EXPECT_EQ(steps, 60);
  EXPECT_GT(flow->field().porous_force.z, 0.2 * largest);
}

INSTANTIATE_TEST_SUITE_P(LooseAndTight, Ledger,
                         testing::Combine(testing::Values(10.0, 1e6),
                                          testing::Values(Sides::slip, Sides::entraining)));

TEST(March, ThreadsDoNotMatterToTheLastBit) {
  const FlowProblem problem = disk_in_a_box(1e6, Sides::entraining);
  const auto marched = [&](int threads) {
    const auto engine = make_cartesian(with_threads(threads));
    const auto flow = engine->start(problem);
    flow->march(8, 0.7);
    return flow->field();
  };
  const FlowField one = marched(1);
  EXPECT_TRUE(same_bits(one, marched(2)));
  EXPECT_TRUE(same_bits(one, marched(4)));
}

TEST(March, WhatWasSavedGoesOnToTheLastBit) {
  const FlowProblem problem = disk_in_a_box(10, Sides::entraining);
  const auto folder = std::filesystem::path(testing::TempDir()) / "march state";
  const auto engine = make_cartesian(with_threads(1));
  for (const int saved_after : {1, 2, 7}) {
    const auto unbroken = engine->start(problem), resumed = engine->start(problem);
    unbroken->advance(3, 1e-9);
    unbroken->march(saved_after, 0.7);
    unbroken->save(folder);
    resumed->march(2, 0.5);  // what it did before does not matter
    resumed->restore(folder);
    const FlowStep a = unbroken->march(5, 0.7), b = resumed->march(5, 0.7);
    EXPECT_EQ(a.step, saved_after + 5);
    EXPECT_EQ(a.time, b.time);
    EXPECT_TRUE(same_bits(unbroken->field(), resumed->field())) << saved_after;
  }
  std::filesystem::remove_all(folder);
}

TEST(March, RefusesAStepThatCannotBe) {
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(disk_in_a_box(10, Sides::slip));
  EXPECT_THROW(flow->march(0, 0.7), Error);
  EXPECT_THROW(flow->march(1, 0), Error);
  EXPECT_THROW(flow->march(1, 1.5), Error);
}

/// Taylor's vortices between slip walls, u = sin kx cos ky, v = -cos kx sin ky with k = pi/m, which decay with
/// exp(-2 nu k^2 t) and are carried along by a slow stream. What inlet and outlet make of them dies out within
/// a width of the box.
class Vortices {
 public:
  explicit Vortices(int across) : problem_(of(across)) {
    auto& s = solver_.state();
    const auto& d = solver_.discretisation();
    for (int k = 0; k < d.grid.nz; ++k) {
      for (int j = 0; j < d.grid.ny; ++j) {
        for (int i = 0; i < d.grid.nx; ++i) {
          const std::ptrdiff_t at = d.layout.at(i, j, k);
          const Vec3 u = exact(d.grid.centre(i, j, k), 0);
          s.f.u[at] = u.x, s.f.v[at] = u.y;
          const double h = 0.5 / across, x = d.grid.centre(0, i), y = d.grid.centre(1, j);
          s.f.fx[at] = 0.3 * density * std::sin(pi * (x - h)) * std::cos(pi * y);
          s.f.fy[at] = -0.3 * density * std::cos(pi * x) * std::sin(pi * (y - h));
        }
      }
      cartesian::side_ghosts(d, s.f.u, k, -1, 1), cartesian::side_ghosts(d, s.f.v, k, 1, -1);
    }
  }

  FlowStep step(double courant) { return solver_.step(courant); }

  /// Root mean square in the middle plane.
  double error(double time) const {
    const auto& [d, f] = std::tie(solver_.discretisation(), solver_.state().f);
    const FlowGrid& grid = d.grid;
    double sum = 0;
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        const std::ptrdiff_t at = d.layout.at(i, j, grid.nz / 2);
        const Vec3 off = Vec3{f.u[at], f.v[at], 0} - exact(grid.centre(i, j, 0), time);
        sum += dot(off, off);
      }
    }
    return std::sqrt(sum / (grid.nx * grid.ny));
  }

 private:
  static constexpr double density = 1.2, viscosity = 0.0012;
  static FlowProblem of(int across) {
    FlowProblem problem;
    problem.grid = {{0, 0, 0}, {1, 1, 6}, across, across, 3 * across};
    problem.air.speed = 1, problem.air.density = density, problem.air.viscosity = viscosity;
    problem.sides = Sides::slip;
    return problem;
  }
  static CartesianSettings resolved() {
    CartesianSettings settings = with_threads(1);
    settings.small_eddies = false;
    return settings;
  }
  static Vec3 exact(Vec3 at, double time) {
    const double amplitude = 0.3 * std::exp(-2 * viscosity / density * pi * pi * time);
    return {amplitude * std::sin(pi * at.x) * std::cos(pi * at.y),
            -amplitude * std::cos(pi * at.x) * std::sin(pi * at.y), 0};
  }

  FlowProblem problem_;
  ThreadTeam team_{1};
  cartesian::Solver solver_{problem_, problem_.grid, cartesian::PorousRows(problem_.grid, {}, viscosity),
                            resolved(), team_};
};

TEST(March, TaylorsVorticesDecayWithErrorsOfSecondOrderInSpaceAndTime) {
  std::vector<double> errors;
  for (const int across : {8, 16, 32}) {
    Vortices vortices(across);
    FlowStep step;
    while (step.time < 1) step = vortices.step(0.5);
    errors.push_back(vortices.error(step.time));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << " " << errors[1];
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8) << errors[1] << " " << errors[2];
}

}  // namespace
}  // namespace ripstop
