// The steady loop and its checkpoints on a flow that is a formula, so that every expected number is known.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "ripstop/canopy/shape.h"
#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/fsi/steady_loop.h"
#include "ripstop/run/steady/checkpoint.h"
#include "tests/refusal.h"
#include "tests/run/steady/formula_flow.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

SteadyProblem small_problem(CanopyLoad load = CanopyLoad::uniform, PorosityModel model = PorosityModel::paper,
                            int cloth_nodes = 800) {
  Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  given.parachute.mesh.cloth_nodes = cloth_nodes;
  given.flow.cells = {20, 20, 30};
  given.flow.porosity_model = model;
  given.coupling.load = load;
  given.coupling.threads = 1;
  return steady_problem(resolve(given));
}

TEST(SteadyRun, TheLedgerClosesAndTheLoadIsTheFlowsForce) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  while (!solver.finished(state)) solver.iterate(state);
  ASSERT_TRUE(state.converged);
  const SteadyIteration& last = state.iterations.back();
  EXPECT_GE(state.iterations.size(), 2u);
  EXPECT_TRUE(last.flow_converged);
  EXPECT_NEAR(last.nodal_load / last.fluid_force, 1, 0.01);
  EXPECT_NEAR(last.line_tension / last.nodal_load, 1, 1e-3);
  EXPECT_LT(last.drag_change, 1e-3);
}

TEST(SteadyRun, BeginsWithTheRelaxationAndTheUpdateOfItsSettings) {
  FormulaEngine engine;
  SteadyProblem problem = small_problem();
  problem.settings.relaxation = 0.6;
  problem.settings.acceleration = Acceleration::aitken;
  const SteadyState state = SteadySolver(std::move(problem), engine).start();
  EXPECT_EQ(state.accelerator.relaxation, 0.6);
  EXPECT_EQ(state.accelerator.update, Acceleration::aitken);
}

TEST(SteadyRun, AnIterationReportsMotionAndStepsOfTheCloth) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  for (int k = 0; k < 2; ++k) {
    const std::vector<Vec3> before = state.shape;
    solver.iterate(state);
    double moved = 0, size = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      moved += dot(state.shape[i] - before[i], state.shape[i] - before[i]);
      size += dot(before[i], before[i]);
    }
    const SteadyIteration& now = state.iterations.back();
    EXPECT_DOUBLE_EQ(now.omega, std::sqrt(moved / size));
    EXPECT_GT(now.shape_change, 0);
    EXPECT_LT(now.shape_change,
              std::sqrt(moved / double(before.size())) * (1 + 1e-9));  // a mean, of distances
    EXPECT_GT(now.cloth_steps, 10);
    EXPECT_GT(now.cloth_residual, 0);
    EXPECT_LE(now.cloth_residual, small_problem().settings.cloth_tolerance);
    EXPECT_GT(now.cut_cells, 0);
    EXPECT_DOUBLE_EQ(now.approach_speed, small_problem().flow.air.speed());  // all air of this flow has it
    EXPECT_GT(now.flow_iterations, 0);
  }
}

TEST(SteadyRun, TheFirstEstimateIsTheDragEarlyInTheFirstIteration) {
  FormulaEngine engine;
  SteadyProblem problem = small_problem();
  problem.flow.stopping.residual = 1e-12;  // more iterations than the estimate needs
  SteadySolver solver(std::move(problem), engine);
  SteadyState state = solver.start();
  double early = 0;
  solver.iterate(state, [&](const SteadyProgress& p) {
    if (p.stage == SteadyStage::flow && p.flow.iteration == FirstEstimate::flow_iterations)
      early = p.flow.drag;
  });
  ASSERT_TRUE(state.first_estimate);
  EXPECT_EQ(state.first_estimate->drag, early);
  EXPECT_GT(early, 0);
  EXPECT_NE(early, state.iterations.back().fluid_force);
  EXPECT_EQ(state.first_estimate->speed, small_problem().flow.air.speed());
  EXPECT_EQ(state.first_estimate->projected_diameter,
            canopy_size(solver.mesh(), state.shape).projected_diameter);
  solver.iterate(state);
  EXPECT_EQ(state.first_estimate->drag, early);
}

TEST(SteadyRun, WithARigidBodyThereIsNoFirstEstimate) {
  FormulaEngine engine;
  SteadyProblem problem = small_problem();
  problem.flow.stopping.residual = 1e-12;
  problem.flow.bodies.push_back(problem.flow.bodies.front());
  SteadySolver solver(std::move(problem), engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  EXPECT_FALSE(state.first_estimate);
}

/// Whose force is half a percent higher every time that the cloth is placed.
class CreepingFlow final : public FormulaFlow {
 public:
  using FormulaFlow::FormulaFlow;
  void place(std::size_t, const std::vector<Triangle>&, const SheetMotion&) override {
    aim_at(300 * std::pow(1.005, ++placed_));
  }

 private:
  int placed_ = 0;
};

struct CreepingEngine : FlowEngine {
  std::string name() const override { return "creeping"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<CreepingFlow>(problem);
  }
};

// Shape and ledger would do.
TEST(SteadyRun, ADragThatStillChangesIsNotConverged) {
  CreepingEngine engine;
  SteadyProblem problem = small_problem();
  problem.settings.max_iterations = 6;
  SteadySolver solver(problem, engine);
  SteadyState state = solver.start();
  while (!solver.finished(state)) solver.iterate(state);
  const SteadyIteration& last = state.iterations.back();
  EXPECT_FALSE(state.converged);
  EXPECT_NEAR(last.drag_change, 0.005, 1e-3);
  EXPECT_LT(last.shape_change, problem.settings.shape_tolerance_m);
  EXPECT_NEAR(last.nodal_load / last.fluid_force, 1, 0.01);
}

TEST(SteadyRun, ACheckpointGivesBackEveryBit) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  const std::string bytes = to_bytes(state);
  const SteadyState again = steady_state_from_bytes(bytes);
  EXPECT_EQ(again.shape, state.shape);
  EXPECT_EQ(again.pressure, state.pressure);
  EXPECT_EQ(again.accelerator.residuals, state.accelerator.residuals);
  EXPECT_EQ(to_bytes(again), bytes);
  EXPECT_THROW(steady_state_from_bytes(bytes.substr(0, bytes.size() / 2)), Error);
}

TEST(SteadyRun, ARunKilledBetweenIterationsResumesBitForBit) {
  FormulaEngine whole_engine;
  SteadySolver whole(small_problem(), whole_engine);
  SteadyState undisturbed = whole.start();
  for (int k = 0; k < 3; ++k) whole.iterate(undisturbed);

  TemporaryFolder folder("steady_run");
  {
    FormulaEngine engine;
    SteadySolver solver(small_problem(), engine);
    SteadyState state = solver.start();
    for (int k = 0; k < 2; ++k) {
      solver.iterate(state);
      save_checkpoint(folder.path, state, solver.flow());
    }
    solver.iterate(state);  // lost: the process ends before its checkpoint
  }
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  auto loaded = load_checkpoint(folder.path, solver.flow());
  ASSERT_TRUE(loaded);
  SteadyState& state = loaded->state;
  EXPECT_EQ(loaded->damage, "");
  ASSERT_EQ(state.iterations.size(), 2u);
  solver.iterate(state);
  EXPECT_EQ(state.shape, undisturbed.shape);
  EXPECT_EQ(state.iterations.back().fluid_force, undisturbed.iterations.back().fluid_force);
}

/// Whose flow cannot be saved when requested.
struct FullDisk : FormulaEngine {
  struct OnFullDisk : FormulaFlow {
    OnFullDisk(const FlowProblem& problem, const bool& is_full) : FormulaFlow(problem), full(is_full) {}
    void save(const fs::path& to) const override {
      if (full) throw Error(ExitCode::io, "the disk is full");
      FormulaFlow::save(to);
    }
    const bool& full;
  };
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<OnFullDisk>(problem, full);
  }
  bool full = false;
};

// The third checkpoint takes the place of the first, whose flow is not its own.
TEST(SteadyRun, AnIncompleteCheckpointIsNotRead) {
  TemporaryFolder folder("steady_half");
  FullDisk engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  for (int k = 0; k < 3; ++k) {
    solver.iterate(state);
    if (k < 2) save_checkpoint(folder.path, state, solver.flow());
  }
  engine.full = true;
  EXPECT_THROW(save_checkpoint(folder.path, state, solver.flow()), Error);
  EXPECT_EQ(load_checkpoint(folder.path, solver.flow()).value().state.iterations.size(), 2u);
  fs::resize_file(folder.path / "even/state", 10);
  EXPECT_THROW(load_checkpoint(folder.path, solver.flow()), Error) << "a state beside the flow of another";
}

TEST(SteadyRun, ADamagedCheckpointIsNeverReadAsOne) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  TemporaryFolder folder("steady_run");
  EXPECT_FALSE(load_checkpoint(folder.path, solver.flow()));
  save_checkpoint(folder.path, state, solver.flow());
  const fs::path file = folder.path / "odd" / "state";
  std::string bytes = read_file(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_file(file, bytes);
  EXPECT_THROW(load_checkpoint(folder.path, solver.flow()), Error);
  fs::resize_file(file, bytes.size() / 2);
  EXPECT_THROW(load_checkpoint(folder.path, solver.flow()), Error);
}

void flip_middle_byte(const fs::path& file) {
  std::string bytes = read_file(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_file(file, bytes);
}

TEST(SteadyRun, TheOlderCheckpointReplacesADamagedOne) {
  for (const char* damaged : {"even/state", "even/flow/state", "current", "current, gone", "even, gone"}) {
    FormulaEngine engine;
    SteadySolver solver(small_problem(), engine);
    SteadyState state = solver.start();
    TemporaryFolder folder("steady_run");
    for (int k = 0; k < 2; ++k) {
      solver.iterate(state);
      save_checkpoint(folder.path, state, solver.flow());
    }
    const std::string what = damaged;
    if (what == "current, gone") {
      fs::remove(folder.path / "current");
    } else if (what == "even, gone") {
      fs::remove_all(folder.path / "even");
    } else if (fs::exists(folder.path / what)) {
      flip_middle_byte(folder.path / what);
    } else {
      continue;  // the engine of this test writes no such file
    }
    const auto loaded = load_checkpoint(folder.path, solver.flow());
    ASSERT_TRUE(loaded) << what;
    EXPECT_GE(loaded->state.iterations.size(), 1u) << what;
    if (what == "even/state" || what == "even, gone") {
      EXPECT_EQ(loaded->state.iterations.size(), 1u);
      EXPECT_NE(loaded->damage, "");
    }
  }
}

TEST(SteadyRun, MissingCheckpointsAreNoFreshStart) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  TemporaryFolder folder("steady_run");
  EXPECT_FALSE(load_checkpoint(folder.path, solver.flow()));
  solver.iterate(state);
  save_checkpoint(folder.path, state, solver.flow());
  fs::remove_all(folder.path / "odd");
  EXPECT_THROW(load_checkpoint(folder.path, solver.flow()), Error);
}

// Rings of cloth that are pushed outward and inward in turn.
TEST(SteadyRun, ClothWithoutEquilibriumIsRegularisedWhichIsReported) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(CanopyLoad::sampled, PorosityModel::sheet), engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  EXPECT_EQ(state.iterations.back().regularisation, 0);
  EXPECT_EQ(state.iterations.back().regularisation_share, 0);
  for (std::size_t c = 0; c < state.pressure.size(); ++c) {
    if (solver.cells()[c].corner[0] < 0) continue;
    const Vec3 x = state.shape[solver.cells()[c].corner[0]];
    state.pressure[c] = std::sin(30 * std::hypot(x.x, x.y)) > 0 ? -900 : 1000;  // [Pa]
  }
  SteadyState of_a_neighbour = state;
  of_a_neighbour.iterations.clear();
  solver.iterate(of_a_neighbour);
  EXPECT_GT(of_a_neighbour.iterations.back().regularisation, 0)
      << "a run that starts from there has that shape too";
  solver.iterate(state);
  const SteadyIteration held = state.iterations.back();
  EXPECT_GT(held.regularisation, 0);
  EXPECT_GT(held.regularisation_share, 0.02);
  EXPECT_GT(held.cloth_steps, 40000);
  EXPECT_LE(held.cloth_residual, small_problem().settings.cloth_tolerance);
  EXPECT_FALSE(state.converged);
  solver.iterate(state);
  EXPECT_GE(state.iterations.back().regularisation, held.regularisation);
  EXPECT_LT(state.iterations.back().regularisation_share, held.regularisation_share);
}

// To no force at all no cloth comes: it is tried unheld, and held by 3, 12 and 48 mean pressures a width.
TEST(SteadyRun, ClothThatNoHoldBringsToRestIsGivenUpAfterTheStrongest) {
  FormulaEngine engine;
  SteadyProblem problem = small_problem(CanopyLoad::uniform, PorosityModel::sheet, 200);
  SteadySolver solver(problem, engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  problem.settings.cloth_tolerance = 1e-30;
  SteadySolver asks_for_too_much(problem, engine);
  const std::string message = refusal_of([&] { asks_for_too_much.iterate(state); }, ExitCode::not_converged);
  EXPECT_TRUE(message.find("after 160000 steps") != std::string::npos) << message;
}

// Every placing finds up to 20 % more or less than 300 N, in no order.
struct JitteringEngine : FormulaEngine {
  struct Jittering : FormulaFlow {
    using FormulaFlow::FormulaFlow;
    void place(std::size_t, const std::vector<Triangle>&, const SheetMotion&) override {
      ++placed;
      aim_at(240 + 12 * (placed * placed * placed * 7 % 11));
    }
    int placed = 0;
  };
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<Jittering>(problem);
  }
};

// 324, 252, 264, 336, 312, 300, 276, ... N: the seventh answer is the first after five whose change is the larger one.
TEST(SteadyRun, AnswersThatGoToAndFroAreAveraged) {
  JitteringEngine engine;
  SteadySolver solver(small_problem(), engine);
  SteadyState state = solver.start();
  while (state.iterations.size() < 6) solver.iterate(state);
  EXPECT_EQ(state.accelerator.update, Acceleration::anderson);
  solver.iterate(state);
  for (int n = 2; n < 8; ++n) {
    const SteadyIteration before = state.iterations.back();
    solver.iterate(state);
    const double mean = before.nodal_load + (before.fluid_force - before.nodal_load) / n;
    EXPECT_NEAR(state.iterations.back().nodal_load, mean, 0.003 * mean) << n;
  }
  EXPECT_FALSE(state.converged);
}

TEST(SteadyRun, SampledPressuresAreScaledToTheFlowsForce) {
  FormulaEngine engine;
  SteadySolver solver(small_problem(CanopyLoad::sampled), engine);
  SteadyState state = solver.start();
  solver.iterate(state);
  // Relaxation 1 and the first iteration: the next load is the flow's answer itself.
  EXPECT_NEAR(pressure_force(solver.cells(), state.shape, state.pressure).z / state.iterations[0].fluid_force,
              1, 1e-9);
}

TEST(SteadyRun, ACanopyOutsideTheBoxIsRefused) {
  SteadyProblem problem = small_problem();
  for (Vec3& x : problem.mesh.start) x.z += 10;
  FormulaEngine engine;
  try {
    SteadySolver solver(std::move(problem), engine);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("does not fit"), std::string::npos);
  }
}

// At the edges of cloth that does not close about an axis a node is one of the corners of its cells only.
TEST(SteadyRun, AnyNodeOfTheClothOutsideTheBoxIsRefused) {
  Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/cross/case.toml");
  given.parachute.mesh.cloth_nodes = 300;
  given.flow.cells = {20, 20, 30};
  given.coupling.threads = 1;
  const SteadyProblem fits = steady_problem(resolve(given));
  FormulaEngine engine;
  EXPECT_NO_THROW(SteadySolver(fits, engine));
  std::set<int> nodes;
  for (const Cell& cell : cells_of(fits.mesh))
    if (cell.corner[0] >= 0) nodes.insert(cell.corner, cell.corner + 4);
  EXPECT_GT(nodes.size(), 200u);
  for (const int node : nodes) {
    SteadyProblem outside = fits;
    outside.mesh.start[node].x -= 100;
    EXPECT_NE(refusal_of([&] { SteadySolver(outside, engine); }, ExitCode::usage).find("cloth at (-"),
              std::string::npos)
        << node;
  }
}

}  // namespace
}  // namespace ripstop
