// Finished runs of a steady case on the formula flow, for the use of their numbers.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/core/file.h"
#include "ripstop/flow/engines.h"
#include "ripstop/run/steady/steady_folder.h"
#include "tests/run/steady/formula_flow.h"

namespace ripstop {

/// Its force is `area` q whatever the canopy's shape, reached geometrically: every answer is known in closed form.
class SquareLawFlow : public FormulaFlow {
 public:
  SquareLawFlow(const FlowProblem& problem, double area)
      : FormulaFlow(problem),
        force_(0.5 * problem.air.density * problem.air.speed() * problem.air.speed() * area) {}
  void place(std::size_t, const std::vector<Triangle>&, const SheetMotion&) override { aim_at(force_); }

 private:
  double force_;
};

struct SquareLawEngine : FlowEngine {
  static constexpr double area = 1.1;  // [m2]
  std::string name() const override { return "square law"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<SquareLawFlow>(problem, area);
  }
};

inline void add_square_law() {
  static const bool added = [] {
    Abilities can;
    can.other_air = true;
    add_engine({"square-law", "a fixed drag area", can,
                [](const EngineOptions&) { return std::string("square law 1"); },
                [](const EngineOptions&) { return std::make_unique<SquareLawEngine>(); }});
    return true;
  }();
  (void)added;
}

inline Case square_law_case(std::vector<Setting> more = {}) {
  add_square_law();
  Overrides overrides;
  overrides.engine = "square-law";
  overrides.grid = {20, 20, 30};
  overrides.set = std::move(more);
  overrides.set.push_back({"parachute.mesh.cloth_nodes", "800"});
  overrides.set.push_back({"coupling.threads", "1"});
  return read_case(std::filesystem::path(RIPSTOP_SOURCE_DIR) / "examples/stratos-iv/case.toml", overrides);
}

/// Runs the case into `folder`.
inline SteadyResult fly_square_law(const std::filesystem::path& folder, std::vector<Setting> more = {}) {
  SteadyObserver nobody;
  return run_steady_in({{folder, false}, 1, {}, {}}, resolve(square_law_case(std::move(more))), nobody)
      .result;
}

}  // namespace ripstop
