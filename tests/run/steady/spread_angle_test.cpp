// The spread angle of a cluster in equilibrium, on a flow whose force angle is a formula of the spread angle.
#include "ripstop/run/steady/spread_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../../refusal.h"
#include "../../small_case.h"
#include "ripstop/case/assemble.h"
#include "tests/run/steady/finished_run.h"

namespace ripstop {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The force of each canopy acts at the middle of its cloth, inclined outward by `slope` times the spread angle beyond
/// `zero`.
class LeaningFlow : public FormulaFlow {
 public:
  static inline double zero = 22, slope = -0.5;  // [deg], -

  explicit LeaningFlow(const FlowProblem& problem) : FormulaFlow(problem) {}

  void place(std::size_t, const std::vector<Triangle>& surface, const SheetMotion&) override {
    loads_.clear();
    double drag = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t half = surface.size() / 2;
      Vec3 area, middle;
      double sum = 0;
      for (std::size_t n = k * half; n < (k + 1) * half; ++n) {
        const auto& [a, b, c] = surface[n];
        const Vec3 twice = cross(b - a, c - a);
        area += twice, sum += norm(twice);
        middle += norm(twice) / 3 * (a + b + c);
      }
      middle = middle / sum;
      // An open axisymmetric surface has its mean normal on its axis.
      Vec3 axis = area / norm(area);
      if (axis.z < 0) axis = -1 * axis;
      const double spread = std::atan2(std::hypot(axis.x, axis.y), axis.z) / degree;
      const double direction = degree * (spread + slope * (spread - zero));
      const double side = middle.x > 0 ? 1 : -1;
      SheetLoad load;
      load.triangle = static_cast<int>(k * half);
      load.point = middle;
      load.force = 60 * Vec3{side * std::sin(direction), 0, std::cos(direction)};
      drag += load.force.z;
      loads_.push_back(load);
    }
    aim_at(drag);
  }
  FlowField field() const override {
    FlowField field = FormulaFlow::field();
    field.sheet_loads = loads_;
    return field;
  }

 private:
  std::vector<SheetLoad> loads_;
};

struct LeaningEngine : FlowEngine {
  std::string name() const override { return "leaning"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<LeaningFlow>(problem);
  }
};

Case leaning_case(double first_angle, double zero, double slope = -0.5) {
  static const bool added = [] {
    Abilities can;
    can.sheets = true;
    add_engine({"leaning", "a fixed force angle", can,
                [](const EngineOptions&) { return std::string("leaning 1"); },
                [](const EngineOptions&) { return std::make_unique<LeaningEngine>(); }});
    return true;
  }();
  EXPECT_TRUE(added);
  LeaningFlow::zero = zero, LeaningFlow::slope = slope;
  Case given = flat_circular_case(0.6, 500, 20);
  given.parachute.riser.length_m = 0.6;
  given.parachute.mesh.line_segment_m = 0.2;
  given.cluster = ClusterKeys{2, first_angle, true, {}};
  given.flow.engine = "leaning";
  given.flow.box_m = Vec3{2.8, 1.8, 3.5};
  given.flow.cells = {20, 20, 30};
  given.flow.canopy_position_m = 1.2;
  given.flow.core.size_m = Vec3{};
  given.coupling.load = CanopyLoad::uniform;
  given.coupling.max_iterations = 20;
  given.coupling.threads = 1;
  return given;
}

SpreadTrial linear(double angle, double zero, double slope) {
  return {angle, slope * (angle - zero), 0, 0};
}

TEST(SpreadAngle, FollowsTheForcesToTheEquilibriumFromBothSides) {
  for (const double zero : {12.0, 17.5, 26.0})
    for (const double slope : {-0.1, -0.5, -3.0}) {
      std::vector<SpreadTrial> trials = {linear(20, zero, slope)};
      while (std::abs(trials.back().force_angle) > equilibrium_tolerance && trials.size() < 20)
        trials.push_back(linear(next_spread_angle(trials, {10, 30}).value(), zero, slope));
      EXPECT_LE(trials.size(), 4u) << zero << ", " << slope;
      EXPECT_NEAR(trials.back().angle, zero, -1.001 * equilibrium_tolerance / slope);
    }
}

TEST(SpreadAngle, RemainsBetweenTheEnclosingAngles) {
  const std::vector<SpreadTrial> trials = {{14, 8, 0, 0}, {20, -0.5, 0, 0}, {30, -2, 0, 0}};
  const double next = next_spread_angle(trials, {10, 40}).value();
  EXPECT_GT(next, 14);
  EXPECT_LT(next, 20);
}

TEST(SpreadAngle, EndsAtTheEndOfTheRangeToWhichTheForcesPoint) {
  EXPECT_EQ(next_spread_angle({{27, 3, 0, 0}}, {10, 30}), 30);
  EXPECT_EQ(next_spread_angle({{30, 3, 0, 0}}, {10, 30}), std::nullopt);
  EXPECT_EQ(next_spread_angle({{10, -3, 0, 0}}, {10, 30}), std::nullopt);
  // Forces that are inclined more at a larger angle lead away from an unstable equilibrium.
  EXPECT_EQ(next_spread_angle({{25, 1, 0, 0}, {27, 2, 0, 0}}, {10, 30}), 30);
}

TEST(SpreadAngle, TheRunEndsAtTheAngleWhereForcesPointAlongTheAxes) {
  for (const double zero : {22.0, 30.0}) {
    SteadyObserver silent;
    const Case given = leaning_case(26, zero);
    const SteadySolution solution = run_steady(resolve(checked(given)), silent);
    const SteadyResult& r = solution.result;
    EXPECT_TRUE(r.converged);
    ASSERT_TRUE(r.cluster && r.cluster->search);
    EXPECT_NEAR(r.cluster->spread_angle_deg, zero, 2.2 * equilibrium_tolerance);
    EXPECT_LE(std::abs(r.cluster->force_angle_deg), equilibrium_tolerance);
    ASSERT_GE(r.cluster->search->size(), 2u);
    EXPECT_EQ(r.cluster->search->front().angle, 26);
    EXPECT_NEAR(r.cluster->search->front().force_angle, -0.5 * (26 - zero), 0.3);
    EXPECT_DOUBLE_EQ(r.cluster->search->back().angle, r.cluster->spread_angle_deg);
    EXPECT_EQ(r.cluster->search->back().force_angle, r.cluster->force_angle_deg);
    // The shape is that of this angle: the same as of a run that is given it.
    Case fixed = given;
    fixed.cluster->equilibrium = false;
    fixed.cluster->spread_angle_deg = r.cluster->spread_angle_deg;
    const SteadyResult there = run_steady(resolve(checked(fixed)), silent).result;
    EXPECT_FALSE(there.cluster->search);
    EXPECT_NEAR(r.cluster->force_angle_deg, there.cluster->force_angle_deg, 0.02);
    EXPECT_NEAR(r.cluster->gap / there.cluster->gap, 1, 0.02);
    EXPECT_NEAR(r.drag / there.drag, 1, 1e-3);
    const SteadyResult read = steady_result_from_json(to_json(r));
    EXPECT_EQ(read.cluster->search->size(), r.cluster->search->size());
  }
}

TEST(SpreadAngle, WithoutEquilibriumInTheRangeTheRunIsRefusedWithTheReason) {
  SteadyObserver silent;
  const auto refusal = [&](double first, double zero, double slope) {
    return refusal_of([&] { run_steady(resolve(checked(leaning_case(first, zero, slope))), silent); },
                      ExitCode::not_converged);
  };
  const std::string wide = refusal(26, 60, -0.2);
  EXPECT_NE(wide.find("to 36 deg: at 36 deg the forces of the canopies are inclined outward"),
            std::string::npos)
      << wide;
  EXPECT_NE(wide.find("cluster.spread_angle_deg"), std::string::npos) << wide;
  const std::string narrow = refusal(17, 1, -0.2);
  EXPECT_NE(narrow.find("inclined inward"), std::string::npos) << narrow;
  EXPECT_NE(narrow.find("parachute.riser.length_m"), std::string::npos) << narrow;
}

/// Ends as a killed process does: by leaving.
struct Leaves : SteadyObserver {
  int left = 0;
  void iterated(const SteadyRun&, const SteadyState&, const FlowField&) override {
    if (--left == 0) throw std::runtime_error("killed");
  }
};

TEST(SpreadAngle, AKilledSearchResumesAtItsAngleAndHasTheSameNumbers) {
  const TemporaryFolder folder("spread-killed");
  const Settings resolved = resolve(checked(leaning_case(26, 22)));
  const auto settings = [&](const char* name) {
    return SteadyFolderSettings{{folder.path / name, false}, 1, {}, {}, false};
  };
  SteadyObserver silent;
  const SteadyResult whole = run_steady_in(settings("whole"), resolved, silent).result;
  ASSERT_TRUE(whole.converged);
  ASSERT_GE(whole.iterations, 4);
  for (int left = 1; left < whole.iterations; ++left) {
    const std::string name = "killed" + std::to_string(left);
    Leaves killed;
    killed.left = left;
    EXPECT_THROW(run_steady_in(settings(name.c_str()), resolved, killed), std::runtime_error);
    const SteadyResult resumed = run_steady_in(settings(name.c_str()), resolved, silent).result;
    EXPECT_EQ(resumed.cluster->spread_angle_deg, whole.cluster->spread_angle_deg) << left;
    EXPECT_EQ(resumed.drag, whole.drag) << left;
    EXPECT_EQ(resumed.iterations, whole.iterations) << left;
  }
  EXPECT_EQ(final_state(folder.path / "whole").spread.angle, whole.cluster->spread_angle_deg);
}

}  // namespace
}  // namespace ripstop
