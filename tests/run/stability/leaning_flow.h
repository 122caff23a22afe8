// A flow in time that is a formula of the stream's direction: coefficients of a canopy that is unstable on its axis and
// trims at 20 degrees.
#pragma once

#include <cmath>
#include <memory>
#include <sstream>

#include "ripstop/flow/projections.h"
#include "tests/run/steady/formula_flow.h"

namespace ripstop {

/// C_T = 0.7, C_N = 0 and C_m = 0.02 sin(9 alpha), with D0 = 1 m; all of them swing. It remembers its steps.
class LeaningFlow final : public FormulaFlow {
 public:
  explicit LeaningFlow(const FlowProblem& problem) : FormulaFlow(problem), stream_(problem.air.velocity) {}

  void stream(Vec3 velocity, Vec3) override { stream_ = velocity; }
  double longest_step(double) override { return 0.001; }
  FlowStep step(double length) override {
    now_.time += length, now_.length = length, ++now_.step;
    now_.mass_defect = mass_defect;
    const double q = 0.5 * 1.2 * dot(stream_, stream_) * 3.14159265358979 / 4;
    const double alpha = angle_of_attack({{0, 0, 1}, stream_}) * 3.14159265358979 / 180;
    const double swing = 0.01 * std::sin(40 * now_.time);
    now_.force = {0, 0, q * (0.7 + swing)};
    // Positive C_m turns the axis away from the stream, which comes towards positive x.
    now_.bodies = {{now_.force, {0, -q * (0.02 * std::sin(9 * alpha) + 0.01 * swing), 0}}};
    return now_;
  }
  FlowStep march(int steps, double courant, const StepReport& report) override {
    for (int n = 0; n < steps; ++n) {
      step(longest_step(courant));
      if (report && !report(now_)) break;
    }
    return now_;
  }
  void save(const std::filesystem::path& folder) const override {
    FormulaFlow::save(folder);
    std::ostringstream text;
    text.precision(17);
    text << now_.step << ' ' << now_.time << ' ' << stream_.x << ' ' << stream_.y << ' ' << stream_.z;
    write_file(folder / "time", text.str());
  }
  void restore(const std::filesystem::path& folder) override {
    FormulaFlow::restore(folder);
    std::istringstream text(read_file(folder / "time"));
    text >> now_.step >> now_.time >> stream_.x >> stream_.y >> stream_.z;
  }

  static inline double mass_defect = 1e-4;  // of every step

 private:
  Vec3 stream_;
  FlowStep now_;
};

struct LeaningEngine : FlowEngine {
  std::string name() const override { return "leaning"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<LeaningFlow>(problem);
  }
};

}  // namespace ripstop
