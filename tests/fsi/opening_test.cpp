// The opening loop: exact cases, laws of momentum and energy, symmetry, restart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../diverges.h"
#include "../printed_materials.h"
#include "ripstop/core/error.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/fsi/coupled_opening.h"
#include "ripstop/fsi/pressure.h"
#include "ripstop/fsi/uniform_pressure_opening.h"
#include "ripstop/parachute/build.h"
#include "ripstop/parachute/disk_gap_band.h"
#include "ripstop/run/opening/inflation_folder.h"

namespace ripstop {
namespace {

CanopyMesh small_canopy(int nodes = 1200) {
  Design design = printed_stratos(nodes);
  design.canopy = DiskGapBand{1.0, 0.2, 0.07, 0.3};
  design.lines.count = 6;
  design.mesh.line_segment_m = 0.15;
  design.mesh.folds = 6;
  return build_mesh(design, printed_materials());
}

InflationProblem small_problem(double pressure, double duration) {
  InflationProblem problem{small_canopy(), {}, pressure, false, 2};
  problem.settings.initial_radius_m = 0.2;
  problem.settings.duration_s = duration;
  problem.settings.frames = 10;
  problem.symmetry = 6;
  return problem;
}

std::vector<HistoryRow> run(Opening& solver, InflationState& state) {
  std::vector<HistoryRow> rows;
  while (state.blocks < solver.blocks()) {
    const auto block = solver.advance(state);
    rows.insert(rows.end(), block.begin(), block.end());
  }
  return rows;
}

TEST(Inflation, TheFoldedStateAtRestStaysAtRest) {
  UniformPressureOpening solver(small_problem(0, 5e-3));
  InflationState state = solver.start();
  for (const HistoryRow& row : run(solver, state)) {
    EXPECT_LT(std::max(std::abs(row.largest), std::abs(row.least)), 1e-6);
  }
  const std::vector<Vec3> x = positions(state.cloth, solver.cloth());
  double farthest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    farthest = std::max(farthest, norm(x[i] - solver.folded().positions[i]));
  EXPECT_LT(farthest, 1e-9);
}

TEST(Inflation, ALossOfStabilityIsAnErrorThatNamesTimeAndNode) {
  UniformPressureOpening solver(small_problem(500, 5e-3));
  InflationState begun = solver.start();
  solver.advance(begun);
  for (const double bad : {double(NAN), double(INFINITY)}) {
    InflationState state = begun;
    state.cloth.x[state.cloth.x.size() / 2] = bad;
    EXPECT_TRUE(says(divergence([&] { solver.advance(state); }), "has no finite position")) << bad;
    state = begun;
    state.cloth.v[state.cloth.v.size() / 2] = bad;
    EXPECT_TRUE(says(divergence([&] { solver.advance(state); }), "t = ")) << bad;
  }
  for (const double step : {0.0, -1e-6, 1e-300, double(NAN)}) {
    InflationState state = begun;
    state.step = step;
    const std::string message = divergence([&] { solver.advance(state); });
    EXPECT_TRUE(says(message, "t = 0.00") && says(message, "steps of")) << step << ": " << message;
  }
}

TEST(Inflation, AStableStepBelowThatOfAnyWholeClothIsAnErrorThatNamesTheNode) {
  InflationProblem problem = small_problem(500, 5e-3);
  for (SpringLaw& law : problem.mesh.laws)
    for (double& coefficient : law.coefficients) coefficient *= 1e14;
  const UniformPressureOpening solver(problem);
  const std::string message = divergence([&] { solver.start(); });
  EXPECT_TRUE(says(message, "t = 0 s") && says(message, "at node ") &&
              says(message, "try a smaller time step"))
      << message;
}

// The air would flow by as if there were no canopy.
TEST(Inflation, AFoldedCanopyNarrowerThanTwoCellsOfTheAirIsRefused) {
  InflationProblem problem = small_problem(0, 5e-3);  // 0.4 m wide
  problem.air.emplace();
  problem.air->engine = make_cartesian({});
  problem.air->flow.air.velocity = {0, 0, 20};
  problem.air->flow.bodies = {sheet_body({}, {1000, 0})};
  problem.air->flow.grid = {{-2, -2, -2}, {4, 4, 8}, 16, 16, 32};
  const std::string message = refusal_of([&] { CoupledOpening{problem}; }, ExitCode::usage);
  EXPECT_TRUE(says(message, "0.4 m wide, 1.6 cells of the flow grid")) << message;
  EXPECT_TRUE(says(message, "radius of the folded skirt of at least 0.25 m")) << message;
  problem.air->flow.grid = {{-2, -2, -2}, {4, 4, 8}, 24, 24, 48};
  EXPECT_NO_THROW(CoupledOpening{problem});
}

// A block may end by rounding before the instant that it represents.
TEST(Inflation, EveryInstantIsShownOnceAndWithoutAnyEightAreChosen) {
  InflationProblem problem = small_problem(0, 6e-3);
  UniformPressureOpening measured(problem);
  InflationState first = measured.start();
  measured.advance(first);
  problem.settings.sheet_s = {0, first.cloth.time * (1 + 1e-13), first.cloth.time * (2 + 1e-13)};
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  run(solver, state);
  EXPECT_EQ(state.snapshots.size(), 3u);
  EXPECT_EQ(measured.problem().settings.sheet_s.size(), 8u);
  EXPECT_DOUBLE_EQ(measured.problem().settings.sheet_s.back(), 0.1);
}

TEST(Inflation, ClothDoesNotPassThroughClothUnlessItIsAskedTo) {
  double pierced[2], depth[2];
  for (const bool contact : {false, true}) {
    InflationProblem problem = small_problem(500, 0.03);
    if (!contact) problem.settings.contact_pa = 0;
    UniformPressureOpening solver(problem);
    InflationState state = solver.start();
    pierced[contact] = depth[contact] = 0;
    while (state.blocks < solver.blocks()) {
      solver.advance(state);
      const InflationFrame frame = solver.frame(state);
      pierced[contact] = std::max(pierced[contact], frame.pierced);
      depth[contact] = std::max(depth[contact], frame.contact_depth);
    }
  }
  EXPECT_GT(pierced[false], 0.05);
  EXPECT_LT(pierced[true], 0.5 * pierced[false]) << "at folds that began nearer to each other, layers pass";
  EXPECT_EQ(depth[false], 0);
  EXPECT_GT(depth[true], 0.01);
  EXPECT_LT(depth[true], 0.8);
}

TEST(Inflation, TheImpulseOnTheRiserIsThatOfThePressureLessTheMomentum) {
  InflationProblem problem = small_problem(500, 0.01);
  problem.settings.damping_n_s_m3 = 0;
  problem.settings.frames = 50;  // short blocks, for the trapezoid
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  double pushed = 0;
  const Loads loads{std::vector<double>(solver.mesh().cell_count(), 500.0), {}};
  while (state.blocks < solver.blocks()) {
    const double before = pressure_force(solver.cloth(), state.cloth, loads).z, begin = state.cloth.time;
    solver.advance(state);
    pushed +=
        0.5 * (before + pressure_force(solver.cloth(), state.cloth, loads).z) * (state.cloth.time - begin);
  }
  EXPECT_NEAR((pushed - momentum(solver.cloth(), state.cloth).z) / pushed, state.impulse / pushed, 0.01);
}

TEST(Inflation, TheWorkOfThePressureIsAccountedForWithinOnePercent) {
  InflationProblem problem = small_problem(500, 0.03);
  problem.settings.quadratic_damping_n_s2_m4 = 0.05;
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  run(solver, state);
  const InflationFrame frame = solver.frame(state);
  EXPECT_GT(frame.pressure_work, 20);
  EXPECT_GT(frame.damped, 0.2 * frame.pressure_work);
  EXPECT_LT(std::abs(frame.residual), 0.01);
}

TEST(Inflation, TheDampersOfTheClothAreInTheBalance) {
  InflationProblem problem = small_problem(500, 0.02);
  problem.settings.cloth_damping_s = 1e-5;
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  run(solver, state);
  EXPECT_LT(std::abs(solver.frame(state).residual), 0.01);
}

TEST(Inflation, TheDampersOfTheClothTakeLittleFromTheStep) {
  InflationProblem problem = small_problem(500, 0.02);
  const auto stable_step = [&](double damping) {
    problem.settings.cloth_damping_s = damping;
    UniformPressureOpening solver(problem);
    InflationState state = solver.start();
    const bool limited = solver.viscosity_limit().least_share < 1;
    EXPECT_EQ(limited, damping > 0);
    return solver.frame(state).stable_step;
  };
  const double without = stable_step(0);
  // The canopy's own damping takes a thousandth more.
  EXPECT_GT(stable_step(1e-4) / without, 0.995 * problem.settings.cloth_damping_step_share);
}

TEST(Inflation, ASymmetricStartOpensSymmetrically) {
  UniformPressureOpening solver(small_problem(500, 0.02));
  InflationState state = solver.start();
  EXPECT_LT(solver.frame(state).asymmetry, 1e-14);
  run(solver, state);
  const InflationFrame open = solver.frame(state);
  EXPECT_GT(open.size.skirt_diameter, 0.6);
  EXPECT_LT(open.asymmetry, 1e-10);
}

TEST(Inflation, TheStrainOfAnImperfectionIsInTheBalance) {
  InflationProblem problem = small_problem(500, 0.02);
  problem.settings.imperfection_m = 5e-3;
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  EXPECT_GT(solver.frame(state).elastic, 0.1);  // [J] of some 20 that the pressure does
  run(solver, state);
  EXPECT_LT(std::abs(solver.frame(state).residual), 0.01);
}

TEST(Inflation, AnImperfectionOfOneWaveEqualsTheMeasuredAsymmetry) {
  InflationProblem problem = small_problem(500, 5e-3);
  problem.settings.imperfection_m = 1e-5;
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  // cos(azimuth) against its like a sixth of a turn on: at most 2 sin(30 degrees) = 1 times the amplitude.
  const double at_start = solver.frame(state).asymmetry;
  EXPECT_GT(at_start, 0.8e-5);
  EXPECT_LT(at_start, 1.001e-5);
  run(solver, state);
  EXPECT_LT(solver.frame(state).asymmetry, 1e-3);
  problem.settings.imperfection_harmonic = 6;  // a wave a gore keeps the symmetry
  UniformPressureOpening even(problem);
  InflationState kept = even.start();
  EXPECT_LT(even.frame(kept).asymmetry, 1e-14);
}

// The asymmetry is rounding error that grows like any other disturbance: a hundred times the
// imperfection is a hundred times the asymmetry for as long as it is small.
TEST(Inflation, AnAsymmetryGrowsInProportionToTheImperfectionItCameFrom) {
  const auto asymmetry_after = [](double imperfection) {
    InflationProblem problem = small_problem(500, 0.02);
    problem.settings.cloth_damping_s = 1e-5;
    problem.settings.imperfection_m = imperfection;
    UniformPressureOpening solver(problem);
    InflationState state = solver.start();
    run(solver, state);
    return solver.frame(state).asymmetry;
  };
  const double small = asymmetry_after(1e-10), hundredfold = asymmetry_after(1e-8);
  EXPECT_NEAR(hundredfold / small, 100, 1);
  EXPECT_GT(small, 1e-10);                      // it has grown
  EXPECT_LT(asymmetry_after(0), 0.01 * small);  // rounding starts near 1e-16 m
}

TEST(Inflation, AStoppedRunResumesToTheLastBit) {
  const InflationProblem problem = small_problem(500, 6e-3);
  UniformPressureOpening whole(problem), first(problem), second(problem);
  InflationState undisturbed = whole.start();
  const std::vector<HistoryRow> expected = run(whole, undisturbed);
  InflationState stopped = first.start();
  std::vector<HistoryRow> rows;
  while (stopped.blocks < first.blocks() / 2) {
    const auto block = first.advance(stopped);
    rows.insert(rows.end(), block.begin(), block.end());
  }
  InflationState resumed = inflation_state_from_bytes(to_bytes(stopped));
  const auto rest = run(second, resumed);
  rows.insert(rows.end(), rest.begin(), rest.end());
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].mean, expected[i].mean);
    EXPECT_EQ(rows[i].largest, expected[i].largest);
  }
  EXPECT_EQ(resumed.cloth.x, undisturbed.cloth.x);
  EXPECT_EQ(resumed.record.damped, undisturbed.record.damped);
  EXPECT_EQ(resumed.peak_load, undisturbed.peak_load);
  EXPECT_THROW(inflation_state_from_bytes("nonsense"), Error);
}

TEST(Inflation, ThePeakIsThatOfEveryStepHoweverFewRowsAreWritten) {
  InflationProblem fine = small_problem(500, 4e-3);
  fine.settings.frames = 1;
  fine.settings.history_hz = 10000;
  InflationProblem coarse = fine;
  coarse.settings.history_hz = 500;
  UniformPressureOpening a(fine), b(coarse);
  InflationState s = a.start(), t = b.start();
  const auto many = run(a, s), few = run(b, t);
  EXPECT_GE(many.size(), 10 * few.size());
  double highest = 0;
  for (const HistoryRow& row : few) highest = std::max(highest, row.largest);
  EXPECT_EQ(highest, t.peak_load);
  EXPECT_NEAR(t.peak_load / s.peak_load, 1, 0.01);  // the step differs a little so that rows are complete
}

TEST(Inflation, TheStepNeverExceedsTheStableOne) {
  InflationProblem problem = small_problem(3000, 0.01);
  problem.settings.step_fraction = 0.98;
  UniformPressureOpening solver(problem);
  InflationState state = solver.start();
  while (state.blocks < solver.blocks()) {
    solver.advance(state);
    EXPECT_LE(state.step, stability_limit(solver.cloth(), state.cloth).stable_step);
  }
}

TEST(Inflation, ARampedPressurePushesInProportionToTime) {
  // Before the cloth has moved, all it does is gain speed: v = dp t^2 / (2 ramp m_a) in place of dp t / m_a.
  const double t = 2e-4;
  const auto speed = [&](double ramp) {
    InflationProblem problem = small_problem(100, t);
    problem.settings.frames = 1;
    problem.settings.history_hz = 10 / t;
    problem.settings.damping_n_s_m3 = 0;
    problem.settings.ramp_s = ramp;
    UniformPressureOpening solver(problem);
    InflationState state = solver.start();
    run(solver, state);
    return std::sqrt(kinetic_energy(solver.cloth(), state.cloth));
  };
  EXPECT_NEAR(speed(t) / speed(0), 0.5, 0.02);
}

// A free sheet of mass m_a a unit area: with C_a it moves at v = dp / C_a (1 - exp(-C_a t / m_a)), with the
// quadratic term at v = sqrt(dp / C_q) tanh(sqrt(dp C_q) t / m_a).
TEST(Inflation, AFreeSheetReachesItsTerminalSpeed) {
  Mesh sheet;
  Patch patch;
  patch.rows = patch.columns = 9;
  const double h = 0.01, mass_per_area = 0.0407;
  for (int i = 0; i < 81; ++i) {
    sheet.start.push_back({h * (i % 9), h * (i / 9), 0});
    const int edges = (i % 9 == 0 || i % 9 == 8) + (i / 9 == 0 || i / 9 == 8);
    sheet.mass.push_back(mass_per_area * h * h * std::pow(0.5, edges));
  }
  for (int d = 0; d < direction_count; ++d) {
    patch.law[d] = {{1000}, 1};
    patch.rest_length[d].assign(81, 1.0);
    patch.width[d].assign(81, 0.0);
  }
  patch.cell_area.assign(72, 0.0);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) patch.cell_area[row * 9 + column] = h * h;
  }
  sheet.patches.push_back(patch);
  const double dp = 500, t = 5e-3, dt = 1e-6;
  ThreadTeam team(1);
  const auto speed_with = [&](double absolute, double quadratic) {
    const ClothPtr cloth = make_cloth(sheet, {false, absolute, quadratic});
    ClothState state = start_state(*cloth);
    step(state, *cloth, {std::vector<double>(72, dp), {}}, dt, static_cast<int>(t / dt + 0.5), team);
    return velocities(state, *cloth)[40].z;
  };
  EXPECT_NEAR(speed_with(8.2, 0) / (dp / 8.2 * (1 - std::exp(-8.2 * t / mass_per_area))), 1, 1e-3);
  EXPECT_NEAR(speed_with(0, 0.4) / (std::sqrt(dp / 0.4) * std::tanh(std::sqrt(dp * 0.4) * t / mass_per_area)),
              1, 1e-3);
}

TEST(UniformPressure, TheEquilibriumCarriesTheDragThatWasAskedFor) {
  ThreadTeam team(2);
  const CanopyMesh mesh = small_canopy(600);
  const UniformPressure found = pressure_for(300, mesh, false, team);
  EXPECT_NEAR(found.load, 300, 0.3);
  EXPECT_NEAR(found.pressure * found.axial_area, found.load, 1e-9);
  EXPECT_GT(found.axial_area, 0.4);  // a disk of 1 m has 0.785 m2, a canopy less
  EXPECT_LT(found.axial_area, 0.785);
}

TEST(UniformPressure, ALoadWithoutEquilibriumIsRefused) {
  ThreadTeam team(1);
  const CanopyMesh mesh = small_canopy(600);
  EXPECT_THROW(pressure_for(1e12, mesh, false, team), Error);
  EXPECT_THROW(pressure_for(0, mesh, false, team), Error);
}

}  // namespace
}  // namespace ripstop
