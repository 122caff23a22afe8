#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/bodies.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/steady.h"
#include "tests/flow/cartesian/equal_runs.h"

namespace ripstop {
namespace {

FlowProblem open_box(int nx, int ny, int nz, double speed) {
  FlowProblem problem;
  problem.grid = {{-1, -1, 0}, {2, 2, 4}, nx, ny, nz};
  problem.air.velocity = {0, 0, speed};
  problem.bodies.push_back(
      porous_body({cut_cells(problem.grid, rigid_disk_gap_band({0, 0, 2})), 65.98, 37.45}));
  return problem;
}

TEST(CartesianEngine, AnEmptyBoxKeepsItsUniformStream) {
  FlowProblem problem = open_box(12, 10, 16, 20);
  problem.bodies.clear();
  problem.stopping.max_iterations = 30;
  const FlowField field = solve(*make_cartesian(with_threads(1)), problem);
  for (const Vec3& u : field.velocity) EXPECT_NEAR(norm(u - Vec3{0, 0, 20}), 0, 1e-6);
  for (double p : field.pressure) EXPECT_NEAR(p, 0, 1e-4);
  EXPECT_EQ(field.porous_force, Vec3{});
}

// OpenFOAM's measure: |b - A x| over |A x - A X| + |b - A X|, with the mean of x as X. For uniform fields both are
// equal.
TEST(CartesianEngine, TheResidualOfUniformTurbulenceIsOne) {
  FlowProblem problem = open_box(8, 8, 12, 10);
  problem.bodies.clear();
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  const FlowProgress first = flow->advance(1, 0).last;
  EXPECT_NEAR(first.residual_k, 1, 1e-9);
  EXPECT_NEAR(first.residual_omega, 1, 1e-9);
  // It decays equally everywhere, except near the inlet.
  EXPECT_GT(flow->advance(1, 0).last.residual_k, 0.5);
}

TEST(CartesianEngine, TheResidualOfAUniformStreamThatMeetsAPlugIsOneHoweverWeak) {
  for (const double darcy : {1e6, 1e2}) {
    FlowProblem problem;
    problem.grid = {{0, 0, 0}, {1, 1, 2}, 4, 4, 16};
    problem.sides = Sides::slip;
    problem.air.velocity = {0, 0, 10};
    PorousCells plug;
    plug.darcy = darcy;
    for (int cell = 0; cell < problem.grid.cells(); ++cell)
      if (cell / 16 / 4 == 1) plug.cells.push_back(cell);
    problem.bodies.push_back(porous_body(plug));
    CartesianSettings settings = with_threads(1);
    settings.compressible = settings.grid_sequencing = false;
    EXPECT_NEAR(make_cartesian(settings)->start(problem)->advance(1, 0).last.residual_u, 1, 1e-3) << darcy;
  }
}

TEST(CartesianEngine, TheAnswerIsTheSameBitForBitOnOneTwoAndFourThreads) {
  FlowProblem problem = open_box(26, 23, 38, 10);  // large enough for grid sequencing
  problem.stopping.max_iterations = 12;
  const FlowField one = solve(*make_cartesian(with_threads(1)), problem);
  EXPECT_TRUE(same_bits(one, solve(*make_cartesian(with_threads(2)), problem)));
  EXPECT_TRUE(same_bits(one, solve(*make_cartesian(with_threads(4)), problem)));
}

struct Folder {
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("cartesian state " + std::to_string(getpid()));
  ~Folder() { std::filesystem::remove_all(path); }
};

/// A sheet, or cells that a canopy cuts, in a box.
FlowProblem either(bool sheet) {
  FlowProblem problem = open_box(16, 16, 24, 10);
  if (!sheet) return problem;
  problem.bodies.clear();
  problem.bodies = {sheet_body(rigid_disk_gap_band({0, 0, 2}), {66, 37.45})};
  problem.sides = Sides::entraining;
  problem.outlet = Outlet::still_air;
  return problem;
}

TEST(CartesianEngine, AFlowSavedAtAnyIterationContinuesBitForBit) {
  const Folder folder;
  for (const bool sheet : {false, true}) {
    for (const int saved_after : {1, 2, 7, 31}) {
      const FlowProblem problem = either(sheet);
      const auto one = make_cartesian(with_threads(1)), two = make_cartesian(with_threads(2));
      const auto unbroken = one->start(problem), resumed = two->start(problem);
      unbroken->advance(saved_after, 1e-9);
      unbroken->save(folder.path);
      resumed->restore(folder.path);
      EXPECT_TRUE(same_bits(resumed->field(), unbroken->field())) << saved_after;
      unbroken->advance(5, 1e-9), resumed->advance(5, 1e-9);
      EXPECT_TRUE(same_bits(resumed->field(), unbroken->field())) << saved_after;
      for (const auto& flow : {unbroken.get(), resumed.get()}) {  // the cloth moves on
        flow->place(0, rigid_disk_gap_band({0, 0, 2.03}));
        flow->advance(5, 1e-9);
      }
      EXPECT_TRUE(same_bits(resumed->field(), unbroken->field())) << saved_after;
    }
  }
}

/// In memory that held something else before.
std::string saved_from_memory_of(unsigned char byte) {
  alignas(FlowProblem) static unsigned char memory[sizeof(FlowProblem)];
  std::memset(memory, byte, sizeof memory);
  auto* problem = new (memory) FlowProblem;
  problem->grid = {{-1, -1, 0}, {2, 2, 4}, 16, 16, 24};
  problem->air.velocity = {0, 0, 10};
  const Folder folder;
  make_cartesian(with_threads(1))->start(*problem)->save(folder.path);
  problem->~FlowProblem();
  return read_file(folder.path / "cartesian.flow");
}

TEST(CartesianEngine, TheSameFlowMakesTheSameFile) {
  EXPECT_TRUE(saved_from_memory_of(0x00) == saved_from_memory_of(0xff));
}

TEST(CartesianEngine, AFlowInAnotherBoxOrADamagedFileIsRefused) {
  const Folder folder;
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(either(true));
  flow->advance(1, 1e-9);
  flow->save(folder.path);
  EXPECT_THROW(engine->start(either(false))->restore(folder.path), Error);
  FlowProblem longer = either(true);
  longer.grid.size.z = 5;
  EXPECT_THROW(engine->start(longer)->restore(folder.path), Error);
  const std::filesystem::path file = folder.path / "cartesian.flow";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(engine->start(either(true))->restore(folder.path), Error);
}

// The solution depends on the position of the cloth, not on its path.
TEST(CartesianEngine, AFlowWhoseClothMovedTendsToTheFlowThatBeganThere) {
  for (const bool sheet : {false, true}) {
    FlowProblem problem = either(sheet);
    const std::vector<Triangle> surface = rigid_disk_gap_band({0, 0, 2.1});
    const auto engine = make_cartesian(with_threads(1));
    const auto moved = engine->start(problem), began = engine->start(problem);
    began->place(0, surface);
    solve_to_rest(*moved, problem.stopping);
    moved->place(0, surface);
    const FlowField a = solve_to_rest(*moved, problem.stopping), b = solve_to_rest(*began, problem.stopping);
    ASSERT_TRUE(a.converged && b.converged);
    EXPECT_NEAR(a.porous_force.z / b.porous_force.z, 1, 2e-4);
    EXPECT_LT(a.last.iteration, b.last.iteration);
  }
}

TEST(CartesianEngine, TheForceOnTheCanopyIsTheMomentumThatTheBoxLoses) {
  const FlowField field = solve(*make_cartesian(with_threads(1)), open_box(20, 20, 32, 10));
  EXPECT_TRUE(field.converged);
  EXPECT_GT(field.porous_force.z, 10);
  EXPECT_NEAR(field.momentum_deficit.z / field.porous_force.z, 1, 0.002);  // the goal is 0.005
}

// Drop over a porous plug that fills a duct, over the law's: one-dimensional, nothing
// but the resistance acts.
double plug_drop(int cells) {
  FlowProblem problem;
  problem.grid = {{0, 0, 0}, {1, 1, 4}, 4, 4, cells};
  problem.sides = Sides::slip;
  problem.air.velocity = {0, 0, 10};
  PorousCells plug;
  plug.darcy = 1e5;
  plug.forchheimer = 20;
  for (int cell = 0; cell < problem.grid.cells(); ++cell) {
    const int k = cell / 16;
    if (k >= 3 * cells / 8 && k < 5 * cells / 8) plug.cells.push_back(cell);
  }
  problem.bodies.push_back(porous_body(plug));
  CartesianSettings settings = with_threads(1);
  settings.compressible = false;
  const FlowField field = solve(*make_cartesian(settings), problem);
  EXPECT_TRUE(field.converged);
  const double length = 1, speed = 10;
  const double law = length * (problem.air.viscosity * plug.darcy * speed +
                               0.5 * problem.air.density * plug.forchheimer * speed * speed);
  EXPECT_NEAR(field.porous_force.z / field.pressure[0], 1, 1e-3);  // on 1 m2
  return field.pressure[0] / law;
}

// The collocated scheme lets cell velocity and face flux part at the plug's two ends: first order, no more.
TEST(CartesianEngine, APlugInADuctTendsToTheLawOfDarcyAndForchheimerWithTheGrid) {
  const double coarse = std::abs(plug_drop(32) - 1), fine = std::abs(plug_drop(128) - 1);
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(CartesianEngine, AWarmStartNeedsFewIterations) {
  const FlowProblem problem = open_box(16, 16, 24, 10);
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(problem);
  const FlowField cold = solve_to_rest(*flow, problem.stopping);
  const FlowField warm = solve_to_rest(*flow, problem.stopping);
  EXPECT_TRUE(warm.converged);
  EXPECT_LE(warm.last.iteration, 2);
  EXPECT_NEAR(warm.porous_force.z, cold.porous_force.z, 1e-4 * cold.porous_force.z);
}

TEST(CartesianEngine, AFieldIsScaledToOtherAir) {
  FlowProblem problem = open_box(24, 24, 36, 10);
  const auto engine = make_cartesian(with_threads(1));
  const Folder folder;
  const auto flow = engine->start(problem);
  solve_to_rest(*flow, problem.stopping);
  flow->save(folder.path);
  problem.air.velocity = {0, 0, 20};
  problem.air.density = 1.0;
  double at_once = 0;
  const auto scaled = engine->start(problem);
  scaled->restore(folder.path);
  const FlowField warm = solve_to_rest(*scaled, problem.stopping, [&](FlowProgress progress) {
    if (progress.iteration == 1) at_once = progress.drag;
    return true;
  });
  const FlowField cold = solve(*make_cartesian(with_threads(1)), problem);
  EXPECT_NEAR(at_once, cold.porous_force.z, 0.01 * cold.porous_force.z);
  EXPECT_LT(warm.last.iteration, 0.7 * cold.last.iteration);
  EXPECT_NEAR(warm.porous_force.z, cold.porous_force.z, 1e-4 * cold.porous_force.z);
}

TEST(CartesianEngine, StartingOnCoarserGridsLeavesNoTraceInAFlowOfConstantDensity) {
  FlowProblem problem = open_box(48, 48, 72, 10);  // two coarser grids
  problem.bodies[0].porous().darcy /= 10, problem.bodies[0].porous().forchheimer /= 10;
  CartesianSettings settings;
  settings.threads = 1;
  settings.compressible = false;
  const FlowField by_stages = solve(*make_cartesian(settings), problem);
  settings.grid_sequencing = false;
  const FlowField at_once = solve(*make_cartesian(settings), problem);
  ASSERT_TRUE(by_stages.converged && at_once.converged);
  EXPECT_LT(by_stages.last.iteration, at_once.last.iteration);
  EXPECT_NEAR(by_stages.porous_force.z / at_once.porous_force.z, 1, 1e-5);
  const int corner = problem.grid.index(0, 0, problem.grid.nz - 1);
  EXPECT_NEAR(norm(by_stages.velocity[corner] - at_once.velocity[corner]), 0, 1e-3 * problem.air.speed());
}

TEST(CartesianEngine, EveryIterationReportsItsNumberAndResiduals) {
  int before = 0;
  const auto engine = make_cartesian(with_threads(1));
  const auto flow = engine->start(open_box(12, 12, 16, 10));
  flow->advance(8, 0, [&](const FlowProgress& progress) {
    EXPECT_EQ(progress.iteration, ++before);
    for (const double residual :
         {progress.residual_u, progress.residual_p, progress.residual_k, progress.residual_omega}) {
      EXPECT_GT(residual, 0) << progress.iteration;
      EXPECT_LE(residual, 2) << progress.iteration;
    }
    return true;
  });
  EXPECT_EQ(before, 8);
}

TEST(CartesianEngine, AfterAFreshStartItIsTheFlowThatBegins) {
  FlowProblem problem = open_box(12, 12, 16, 10);
  problem.bodies[0].porous().cells.pop_back();  // on one side only
  const auto engine = make_cartesian(with_threads(1));
  const auto first = engine->start(problem), second = engine->start(problem);
  first->advance(7, 0);
  EXPECT_FALSE(first->untouched());
  first->start_afresh();
  EXPECT_TRUE(first->untouched());
  first->advance(3, 0), second->advance(3, 0);
  EXPECT_TRUE(same_bits(first->field(), second->field()));
}

/// The largest difference of a velocity to that of the box turned about the stream's axis, x for y, over the speed.
double turned_apart(const FlowField& a, const FlowField& b, double speed) {
  double apart = 0;
  for (int k = 0; k < a.grid.nz; ++k)
    for (int j = 0; j < a.grid.ny; ++j)
      for (int i = 0; i < a.grid.nx; ++i) {
        const Vec3 u = a.velocity[a.grid.index(i, j, k)], v = b.velocity[b.grid.index(j, i, k)];
        apart = std::max(apart, norm(u - Vec3{v.y, v.x, v.z}) / speed);
      }
  return apart;
}

/// A disk aslant, so that all three axes have faces of it, or its image with x for y.
std::vector<Triangle> slanted_disk(Vec3 centre, bool mirrored) {
  std::vector<Triangle> cloth = disk(0.5, centre);
  const auto corner = [&](Vec3 p) {
    p.z += 0.4 * (p.x - centre.x) + 0.9 * (p.y - centre.y);
    return mirrored ? Vec3{p.y, p.x, p.z} : p;
  };
  for (Triangle& t : cloth) {
    t = {corner(t.a), corner(t.b), corner(t.c)};
    if (mirrored) std::swap(t.b, t.c);
  }
  return cloth;
}

// Neither axis across the stream is preferred, in steady and unsteady flow: the rows of one are the planes of
// the other.
TEST(CartesianEngine, AMirroredFlowIsTheMirrorImage) {
  const auto problem = [](bool mirrored) {
    FlowProblem p;
    p.air.velocity = {0, 0, 10};
    p.air.viscosity = 0.05;
    p.sides = Sides::slip;
    p.outlet = Outlet::still_air;
    p.stopping.residual = 1e-7;
    p.stopping.max_iterations = 2000;
    const auto swap = [&](Vec3 v) { return mirrored ? Vec3{v.y, v.x, v.z} : v; };
    p.grid = {swap({-1, -1.2, 0}), swap({2, 2.4, 3}), mirrored ? 14 : 12, mirrored ? 12 : 14, 18};
    p.bodies = {sheet_body(slanted_disk({0.13, -0.6, 1.2}, mirrored), {30, 2})};
    return p;
  };
  CartesianSettings settings = with_threads(1);
  settings.second_order = true, settings.compressible = false;
  const auto engine = make_cartesian(settings);
  const FlowField a = solve(*engine, problem(false)), b = solve(*engine, problem(true));
  ASSERT_TRUE(a.converged && b.converged);
  EXPECT_LT(turned_apart(a, b, 10), 1e-4);
  const auto one = engine->start(problem(false)), other = engine->start(problem(true));
  one->march(12, 0.7), other->march(12, 0.7);
  EXPECT_LT(turned_apart(one->field(), other->field(), 10), 1e-4);
  // Two layers that lie in one cell and its neighbour, and move.
  for (int n = 0; n < 6; ++n) {
    for (const bool mirrored : {false, true}) {
      std::vector<Triangle> cloth = slanted_disk({0.13, -0.6 + 0.01 * n, 1.2}, mirrored);
      const std::vector<Triangle> second = slanted_disk({0.13, -0.6 + 0.01 * n, 1.34}, mirrored);
      cloth.insert(cloth.end(), second.begin(), second.end());
      SheetMotion motion;
      motion.velocity.assign(cloth.size(), mirrored ? Vec3{2, 0, 0} : Vec3{0, 2, 0});
      const auto& flow = mirrored ? other : one;
      flow->place(0, cloth, motion);
      flow->step(5e-3);
    }
  }
  EXPECT_LT(turned_apart(one->field(), other->field(), 10), 1e-4);
}

TEST(CartesianEngine, TheReportCanStopTheRunAndTheFieldIsThenUnconverged) {
  const FlowField field = solve(*make_cartesian(with_threads(1)), open_box(12, 12, 16, 10),
                                [](const FlowProgress& progress) { return progress.iteration < 3; });
  EXPECT_EQ(field.last.iteration, 3);
  EXPECT_FALSE(field.converged);
}

// The pressure from coarser grids does not balance the drop of the cloth on these faces: with a full step it grows
// without bound in the fifth iteration.
TEST(CartesianEngine, AStartFromCoarserGridsIsUnderRelaxedAtASheet) {
  FlowProblem problem;
  const double d = 0.65, box = 12 * d;
  problem.grid = graded({{-box / 2, -box / 2, 0}, {box, box, 1.5 * box}, 90, 90, 108},
                        {-0.7 * d, -0.7 * d, 0.45 * 1.5 * box - 0.4 * d},
                        {0.7 * d, 0.7 * d, 0.45 * 1.5 * box + 1.4 * d}, 1.125);
  problem.air.velocity = {0, 0, 30};
  problem.sides = Sides::slip;
  problem.stopping.max_iterations = 12;
  const Vec3 h = problem.grid.spacing();
  problem.bodies = {
      sheet_body(rigid_disk_gap_band({0.25 * h.x, 0.175 * h.y, 0.45 * 1.5 * box + 0.25 * h.z}), {66, 37.45})};
  CartesianSettings settings;
  settings.second_order = true;
  int starts = 0;
  const FlowField field = solve(*make_cartesian(settings), problem, [&](const FlowProgress& progress) {
    starts += progress.iteration == 1;
    return true;
  });
  EXPECT_EQ(starts, 1);
  EXPECT_GT(field.porous_force.z, 0);
}

TEST(CartesianEngine, DivergenceIsReportedWithIterationFieldAndPlace) {
  FlowProblem problem = open_box(12, 12, 16, 10);
  problem.body_force.assign(problem.grid.cells(),
                            {1e200, 0, 0});  // squares of velocities beyond double precision
  try {
    solve(*make_cartesian(with_threads(1)), problem);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::diverged);
    const std::string text = error.what();
    EXPECT_NE(text.find("iteration 1 "), std::string::npos) << text;
    EXPECT_NE(text.find("velocity x is"), std::string::npos) << text;
    EXPECT_NE(text.find(") m"), std::string::npos) << text;
  }
}

TEST(CartesianEngine, FieldsBeyondReasonAreDivergedBeforeTheyAreInfinite) {
  FlowProblem problem = open_box(12, 12, 16, 10);
  problem.body_force.assign(problem.grid.cells(), {0, 0, 1e9});
  problem.stopping.max_iterations = 1;
  try {
    solve(*make_cartesian(with_threads(1)), problem);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::diverged);
    EXPECT_NE(std::string(error.what()).find("diverged by iteration 1 "), std::string::npos) << error.what();
  }
}

TEST(CartesianEngine, ReportsMistakesOfTheProblem) {
  FlowProblem problem = open_box(12, 12, 16, 10);
  problem.bodies[0].porous().cells.push_back(problem.grid.cells());
  EXPECT_THROW(solve(*make_cartesian(), problem), Error);
  problem = open_box(12, 12, 16, 10);
  for (double Freestream::*number : {&Freestream::density, &Freestream::viscosity, &Freestream::temperature,
                                     &Freestream::turbulence_intensity, &Freestream::viscosity_ratio}) {
    for (const double wrong : {-1.0, 0.0, std::nan("")}) {
      problem = open_box(12, 12, 16, 10);
      problem.air.*number = wrong;
      EXPECT_THROW(make_cartesian()->start(problem), Error) << wrong;
    }
  }
  for (const double wrong : {0.0, std::nan("")}) {
    problem = open_box(12, 12, 16, 10);
    problem.air.velocity = {0, 0, wrong};
    EXPECT_THROW(make_cartesian()->start(problem), Error) << wrong;
  }
  CartesianSettings settings;
  settings.relax_pressure = 0;
  EXPECT_THROW(make_cartesian(settings), Error);
  EXPECT_THROW(make_cartesian()->start(open_box(12, 12, 16, 10))->save("/proc/nowhere"), Error);
}

// Sealed, so the seal is valid: as written by a version whose flows have fewer numbers.
TEST(CartesianEngine, AFlowWithFewerNumbersThanItsGridIsNoneOfThisVersion) {
  const TemporaryFolder folder("cut-flow");
  const auto engine = make_cartesian();
  const auto flow = engine->start(open_box(12, 12, 16, 10));
  flow->save(folder.path);
  const std::filesystem::path file = std::filesystem::directory_iterator(folder.path)->path();
  const std::string whole = read_sealed(file);
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t(10)}) {
    write_sealed(file, whole.substr(0, size));
    try {
      flow->restore(folder.path);
      ADD_FAILURE() << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_EQ(std::string(error.what()), file.string() + ": not a flow saved by this version");
    }
  }
}

}  // namespace
}  // namespace ripstop
