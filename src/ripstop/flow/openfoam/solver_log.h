// Follows the output of the solver, line by line.
#pragma once

#include <string>

#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::openfoam {

class SolverLog {
 public:
  /// The forces function object, if it is on: an iteration ends with its line for porous cells or for pressure.
  enum class Forces { none, porous, pressure };
  /// `parts`: of the box, as large as the one that the solver has; the drag is that of all of them.
  explicit SolverLog(Forces forces, int parts = 1) : forces_(forces), parts_(parts) {}

  /// True when this line completes an iteration: progress() and force() are then its own.
  bool feed(const std::string& line);

  const FlowProgress& progress() const { return done_; }
  Vec3 force() const { return force_; }
  bool converged() const { return converged_; }
  bool not_a_number() const { return not_a_number_; }
  bool floating_point_trap() const { return trap_; }
  bool out_of_memory() const { return out_of_memory_; }
  /// Where the solver is now: for messages.
  int iteration() const { return now_.iteration; }
  const std::string& field() const { return field_; }
  /// First lines of OpenFOAM's own error message; empty when there was none.
  const std::string& fatal() const { return fatal_; }

 private:
  void residual(const std::string& line);

  Forces forces_;
  int parts_;
  bool in_forces_ = false, iterating_ = false;
  bool converged_ = false, not_a_number_ = false, trap_ = false, out_of_memory_ = false;
  int fatal_lines_ = 0;
  FlowProgress now_, done_;
  Vec3 force_;
  std::string field_ = "none";
  std::string fatal_;
};

}  // namespace ripstop::inline flow::openfoam
