// Steps in time: conservation, order, and independence of everything but the present flow.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/cartesian/solver.h"
#include "ripstop/flow/cartesian/time_rows.h"
#include "tests/flow/cartesian/equal_runs.h"

namespace ripstop {
namespace {

using std::numbers::pi;

/// A disk in a box with graded cells; `linear` is the law of its cloth [Pa s/m].
FlowProblem disk_in_a_box(double linear, Sides sides) {
  FlowProblem problem;
  problem.grid = graded({{-2, -2, 0}, {4, 4, 6}, 20, 20, 26}, {-0.7, -0.7, 2}, {0.7, 0.7, 3.5}, 1.2);
  problem.air.velocity = {0, 0, 10};
  problem.sides = sides;
  problem.outlet = Outlet::still_air;
  problem.bodies = {sheet_body(disk(1, {0.01, 0.02, 2.52}), {linear, 0})};
  return problem;
}

TEST(March, AUniformStreamStaysUniform) {
  FlowProblem problem = disk_in_a_box(0, Sides::entraining);
  problem.bodies.clear();
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  flow->march(20, 0.7);
  const FlowField field = flow->field();
  for (const Vec3& u : field.velocity) ASSERT_NEAR(norm(u - Vec3{0, 0, 10}), 0, 1e-11);
  for (const double p : field.pressure) ASSERT_NEAR(p, 0, 1e-9);
}

// In a box that goes with something that is slowed down, unevenly.
TEST(March, AStreamThatIsSlowedDownStaysUniform) {
  FlowProblem problem = disk_in_a_box(0, Sides::entraining);
  problem.bodies.clear();
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  double speed = 10;
  for (int n = 0; n < 20; ++n) {
    const double slowed = -30 * (1 + n % 3), length = 1e-3 * (1 + n % 2);
    speed += slowed * length;
    flow->stream({0, 0, speed}, {0, 0, slowed});
    EXPECT_NEAR(flow->step(length).momentum_gap.z, 0, 1e-8);
  }
  const FlowField field = flow->field();
  for (const Vec3& u : field.velocity) ASSERT_NEAR(norm(u - Vec3{0, 0, speed}), 0, 1e-10);
  for (const double p : field.pressure) ASSERT_NEAR(p, 0, 1e-8);
}

class Ledger : public testing::TestWithParam<std::tuple<double, Sides, SmallEddies>> {};

// In the first steps the pressure has to adjust to a body that is suddenly in the stream.
TEST_P(Ledger, ClosesInEveryStep) {
  const auto [linear, sides, eddies] = GetParam();
  const FlowProblem problem = disk_in_a_box(linear, sides);
  const auto engine = make_cartesian(with_threads(1, eddies));
  const auto flow = engine->start(problem);
  const double largest = 0.5 * 1.2 * 100 * pi / 4;  // q times the disk's area [N]
  int steps = 0;
  flow->march(60, 0.7, [&](const FlowStep& step) {
    EXPECT_NEAR(step.momentum_gap.z, 0, 1e-8 * largest) << "step " << step.step;
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
                                          testing::Values(Sides::slip, Sides::entraining),
                                          testing::Values(SmallEddies::wale, SmallEddies::des)));

class MarchWith : public testing::TestWithParam<SmallEddies> {};
INSTANTIATE_TEST_SUITE_P(Eddies, MarchWith, testing::Values(SmallEddies::wale, SmallEddies::des),
                         [](const auto& eddies) {
                           return std::string(eddies.param == SmallEddies::des ? "des" : "wale");
                         });

// Air without porous cells has kernels of its own; steps of other lengths and iterations between them do not matter.
TEST_P(MarchWith, PorousCellsWithoutResistanceAreNotThere) {
  const auto marched = [&](bool porous) {
    FlowProblem problem = disk_in_a_box(1e4, Sides::entraining);
    if (porous) problem.bodies.push_back(porous_body({{problem.grid.index(3, 4, 5)}, 0, 0}, "porous cell"));
    const auto engine = make_cartesian(with_threads(1, GetParam()));
    const auto flow = engine->start(problem);
    flow->march(3, 0.7);
    const double length = 0.5 * flow->longest_step(0.7);
    flow->step(length);
    flow->advance(2, 1e-9);
    flow->step(length);
    flow->march(3, 0.7);
    return flow->field();
  };
  const FlowField with = marched(true), without = marched(false);
  for (std::size_t c = 0; c < with.velocity.size(); ++c) {
    ASSERT_NEAR(norm(with.velocity[c] - without.velocity[c]), 0, 1e-6 * 10);
    ASSERT_NEAR(with.pressure[c], without.pressure[c], 1e-6 * 60);
  }
}

TEST_P(MarchWith, ThreadsDoNotMatterToTheLastBit) {
  const FlowProblem problem = disk_in_a_box(1e6, Sides::entraining);
  const auto marched = [&](int threads) {
    const auto engine = make_cartesian(with_threads(threads, GetParam()));
    const auto flow = engine->start(problem);
    flow->march(8, 0.7);
    return flow->field();
  };
  const FlowField one = marched(1);
  EXPECT_TRUE(same_bits(one, marched(2)));
  EXPECT_TRUE(same_bits(one, marched(4)));
}

TEST_P(MarchWith, ASavedFlowContinuesToTheLastBit) {
  const FlowProblem problem = disk_in_a_box(10, Sides::entraining);
  const TemporaryFolder folder("march state");
  const auto engine = make_cartesian(with_threads(1, GetParam()));
  for (const int saved_after : {1, 2, 7}) {
    const auto unbroken = engine->start(problem), resumed = engine->start(problem);
    unbroken->advance(3, 1e-9);
    unbroken->march(saved_after, 0.7);
    unbroken->save(folder.path);
    resumed->march(2, 0.5);  // independent of its history
    resumed->restore(folder.path);
    const FlowStep a = unbroken->march(5, 0.7), b = resumed->march(5, 0.7);
    EXPECT_EQ(a.step, saved_after + 5);
    EXPECT_EQ(a.time, b.time);
    EXPECT_TRUE(same_bits(unbroken->field(), resumed->field())) << saved_after;
  }
}

TEST(March, AfterIterationsItBeginsAnew) {
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(disk_in_a_box(10, Sides::entraining));
  EXPECT_EQ(flow->march(3, 0.7).step, 3);
  flow->advance(1, 1e-9);
  const FlowStep first = flow->march(1, 0.7);
  EXPECT_EQ(first.step, 1);
  EXPECT_EQ(first.time, first.length);
}

TEST(March, RefusesAStepThatCannotBe) {
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(disk_in_a_box(10, Sides::slip));
  EXPECT_THROW(flow->march(0, 0.7), Error);
  EXPECT_THROW(flow->march(1, 0), Error);
  EXPECT_THROW(flow->march(1, 1.5), Error);
}

/// Taylor's vortices between slip walls, u = sin kx cos ky, v = -cos kx sin ky with k = pi/m, which decay with exp(-2
/// nu k^2 t) and are carried along by a slow stream. Disturbances of inlet and outlet decay within one width of the
/// box.
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
      cartesian::side_ghosts(d, s.f.u, k, 0, -1), cartesian::side_ghosts(d, s.f.v, k, 1, -1);
    }
  }

  FlowStep step(double courant) { return solver_.step(solver_.next_step(courant)); }

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
    problem.air.velocity = {0, 0, 1}, problem.air.density = density, problem.air.viscosity = viscosity;
    problem.sides = Sides::slip;
    return problem;
  }
  static CartesianSettings resolved() { return with_threads(1, SmallEddies::none); }
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

TEST(March, AStepIsNoLongerThanViscosityAllows) {
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {1, 2, 4}, 8, 8, 8};
  problem.air.velocity = {0, 0, 1}, problem.air.density = 1.2;
  problem.sides = Sides::slip;
  for (const double viscosity : {1.8e-5, 50.0}) {
    problem.air.viscosity = viscosity;
    const auto flow = make_cartesian(with_threads(1, SmallEddies::none))->start(problem);
    const double by_viscosity = 0.2 * 1.2 / viscosity / (8 * 8 + 4 * 4 + 2 * 2);
    EXPECT_NEAR(flow->longest_step(0.5) / std::min(0.25, by_viscosity), 1, 1e-9) << viscosity;
  }
}

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

/// The same vortices lying across the stream, which carries them along: u = A sin kx cos k(z - Wt), and along z
/// W - A cos kx sin k(z - Wt). Between slip walls, far from inlet and outlet.
class CarriedVortices {
 public:
  explicit CarriedVortices(int across, SmallEddies small_eddies = SmallEddies::none)
      : problem_(of(across)),
        solver_(problem_, problem_.grid, cartesian::PorousRows(problem_.grid, {}, viscosity),
                with_threads(1, small_eddies), team_) {
    auto& s = solver_.state();
    const auto& d = solver_.discretisation();
    const double h = 0.5 / across;
    for (int k = 0; k < d.grid.nz; ++k) {
      for (int j = 0; j < d.grid.ny; ++j) {
        for (int i = 0; i < d.grid.nx; ++i) {
          const std::ptrdiff_t at = d.layout.at(i, j, k);
          const Vec3 centre = d.grid.centre(i, j, k), u = exact(centre, 0);
          s.f.u[at] = u.x, s.f.w[at] = u.z;
          s.f.fx[at] = density * exact(centre - Vec3{h, 0, 0}, 0).x;
          if (k > 0) s.f.fz[at] = density * exact(centre - Vec3{0, 0, h}, 0).z;
        }
      }
      cartesian::side_ghosts(d, s.f.u, k, 0, -1), cartesian::side_ghosts(d, s.f.w, k);
    }
  }

  FlowStep to(double time, double courant) {
    FlowStep step;
    while (step.time < time) step = solver_.step(solver_.next_step(courant));
    return step;
  }

  /// Root mean squares of the difference from the exact flow, and of the vortices themselves, in the middle.
  std::pair<double, double> error_and_size(double time) const {
    const auto& [d, f] = std::tie(solver_.discretisation(), solver_.state().f);
    double error = 0, size = 0;
    int count = 0;
    for (int k = 0; k < d.grid.nz; ++k) {
      if (std::abs(d.grid.centre(2, k) - 5) > 0.5) continue;
      for (int i = 0; i < d.grid.nx; ++i, ++count) {
        const std::ptrdiff_t at = d.layout.at(i, 1, k);
        const Vec3 found{f.u[at], 0, f.w[at]}, off = found - exact(d.grid.centre(i, 1, k), time);
        error += dot(off, off);
        size += dot(found - Vec3{0, 0, speed}, found - Vec3{0, 0, speed});
      }
    }
    return {std::sqrt(error / count), std::sqrt(size / count)};
  }

 private:
  static constexpr double density = 1.2, viscosity = 1.2e-5, speed = 1;
  static FlowProblem of(int across) {
    FlowProblem problem;
    problem.grid = {{0, 0, 0}, {1, 4.0 / across, 8}, across, 4, 8 * across};
    problem.air.velocity = {0, 0, speed}, problem.air.density = density, problem.air.viscosity = viscosity;
    problem.sides = Sides::slip;
    return problem;
  }
  static Vec3 exact(Vec3 at, double time) {
    const double z = at.z - speed * time;
    return {0.2 * std::sin(pi * at.x) * std::cos(pi * z), 0,
            speed - 0.2 * std::cos(pi * at.x) * std::sin(pi * z)};
  }

  FlowProblem problem_;
  ThreadTeam team_{1};
  cartesian::Solver solver_;
};

// Steps of first order would let them grow by W^2 k^2 dt / 2.
TEST(March, VorticesThatTheStreamCarriesKeepTheirSizeAndPlaceWithErrorsOfSecondOrder) {
  std::vector<double> errors;
  for (const int across : {12, 24, 48}) {
    CarriedVortices vortices(across);
    errors.push_back(vortices.error_and_size(vortices.to(1, 0.6).time).first);
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << errors[0] << " " << errors[1];
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8) << errors[1] << " " << errors[2];
}

TEST(March, EddiesThatAreNotResolvedTakeFromThoseThatAre) {
  const auto left = [](SmallEddies small_eddies) {
    CarriedVortices vortices(8, small_eddies);
    return vortices.error_and_size(vortices.to(1, 0.6).time).second;
  };
  EXPECT_LT(left(SmallEddies::wale) / left(SmallEddies::none), 0.999);
}

/// Turbulence in a uniform stream, which the air carries along and nothing feeds.
class DecayingTurbulence {
 public:
  explicit DecayingTurbulence(double start_k) {
    auto& s = solver_.state();
    solver_.begin_time();
    std::fill(s.f.k.begin(), s.f.k.end(), start_k),
        std::fill(s.f.omega.begin(), s.f.omega.end(), start_omega);
  }
  std::pair<double, double> after(double time, int steps) {
    for (int n = 0; n < steps; ++n) solver_.step(time / steps);
    const std::ptrdiff_t at = solver_.discretisation().layout.at(3, 4, 21);
    return {solver_.state().f.k[at], solver_.state().f.omega[at]};
  }
  /// dk/dt = -b* k max(omega, root k / (b* C D)), d omega/dt = -b omega^2, by steps of a thousandth of the others'.
  static std::pair<double, double> exact(double start_k, double time) {
    constexpr int steps = 1000000;
    const double dt = time / steps;
    double k = start_k, omega = start_omega;
    for (int n = 0; n < steps; ++n) {
      k -= dt * 0.09 * k * std::max(omega, std::sqrt(k) / (0.09 * 0.61 * width));
      omega -= dt * 0.0828 * omega * omega;
    }
    return {k, omega};
  }

 private:
  static constexpr double start_omega = 4, width = 0.25;  // the widest side of a cell, along z
  static FlowProblem of() {
    FlowProblem problem;
    problem.grid = {{0, 0, 0}, {1, 1, 6}, 8, 8, 24};
    problem.air.velocity = {0, 0, 1};
    problem.sides = Sides::slip;
    return problem;
  }
  FlowProblem problem_ = of();
  ThreadTeam team_{1};
  cartesian::Solver solver_{problem_, problem_.grid,
                            cartesian::PorousRows(problem_.grid, {}, problem_.air.viscosity),
                            with_threads(1, SmallEddies::des), team_};
};

TEST(March, BeginsWithoutTheEddiesThatItsCellsResolve) {
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {1, 1, 6}, 8, 8, 24};
  problem.air.velocity = {0, 0, 1};
  problem.sides = Sides::slip;
  ThreadTeam team(1);
  cartesian::Solver solver(problem, problem.grid,
                           cartesian::PorousRows(problem.grid, {}, problem.air.viscosity),
                           with_threads(1, SmallEddies::des), team);
  auto& s = solver.state();
  const std::ptrdiff_t large = solver.discretisation().layout.at(3, 4, 5), small = large + 1;
  s.f.omega[large] = s.f.omega[small] = 4;
  s.f.k[large] = 1, s.f.k[small] = 1e-6;
  solver.begin_time();
  EXPECT_NEAR(std::sqrt(s.f.k[large]) / (0.09 * 4), 0.61 * 0.25, 1e-12)
      << "as long as 0.61 of the widest side";
  EXPECT_EQ(s.f.k[small], 1e-6);
}

// As fast as cells resolve them where they are larger than those, else by themselves.
TEST(March, ModelledEddiesDecayByTheEquationsOfTheModel) {
  const double time = 2;
  for (const double start_k : {0.05, 5e-4}) {
    const auto [k, omega] = DecayingTurbulence::exact(start_k, time);
    std::vector<double> errors;
    for (const int steps : {100, 200, 400}) {
      const auto [found_k, found_omega] = DecayingTurbulence(start_k).after(time, steps);
      EXPECT_NEAR(found_omega, omega, 0.02 * omega);
      errors.push_back(std::abs(found_k / k - 1));
    }
    EXPECT_LT(errors.back(), 0.01) << start_k;
    EXPECT_NEAR(errors[0] / errors[1], 2, 0.2) << start_k;
    EXPECT_NEAR(errors[1] / errors[2], 2, 0.2) << start_k;
  }
}

TEST(PassingRow, ThroughTheBoundaryTheAirCarriesItsUpstreamValue) {
  const double u[] = {1, 2, 3}, v[] = {4, 5, 6}, w[] = {7, 8, 9}, flux[] = {10, -10};
  double pu[2], pv[2], pw[2];
  cartesian::PassingRow r;
  r.count = 2, r.step = 1, r.flux = flux;
  r.velocity = {u + 1, v + 1, w + 1}, r.passing = {pu, pv, pw};
  boundary_passing_row(r);
  const double low[] = {pu[0], pv[0], pw[0]}, high[] = {pu[1], pv[1], pw[1]};
  for (const int i : {0, 1, 2}) {
    EXPECT_EQ(low[i], 10 * (1 + 3 * i)) << i;
    EXPECT_EQ(high[i], -10 * (3 + 3 * i)) << i;
  }
}

// Linear fields on unequal cells have the same gradient everywhere.
TEST(EddyRow, HasTheViscosityOfWaleForPlaneStrainAndNoneForShear) {
  using namespace cartesian;
  const Axis x = make_axis({0, 0.1, 0.25, 0.45, 0.7}, End::zero_gradient, End::zero_gradient);
  const Layout layout(4, 2, 2);
  const auto viscosity = [&](Vec3 gu, Vec3 gv) {
    Array<double> u(layout.values()), v(layout.values()), w(layout.values()), mu(layout.values()),
        t(3 * layout.values());
    const double at_x[] = {-0.05, 0.05, 0.175, 0.35, 0.575, 0.825};
    for (int k = -1; k < 3; ++k) {
      for (int j = -1; j < 3; ++j) {
        for (int i = -1; i < 5; ++i) {
          const Vec3 p{at_x[i + 1], 0.1 * j, 0.1 * k};
          u[layout.at(i, j, k)] = dot(gu, p), v[layout.at(i, j, k)] = dot(gv, p);
        }
      }
    }
    const Axis across = make_axis({0, 0.1, 0.2}, End::zero_gradient, End::zero_gradient);
    const std::vector<double> along(4, 1.0);
    EddyRow r;
    r.m.n = 4, r.m.sy = layout.stride_y, r.m.sz = layout.stride_z;
    r.m.x_slope_low = x.slope_low.data(), r.m.x_slope_high = x.slope_high.data();
    r.m.y = r.m.z = cross_metrics(across, 0);
    const std::ptrdiff_t at = layout.at(0, 0, 0);
    r.viscosity = 2e-5, r.density = 1.2, r.along = along.data(), r.across = 0.01;
    r.velocity = {&u[at], &v[at], &w[at]}, r.mu = &mu[at];
    r.stress = {&t[at], &t[at], &t[at], static_cast<std::ptrdiff_t>(layout.values())};
    eddy_row(r);
    return mu[layout.at(1, 0, 0)];
  };
  EXPECT_NEAR(viscosity({0, 7, 0}, {}), 2e-5, 1e-12) << "plain shear";
  // g = diag(a, -a, 0): S:S = 2 a^2, Sd = a^2 diag(1, 1, -2) / 3, Sd:Sd = 2/3 a^4.
  const double a = 3, rate = a * std::pow(2.0 / 3, 1.5) / (std::pow(2.0, 2.5) + std::pow(2.0 / 3, 1.25));
  EXPECT_NEAR(viscosity({a, 0, 0}, {0, -a, 0}), 2e-5 + 1.2 * 0.01 * rate, 1e-9);
}

}  // namespace
}  // namespace ripstop
