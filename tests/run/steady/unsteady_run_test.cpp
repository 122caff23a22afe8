// A run that continues in time: on a flow that is a formula, and in a folder with the built-in engine.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "ripstop/case/assemble.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/statistics.h"
#include "ripstop/output/csv.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/steady/checkpoint.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/steady/steady_parts.h"
#include "ripstop/run/steady/watch_files.h"
#include "tests/run/steady/formula_flow.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

/// In time its force oscillates about nine tenths of its steady value, and to the side by `side` of it; from window
/// to window it is alternately higher and lower by `mode`.
class SwingingFlow final : public FormulaFlow {
 public:
  SwingingFlow(const FlowProblem& problem, double side, double mode)
      : FormulaFlow(problem), side_(side), mode_(mode) {}

  void place(std::size_t body, const std::vector<Triangle>& surface, const SheetMotion& motion) override {
    FormulaFlow::place(body, surface, motion);
    mode_ = -mode_;
  }
  FlowStep march(int steps, double, const StepReport& report) override {
    for (int n = 0; n < steps; ++n) {
      now_.time = 0.002 * ++now_.step, now_.length = 0.002;
      const double side = side_ * target();
      now_.mass_defect = mass_defect;
      now_.force = {side * std::sin(7 * now_.time), side * std::cos(11 * now_.time),
                    target() * (0.9 + mode_ + 0.1 * std::sin(40 * now_.time))};
      stand_at(now_.force.z);
      if (report && !report(now_)) break;
    }
    return now_;
  }
  void save(const fs::path& folder) const override {
    FormulaFlow::save(folder);
    write_file(folder / "step", std::to_string(now_.step));
  }
  void restore(const fs::path& folder) override {
    FormulaFlow::restore(folder);
    now_.step = std::stoi(read_file(folder / "step"));
  }

  static constexpr double mass_defect = 1e-3;  // of every step

 private:
  double side_, mode_;
  FlowStep now_;
};

struct SwingingEngine : FlowEngine {
  double side = 0, mode = 0;
  std::string name() const override { return "swinging"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<SwingingFlow>(problem, side, mode);
  }
};

Settings swinging_settings() {
  Case given = read_case(fs::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml");
  given.parachute.mesh.cloth_nodes = 800;
  given.flow.cells = {20, 20, 30};
  given.flow.unsteady = true;
  given.flow.watch.shortest = 20;
  given.coupling.threads = 1;
  return resolve(given);
}

SteadyProblem swinging_problem() {
  return steady_problem(swinging_settings());
}

TEST(UnsteadyRun, EndsAtRestFirstAndThenWithTheMeanOverTime) {
  SwingingEngine engine;
  SteadySolver solver(swinging_problem(), engine);
  SteadyState state = solver.start();
  double at_rest = 0;
  while (!solver.finished(state)) {
    solver.iterate(state);
    if (!state.iterations.back().in_time) at_rest = state.iterations.back().fluid_force;
  }
  ASSERT_TRUE(state.converged);
  const SteadyIteration& last = state.iterations.back();
  int means = 0;
  for (const SteadyIteration& i : state.iterations) {
    if (!i.in_time || i.iteration == last.iteration) continue;
    ++means;
    EXPECT_LT(i.flow_iterations, 0.5 * last.flow_iterations) << "before the cloth stands a watch is short";
  }
  ASSERT_GT(means, 0) << "one mean says nothing of the shape under its load";
  EXPECT_NEAR(last.fluid_force / at_rest, 0.9, 0.03);
  EXPECT_TRUE(state.window.enough);
  EXPECT_LE(last.drag_error, 0.01 * last.fluid_force);
  EXPECT_GT(last.drag_error, 0);
  EXPECT_EQ(last.flow_iterations, static_cast<int>(solver.record().steps.size()));

  EXPECT_EQ(state.window.mass_defect, SwingingFlow::mass_defect);
  const auto told = [&](double defect) {
    state.window.mass_defect = defect;
    const SteadyResult result = steady_result(solver, state, swinging_settings());
    for (const std::string& text : *result.warnings)
      if (text.find("largest mass defect of the air") == 0) return text;
    return std::string();
  };
  EXPECT_EQ(told(SwingingFlow::mass_defect), "");
  EXPECT_NE(told(0.02), "");
  EXPECT_NE(told(0.1).find("must not be used"), std::string::npos);
}

// A mean with a random direction inclines the cloth, from mean to mean. The coupling must not wait for the
// end of this motion.
TEST(UnsteadyRun, ARandomInclinationOfTheClothIsAccepted) {
  const auto means = [](double side) {
    SwingingEngine engine;
    engine.side = side;
    SteadyProblem problem = swinging_problem();
    problem.settings.shape_tolerance_m = 1e-5;  // the scatter of the drag moves it by more
    problem.settings.max_iterations = 25;
    SteadySolver solver(problem, engine);
    SteadyState state = solver.start();
    while (!solver.finished(state)) solver.iterate(state);
    std::erase_if(state.iterations, [](const SteadyIteration& i) { return !i.in_time; });
    return state.iterations;
  };
  const std::vector<SteadyIteration> upright = means(0), leaning = means(0.3);
  EXPECT_FALSE(leaning.empty());
  EXPECT_LT(leaning.size(), upright.size());
  // The wake of the first means still had to form.
  double load = 0, weight = 0, weights = 0;
  for (auto mean = upright.begin() + 1; mean + 1 != upright.end(); ++mean)
    weights += ++weight, load += weight * mean->fluid_force;
  EXPECT_NEAR(upright.back().nodal_load / (load / weights), 1, 5e-5)
      << "the n-th mean after the first weighs n";
}

// Each watch by itself has its mean known to a hundredth.
TEST(UnsteadyRun, WatchesThatDifferAmongThemselvesAreAsSureAsThat) {
  SwingingEngine engine;
  engine.mode = 0.05;
  SteadyProblem problem = swinging_problem();
  problem.settings.max_iterations = 25;
  SteadySolver solver(problem, engine);
  SteadyState state = solver.start();
  while (!solver.finished(state)) solver.iterate(state);
  EXPECT_TRUE(state.converged) << "it need not wait for two that agree";
  const double drag = state.iterations.back().fluid_force;
  EXPECT_LT(solver.record().drag.standard_error, 0.02 * drag);
  EXPECT_NEAR(state.window.error / drag, 0.065, 0.01) << "three or four at 0.85 and 0.95 in turn";
  EXPECT_FALSE(state.window.enough) << "one hundredth was asked for";
}

// Under a load that is another than that of its shape. At rest it takes one step toward it for each flow.
TEST(UnsteadyRun, HeldClothStepsOnBeforeTheNextWatch) {
  SwingingEngine engine;
  SteadySolver solver(swinging_problem(), engine);
  SteadyState state = solver.start();
  while (state.iterations.empty() || !state.iterations.back().in_time) solver.iterate(state);
  for (std::size_t c = 0; c < state.pressure.size() / 2; ++c) state.pressure[c] *= 1.5;
  state.iterations.back().regularisation = 2e4;
  SteadyState at_rest = state;
  at_rest.in_time = false;
  solver.iterate(at_rest);
  solver.iterate(state);
  const SteadyIteration &one = at_rest.iterations.back(), &several = state.iterations.back();
  EXPECT_GT(one.regularisation_share, 0.01);
  EXPECT_LT(several.regularisation_share, 0.5 * one.regularisation_share);
  EXPECT_GT(several.shape_change, one.shape_change);
}

TEST(UnsteadyRun, KilledBetweenIterationsItResumesBitForBit) {
  const auto to_the_end = [](SteadySolver& solver, SteadyState& state) {
    while (!solver.finished(state)) solver.iterate(state);
  };
  SwingingEngine engine;
  SteadySolver whole(swinging_problem(), engine);
  SteadyState undisturbed = whole.start();
  to_the_end(whole, undisturbed);
  const TemporaryFolder folder("unsteady_run");
  {
    SteadySolver solver(swinging_problem(), engine);
    SteadyState state = solver.start();
    while (!state.in_time || !state.iterations.back().in_time) solver.iterate(state);
    save_checkpoint(folder.path, state, solver.flow());
  }
  SteadySolver solver(swinging_problem(), engine);
  auto loaded = load_checkpoint(folder.path, solver.flow());
  ASSERT_TRUE(loaded);
  to_the_end(solver, loaded->state);
  EXPECT_EQ(to_bytes(loaded->state).size(), to_bytes(undisturbed).size());
  EXPECT_EQ(loaded->state.shape, undisturbed.shape);
  EXPECT_EQ(loaded->state.window.drag, undisturbed.window.drag);
  EXPECT_EQ(loaded->state.window.time, undisturbed.window.time);
}

// Uneven steps, the first two of them the start-up.
TEST(UnsteadyRun, TheMeanInItsPlotEndsAtThatOfItsRecord) {
  FlowRecord record;
  double time = 0, sum = 0;
  for (int n = 0; n < 6; ++n) {
    FlowStep step;
    step.length = 0.1 * (1 + n % 2);
    step.time = time += step.length;
    step.force = {0.1 * n, -0.2 * n, 10. + n * n};
    if (n >= 2) sum += step.length * step.force.z;
    record.steps.push_back(step);
  }
  record.start_up = 0.3 + 1e-9;
  const Plot plot = history_plot("canopy", record);
  ASSERT_EQ(plot.series.size(), 4u);
  EXPECT_EQ(plot.series[0].y, (std::vector<double>{10, 11, 14, 19, 26, 35}));
  ASSERT_EQ(plot.series[1].y.size(), 4u);
  EXPECT_NEAR(plot.series[1].y.back(), sum / 0.6, 1e-12);
  EXPECT_NEAR(plot.series[1].x.back(), 0.9, 1e-12);
  EXPECT_DOUBLE_EQ(plot.series[3].y.back(), -1);
}

TEST(UnsteadyRun, WithoutAStepItLeavesNoHistory) {
  const TemporaryFolder folder("unwatched");
  ClaimedFolder claimed(folder.path / "run");
  write_watch(claimed, resolve(checked(flat_circular_case(1, 600, 20))), FlowRecord{});
  EXPECT_TRUE(claimed.names().empty());
  EXPECT_FALSE(fs::exists(folder.path / "run/history.csv"));
}

TEST(UnsteadyRun, LeavesItsHistoryAndItsWakeInTheFolder) {
  const TemporaryFolder folder("unsteady_run");
  Case given = checked(flat_circular_case(1, 600, 20));
  given.flow.box_m = Vec3{3, 3, 4};
  given.flow.cells = {24, 24, 28};
  given.flow.core.size_m = Vec3{0, 0, 0};
  given.flow.unsteady = true;
  given.flow.watch = {.courant = 0.7, .standard_error = 0.2, .shortest = 5, .longest = 20};
  given.flow.max_iterations = 60;
  given.flow.average_over = 20;
  given.coupling.load = CanopyLoad::uniform;
  given.coupling.drag_tolerance = 0.2;
  given.coupling.shape_tolerance_m = 0.05;
  given.coupling.threads = 1;
  SteadyObserver nobody;
  const SteadyFolderSettings settings{{folder.path, false}, 1, {}, {}};
  const SteadyResult result = run_steady_in(settings, resolve(given), nobody).result;
  ASSERT_TRUE(result.unsteady);
  EXPECT_TRUE(result.converged);
  const WindowAverage& watched = result.unsteady->watched;
  const CsvTable history = read_csv(folder.path / "history.csv");
  EXPECT_EQ(history.rows.size(), static_cast<std::size_t>(watched.steps));
  EXPECT_NEAR(
      history.column("time_s").back() - history.column("time_s").front() + history.column("step_s")[0],
      watched.time, 1e-9);
  // The wake is that of an earlier window: the stream need not pass the box of 4 m again.
  const Record drag{history.column("time_s"), history.column("drag_n"),
                    history.column("time_s").front() - history.column("step_s").front()};
  EXPECT_NEAR(watched.start_up, end_of_start_up(drag) - drag.begin, 1e-9);
  EXPECT_GT(watched.mass_defect, 0);
  EXPECT_LT(watched.mass_defect, quality_limit("mass_defect").warn);
  // Of all steps without the start-up, and of every eighth field in whole parts: equal except for the error
  // of so short a window.
  EXPECT_GT(watched.error, 0);
  EXPECT_NEAR(watched.drag, result.drag, watched.error);
  for (const char* name : {"history.png", "wake.png", "wake.pvd", "wake/plane_000.vti"})
    EXPECT_TRUE(fs::exists(folder.path / name)) << name;
  const SteadyFolderRun again = run_steady_in(settings, resolve(given), nobody);
  EXPECT_TRUE(again.already_finished);
  ASSERT_TRUE(again.result.unsteady);
  EXPECT_EQ(again.result.unsteady->standard_error, result.unsteady->standard_error);
}

}  // namespace
}  // namespace ripstop
