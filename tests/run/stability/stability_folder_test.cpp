// The folder of a curve over the angle of attack: rows as they finish, interruption, other inputs.
#include "ripstop/run/stability/stability_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/output/csv.h"
#include "tests/run/stability/leaning_flow.h"
#include "tests/small_case.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

struct Stop {};

/// Counts the angles that are computed; after `stop_after` of them it stops the run.
class Counter : public StabilityObserver {
 public:
  explicit Counter(std::size_t stop_after = 99) : stop_after_(stop_after) {}
  SteadyObserver& axis() override { return nobody_; }
  void progress(std::size_t angle, const std::string&, double) override {
    if (angle >= stop_after_) throw Stop{};
  }
  void ended(std::size_t, const StabilityRow&, bool earlier) override { ++(earlier ? found : computed); }

  int found = 0, computed = 0;

 private:
  SteadyObserver nobody_;
  std::size_t stop_after_;
};

/// The suite computes one curve with its steady run; its tests take the shape from there.
class StabilityFolder : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    add_engine(
        {"leaning",
         "a formula of the stream's direction",
         {.sheets = true,
          .averages = true,
          .time = true,
          .boundaries = {"zero-gradient", "slip", "entraining", "far-field", "fixed-pressure", "still-air"}},
         [](const EngineOptions&) { return std::string("leaning 1"); },
         [](const EngineOptions&) { return std::make_unique<LeaningEngine>(); }});
    StabilitySettings settings = in("whole");
    settings.steady.clear();
    settings.run.report = true;
    Counter observer;
    result_ = run_stability(given(), angles_, settings, observer);
    EXPECT_EQ(observer.computed, 5);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static Case given() {
    Case made = flat_circular_case(1, 800, 20);
    made.flow.engine = "leaning";
    made.coupling.load = CanopyLoad::uniform;  // the formula has no load for each face
    made.flow.cells = {20, 20, 30};
    made.flow.watch.shortest = 10, made.flow.watch.longest = 20;
    return checked(made);
  }
  static StabilitySettings in(const std::string& name) {
    StabilitySettings settings;
    settings.run = {folder_ / name, false, false, false};
    settings.across = 8, settings.threads = 1;
    settings.steady = folder_ / "whole/axis";
    return settings;
  }

  inline static const std::vector<double> angles_{0, 10, 15, 25, 30};
  inline static const fs::path folder_ =
      fs::temp_directory_path() / ("ripstop_stability_test_" + std::to_string(getpid()));
  inline static StabilityResult result_;
};

TEST_F(StabilityFolder, HasTheTableTheResultAndTheStableTrimAngle) {
  ASSERT_EQ(result_.rows.size(), 5u);
  EXPECT_NEAR(result_.rows[1].c_t, 0.7, 0.002);
  EXPECT_NEAR(result_.rows[1].c_m, 0.02, 2e-4);
  EXPECT_GT(*result_.rows[1].c_m_error, 0);
  ASSERT_EQ(result_.trim_angles.size(), 2u);
  EXPECT_EQ(result_.trim_angles[0], 0);
  EXPECT_NEAR(result_.trim_angles[1], 20, 0.5);
  EXPECT_EQ(result_.stable_trim_angles, std::vector<double>{result_.trim_angles[1]});

  const CsvTable table = read_csv(folder_ / "whole/stability.csv");
  EXPECT_EQ(table.column("angle_deg"), angles_);
  EXPECT_EQ(table.column("c_m")[1], result_.rows[1].c_m);
  EXPECT_EQ(table.column("c_n_standard_error").size(), 5u);
  const auto json = nlohmann::json::parse(read_file(folder_ / "whole/result.json"));
  EXPECT_EQ(json.at("trim_angles_deg").size(), 2u);
  EXPECT_EQ(json.at("trims").at(1).at("stable"), true);
  EXPECT_EQ(json.at("reference_length_m"), 1.0);
  for (const char* file :
       {"stability.svg", "stability.png", "report.html", "angle=15/history.csv", "axis/result.json"})
    EXPECT_TRUE(fs::exists(folder_ / "whole" / file)) << file;
  EXPECT_FALSE(fs::exists(folder_ / "whole/angle=15/checkpoint"));
  const CsvTable flight = read_csv(folder_ / "whole/six_dof.csv");
  ASSERT_EQ(flight.rows.size(), 9u);  // 0 once, the others on both sides
  EXPECT_EQ(flight.column("c_m")[3], -flight.column("c_m")[5]);
  EXPECT_EQ(flight.column("c_d")[3], flight.column("c_d")[5]);
  EXPECT_NEAR(flight.column("alpha_rad")[5], 10 * 3.14159265358979 / 180, 1e-12);
}

TEST_F(StabilityFolder, ThatWasStoppedContinuesToTheSameTable) {
  Counter stopped(2), again;
  EXPECT_THROW(run_stability(given(), angles_, in("stopped"), stopped), Stop);
  EXPECT_EQ(read_csv(folder_ / "stopped/stability.csv").rows.size(), 2u);
  run_stability(given(), angles_, in("stopped"), again);
  EXPECT_EQ(again.found, 2);
  EXPECT_EQ(again.computed, 3);
  for (const char* file : {"stability.csv", "result.json", "angle=25/history.csv"})
    EXPECT_EQ(read_file(folder_ / "stopped" / file), read_file(folder_ / "whole" / file)) << file;
  // Each angle starts from the flow of the one before: its time continues.
  EXPECT_GT(read_csv(folder_ / "whole/angle=10/history.csv").column("time_s")[0], 0.3);
}

/// Ends within an angle, some looks at its record after its beginning.
struct StoppedWithin : Counter {
  std::size_t at;
  bool equilibrium;
  int steps = 0;
  StoppedWithin(std::size_t angle, bool windows) : at(angle), equilibrium(windows) {}
  void progress(std::size_t angle, const std::string& text, double) override {
    if (angle != at) return;
    if (equilibrium ? text.starts_with("[2]") : ++steps > 450) throw Stop{};
  }
};

TEST_F(StabilityFolder, StoppedWithinAnAngleContinuesThereByteForByte) {
  StabilitySettings settings = in("within");
  settings.checkpoint_every_s = 0;
  StoppedWithin stopped(1, false);
  EXPECT_THROW(run_stability(given(), angles_, settings, stopped), Stop);
  EXPECT_TRUE(fs::exists(folder_ / "within/angle=10/window/steps"));
  struct : Counter {
    int steps = 0;
    void progress(std::size_t angle, const std::string&, double) override { steps += angle == 1; }
  } again;
  run_stability(given(), angles_, settings, again);
  const std::size_t all = read_csv(folder_ / "whole/angle=10/history.csv").rows.size();
  EXPECT_EQ(again.steps, static_cast<int>(all) - 400) << "two looks of 200 steps were kept";
  for (const char* file : {"stability.csv", "angle=10/history.csv", "angle=10/result.json"})
    EXPECT_EQ(read_file(folder_ / "within" / file), read_file(folder_ / "whole" / file)) << file;
  EXPECT_FALSE(fs::exists(folder_ / "within/angle=10/window"));
}

TEST_F(StabilityFolder, InEquilibriumHasTheFormulasCoefficientsAndItsShapes) {
  Counter observer;
  StabilitySettings settings = in("equilibrium");
  settings.equilibrium = true;
  const StabilityResult result = run_stability(given(), {0, 10}, settings, observer);
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_NEAR(result.rows[1].c_t, 0.7, 0.002);
  EXPECT_NEAR(result.rows[1].c_m, 0.02, 2e-4);
  EXPECT_TRUE(fs::exists(folder_ / "equilibrium/angle=10/canopy.stl"));
}

/// Iterations that never settle: C_T is 0.8 after an odd number of pieces, and 0.6 after an even one.
class SwingingFlow final : public FormulaFlow {
 public:
  explicit SwingingFlow(const FlowProblem& problem) : FormulaFlow(problem), air_(problem.air) {}

  FlowAdvance advance(int iterations, double, const FlowReport&) override {
    done_ += iterations;
    FlowAdvance done;
    done.last = {iterations, 1, 0, 0, 0, 0, 0};
    return done;
  }
  FlowField field() const override {
    FlowField field = FormulaFlow::field();
    const double q = 0.5 * air_.density * dot(air_.velocity, air_.velocity) * 3.14159265358979 / 4;
    field.porous_force = {0, 0, q * (done_ / Stopping::piece % 2 == 1 ? 0.8 : 0.6)};
    field.bodies = {{field.porous_force, {}}};
    return field;
  }

 private:
  Freestream air_;
  int done_ = 0;
};

struct SwingingEngine : FlowEngine {
  std::string name() const override { return "swinging"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<SwingingFlow>(problem);
  }
};

TEST_F(StabilityFolder, OfIterationsThatDoNotSettleHasTheirMeanAndAWarning) {
  add_engine({"swinging",
              "iterations that never settle",
              {.sheets = true, .boundaries = {"slip", "far-field", "fixed-pressure"}},
              [](const EngineOptions&) { return std::string("swinging 1"); },
              [](const EngineOptions&) { return std::make_unique<SwingingEngine>(); }});
  Counter observer;
  Case swings = given();
  swings.flow.engine = "swinging";
  const StabilityResult result = run_stability(swings, {0}, in("swinging"), observer);
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_NEAR(result.rows[0].c_t, 0.7, 1e-9);
  EXPECT_FALSE(result.rows[0].c_t_error);
  EXPECT_FALSE(result.rows[0].enough);
  ASSERT_EQ(result.warnings.size(), 3u);
  EXPECT_EQ(result.warnings[2].find((folder_ / "whole/axis").string() + ": "), 0u) << result.warnings[2];
  EXPECT_NE(result.warnings[1].find("flow cells across the inflated canopy: 8"), std::string::npos)
      << result.warnings[1];
  EXPECT_NE(result.warnings[0].find("0 degrees: the flow did not reach its residual, the row is a mean"),
            std::string::npos)
      << result.warnings[0];
}

TEST_F(StabilityFolder, ALargeMassDefectIsWarnedOfAndThenNotUsable) {
  Counter observer;
  EXPECT_TRUE(result_.usable);
  EXPECT_EQ(result_.rows[0].mass_defect, 1e-4);
  for (const auto& [defect, usable] : {std::pair{0.03, true}, std::pair{0.1, false}}) {
    LeaningFlow::mass_defect = defect;
    const StabilityResult result =
        run_stability(given(), {0}, in(usable ? "defect" : "more-defect"), observer);
    LeaningFlow::mass_defect = 1e-4;
    EXPECT_EQ(result.usable, usable);
    const auto told = std::count_if(result.warnings.begin(), result.warnings.end(), [](const auto& text) {
      return text.find("0 degrees: largest mass defect of the air") == 0;
    });
    EXPECT_EQ(told, 1) << defect;
  }
}

// The shape is that of the steady run on the axis, and so are its warnings.
TEST_F(StabilityFolder, CarriesTheWarningsOfTheRunOnTheAxis) {
  const auto axis = nlohmann::json::parse(read_file(folder_ / "whole/axis/result.json"));
  const std::string name = (folder_ / "whole/axis").string() + ": ";
  const auto& all = result_.warnings;
  int own = 0;
  for (const std::string text : axis.at("warnings")) {
    const auto is = [&](const std::string& one) { return one == text || one == name + text; };
    EXPECT_EQ(std::count_if(all.begin(), all.end(), is), 1) << text;
    ++own;
  }
  EXPECT_GT(own, 0);
}

TEST_F(StabilityFolder, RefusesASteadyRunAtAnotherSpeed) {
  Counter observer;
  Case other = given();
  other.flow.speed_m_s = 10;
  EXPECT_THROW(run_stability(other, {0, 10}, in("other"), observer), Error);
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

TEST_F(StabilityFolder, IsComputedPartByPartWithTheSameNumbers) {
  Counter observer;
  const StabilitySettings parts = in("parts");
  const auto waves = stability_waves(given(), angles_, parts);
  ASSERT_EQ(waves.size(), 5u);  // each angle after the one before
  EXPECT_THROW(run_stability_part(given(), angles_, parts, "angle=0", observer), Error);  // not prepared
  prepare_stability(given(), angles_, parts);
  EXPECT_THROW(run_stability_part(given(), angles_, parts, "angle=10", observer), Error);  // after angle=0
  std::vector<std::string> missing;
  for (const auto& wave : waves) {
    for (const std::string& name : wave) run_stability_part(given(), angles_, parts, name, observer);
    missing.clear();
    gather_stability(given(), angles_, parts, missing, observer);
  }
  EXPECT_TRUE(missing.empty());
  EXPECT_EQ(read_file(folder_ / "parts/stability.csv"), read_file(folder_ / "whole/stability.csv"));
  EXPECT_THROW(run_stability_part(given(), angles_, parts, "angle=11", observer), Error);
  StabilitySettings cold = parts;
  cold.warm = false;
  EXPECT_EQ(stability_waves(given(), angles_, cold).size(), 1u);
  cold.steady.clear();
  EXPECT_EQ(stability_waves(given(), angles_, cold).front(), std::vector<std::string>{axis_name});
}

TEST_F(StabilityFolder, RefusesOtherInputsAndForeignFiles) {
  Counter observer;
  const std::string before = read_file(folder_ / "whole/stability.csv");
  StabilitySettings finer = in("whole");
  finer.across = 9;
  EXPECT_THROW(run_stability(given(), angles_, finer, observer), Error);
  EXPECT_EQ(read_file(folder_ / "whole/stability.csv"), before);
  fs::create_directories(folder_ / "mine");
  write_file(folder_ / "mine/notes.txt", "keep");
  EXPECT_THROW(run_stability(given(), angles_, in("mine"), observer), Error);
  EXPECT_EQ(read_file(folder_ / "mine/notes.txt"), "keep");
}

}  // namespace
}  // namespace ripstop
