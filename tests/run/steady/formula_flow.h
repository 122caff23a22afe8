// A flow that is a formula, so that every expected number is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "ripstop/core/file.h"
#include "ripstop/flow/flow.h"

namespace ripstop {

// Force proportional to the number of cut cells, reached geometrically over the iterations. It remembers its
// last force, as a flow remembers its last field.
class FormulaFlow : public Flow {
 public:
  explicit FormulaFlow(const FlowProblem& problem) : problem_(problem) {}

  void place(std::size_t, const std::vector<Triangle>& surface, const SheetMotion&) override {
    target_ = 0.05 * double(cut_cells(problem_.grid, surface).size()) * problem_.air.speed();
  }
  FlowAdvance advance(int iterations, double residual, const FlowReport& report) override {
    FlowAdvance done;
    for (int i = 1; i <= iterations && !done.converged && !done.stopped; ++i) {
      force_ += 0.3 * (target_ - force_);
      done.last = {i, std::abs(target_ - force_) / target_, 0, 0, 0, 0, force_};
      done.converged = done.last.residual_u < residual;
      done.stopped = report && !report(done.last);
    }
    return done;
  }
  FlowField field() const override {
    FlowField field;
    field.grid = problem_.grid;
    field.pressure.assign(problem_.grid.cells(), 0.0);
    field.velocity.assign(problem_.grid.cells(), Vec3{0, 0, problem_.air.speed()});
    const int layer = problem_.grid.nx * problem_.grid.ny;
    std::fill_n(field.pressure.begin(), layer * 17, 100.0);  // up to z = 2.27 m: within the canopy
    field.porous_force = {0, 0, force_};
    field.momentum_deficit = {0, 0, force_};
    return field;
  }
  bool untouched() const override { return force_ == 1; }
  void start_afresh() override { force_ = 1; }

  void save(const std::filesystem::path& folder) const override {
    write_file(folder / "force", std::string(reinterpret_cast<const char*>(&force_), sizeof force_));
  }
  void restore(const std::filesystem::path& folder) override {
    const std::string bytes = read_file(folder / "force");
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(&force_));
  }

 protected:
  void aim_at(double force) { target_ = force; }   // [N]
  void stand_at(double force) { force_ = force; }  // [N]
  double target() const { return target_; }        // [N]

 private:
  FlowProblem problem_;
  double target_ = 0, force_ = 1;  // [N]
};

struct FormulaEngine : FlowEngine {
  std::string name() const override { return "formula"; }
  std::unique_ptr<Flow> start(const FlowProblem& problem) override {
    return std::make_unique<FormulaFlow>(problem);
  }
};

}  // namespace ripstop
