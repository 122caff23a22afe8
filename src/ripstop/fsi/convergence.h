// When the steady loop has converged, and how well the flow has to be known until then.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/flow/flow.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/coupling_settings.h"
#include "ripstop/fsi/steady_state.h"

namespace ripstop::inline fsi {

/// Largest share of the load that regularisation may carry at convergence (assumed).
inline constexpr double regularisation_tolerance = 0.02;

/// e_k and omega of [NFM] Eq. 18 and 19: how far the shape moved.
void enter_shape_change(SteadyIteration& now, const std::vector<Vec3>& before,
                        const std::vector<Vec3>& after);

/// The criteria that the last iteration of a run without convergence fails, in words with numbers. In time the limits
/// for shape and ledger are wider by the scatter of the means, which is not known here.
std::vector<std::string> unmet_criteria(const SteadyIteration& last, const CouplingSettings& settings);

/// The changes of drag and shape in the last iteration with their limits, in words. The drag of a mean in time has no
/// limit.
std::string last_changes(const SteadyIteration& last, const CouplingSettings& settings);

class SteadyConvergence {
 public:
  /// `fixed` are the fixed nodes of the canopy.
  SteadyConvergence(const CouplingSettings& settings, std::optional<Watch> window, std::vector<int> fixed)
      : settings_(settings), window_(window), fixed_(std::move(fixed)) {}

  /// The next flow is to be solved to its residual, or averaged over a whole window: the loop looks converged.
  bool asks_for_full_flow(const SteadyState& state, const SteadyIteration& now) const;

  /// When the flow about the surface of `now` has been advanced enough. Until `in_full` its drag has to settle only: a
  /// flow need not be solved to its last digit while the shape still moves.
  Stopping stopping(const FlowProblem& problem, const SteadyIteration& now, bool in_full) const;

  /// Shape and drag have settled, and the ledger closes. `in_full`: the flow of `now` was solved in full.
  bool reached(const SteadyState& state, const SteadyIteration& now, bool in_full) const;

 private:
  bool shape_settled(const SteadyState& state, const SteadyIteration& now) const;
  double lean_by_chance(const SteadyState& state) const;

  CouplingSettings settings_;
  std::optional<Watch> window_;
  std::vector<int> fixed_;
};

}  // namespace ripstop::inline fsi
