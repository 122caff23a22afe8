// The computation of a command, called without a folder and without a terminal.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "../refusal.h"
#include "../small_case.h"
#include "ripstop/canopy/shape.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/run/sizing/fabric.h"
#include "ripstop/run/sizing/pattern.h"
#include "ripstop/run/steady/compare.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/sweep/sweep.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

Case small_case() {
  Case given = flat_circular_case(1, 1000, 20);
  given.title = "A canopy made in code";
  given.parachute.canopy_material = "f-111";
  given.flow.cells = {20, 20, 30};
  given.coupling.threads = 1;  // together with other tests, threads wait for each other
  apply({}, given);
  return given;
}

/// An empty folder that is temporarily the working folder: it would contain any file that a test writes.
class InMemory : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    fs::current_path(folder_.path);
  }
  void TearDown() override {
    fs::current_path(before_);
    EXPECT_TRUE(fs::is_empty(folder_.path)) << "a file was left";
  }
  TemporaryFolder folder_{"in-memory"};
  fs::path before_;
};

struct Watch : SteadyObserver {
  int begun = 0, ended_with_iterations = 0;
  bool cloth = false, flow = false;
  std::vector<double> drag;
  void begin(const SteadyRun& run, SteadyState& state) override {
    ++begun;
    EXPECT_EQ(state.shape.size(), run.solver.mesh().start.size());
  }
  void progress(const SteadyProgress& p, const SteadyState& state) override {
    EXPECT_EQ(p.iteration, static_cast<int>(state.iterations.size()) + 1);
    (p.stage == SteadyStage::cloth ? cloth : flow) = true;
  }
  void iterated(const SteadyRun&, const SteadyState& state, const FlowField& field) override {
    drag.push_back(state.iterations.back().fluid_force);
    EXPECT_EQ(field.porous_force.z, drag.back());
  }
  void ended(const SteadyRun&, const SteadyState&, const SteadyResult& result) override {
    ended_with_iterations = result.iterations;
  }
};

TEST_F(InMemory, ACaseMadeInCodeIsSolvedSteadyAndItsObserverSeesEveryIteration) {
  const Case given = small_case();
  Watch watch;
  const SteadySolution solution = run_steady(given, watch);
  EXPECT_TRUE(solution.result.converged);
  EXPECT_EQ(watch.begun, 1);
  EXPECT_EQ(watch.ended_with_iterations, solution.result.iterations);
  EXPECT_TRUE(watch.cloth && watch.flow);
  ASSERT_EQ(watch.drag.size(), static_cast<std::size_t>(solution.result.iterations));
  EXPECT_EQ(watch.drag.back(), solution.result.drag);
  EXPECT_EQ(solution.result.drag_area, solution.result.drag / (0.5 * 1.2 * 20 * 20));
  EXPECT_EQ(solution.flow.grid.cells(), 20u * 20 * 30);

  // The same in a folder, to the last digit.
  const TemporaryFolder folder("steady-folder");
  SteadyObserver quiet;
  const SteadyFolderRun stored = run_steady_in({{folder.path}, 0, {}, {}}, resolve(given), quiet);
  EXPECT_EQ(stored.result.drag, solution.result.drag);
  EXPECT_EQ(final_state(folder.path).shape, solution.state.shape);
  const SteadyFolderRun again = run_steady_in({{folder.path}, 0, {}, {}}, resolve(given), quiet);
  EXPECT_TRUE(again.already_finished);
  EXPECT_EQ(to_json(again.result), read_file(folder.path / "result.json"));
}

TEST_F(InMemory, UnderAPressureTheLinesCarryTheClothsLoad) {
  const FabricSolution cloth = run_fabric(resolve(small_case()), 240);
  EXPECT_TRUE(cloth.result.converged);
  EXPECT_EQ(cloth.result.pressure, 240);
  EXPECT_NEAR(cloth.result.line_tension / cloth.result.pressure_load, 1, 1e-3);
  // Whatever its shape, a closed cloth carries the pressure on its mouth, less that on its vent.
  const double vent = 0.25 * std::numbers::pi * 0.1 * 0.1;
  EXPECT_NEAR(cloth.result.pressure_load / (240 * (skirt_area(cloth.mesh, cloth.shape) - vent)), 1, 5e-3);
  EXPECT_EQ(cloth.shape.size(), cloth.mesh.start.size());
}

TEST_F(InMemory, ASweepStartsFromItsNeighboursAndItsModelsAreCompared) {
  const Case given = small_case();
  const SweepAxis axis = linear_models(resolve(given));
  std::vector<SweepPoint> points;
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    Case one = given;
    one.coupling.linear = i > 0;
    points.push_back({{axis.values[i]}, resolve(one), "", i == 0 ? -1 : 0});
  }
  const std::vector<SweepRow> rows = run_sweep(points, {});
  for (const SweepRow& row : rows) {
    ASSERT_TRUE(row.done) << row.error;
    EXPECT_TRUE(row.result.converged);
  }
  const Comparison both = compare_models(points, rows, [&](std::size_t i) { return rows[i].state; });
  EXPECT_EQ(both.title, given.title);
  EXPECT_GT(both.models[1].profile_change, 0);
  EXPECT_EQ(both.models[0].drag_difference, 0);
  EXPECT_EQ(both.models[0].profile_change, 0);
  EXPECT_NE(both.models[1].drag_difference, 0);
  EXPECT_NEAR(both.models[1].drag_difference, 0, 0.05);
  EXPECT_EQ(both.models[2].drag, both.models[1].drag);  // the same case from the same start
}

TEST_F(InMemory, ThePatternsBillHasTheMassOfTheCutPieces) {
  const PatternResult pattern = run_pattern(resolve(small_case()), {}, 400);
  double mass = 0;
  for (const BillRow& row : pattern.bill.rows) mass += row.mass;
  EXPECT_DOUBLE_EQ(mass, pattern.bill.mass);
  EXPECT_DOUBLE_EQ(pattern.bill.packed_volume, mass / 400);
}

TEST(ClothUnderPressure, AClothUnderAPressureThatBurstsItIsComparedWithItsStrength) {
  const Settings resolved = resolve(small_case());
  const std::string message = refusal_of([&] { run_fabric(resolved, 1e6); }, ExitCode::diverged);
  EXPECT_NE(message.find("no equilibrium under 1e+06 Pa"), std::string::npos) << message;
  EXPECT_NE(message.find("the cloth breaks at"), std::string::npos) << message;
  EXPECT_NE(refusal_of([&] { run_fabric(resolved, 2e6); }, ExitCode::usage).find("pressure (Pa)"),
            std::string::npos);
}

}  // namespace
}  // namespace ripstop
