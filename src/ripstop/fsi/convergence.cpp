#include "ripstop/fsi/convergence.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/core/words.h"
#include "ripstop/fsi/ledger.h"

namespace ripstop::inline fsi {
namespace {

// The drag has settled when it moved by less than this within one piece of the flow's solution: about half the
// default tolerance on the drag's change from one coupling iteration to the next. With the load of the flow the next
// shape has other cell faces at the skirt, which move the drag by 2 % in the first iterations.
constexpr double settled_drag = 5e-4, settled_drag_of_flow = 2e-3;
// Largest difference of momentum deficit and drag at the end.
constexpr double settled_wake = 0.015;
// Share of the drag by which a flow in full may still change: half of the default tolerance on its change.
constexpr double most_drag_left = 2.5e-3;

/// "0.18 % (limit 0.5 %)", "less than 0.005 % (limit 0.5 %)"
std::string with_limit(double value, double limit, const char* unit) {
  const double small = 0.01 * limit;
  if (value < small) return fmt::format("less than {0:g} {2} (limit {1:g} {2})", small, limit, unit);
  const auto [shown, allowed] = rounded_apart(value, limit, 2);
  return fmt::format("{} {} (limit {} {})", shown, unit, allowed, unit);
}

/// With the load of the flow the drag before is that of a flow which was left early. A change of up to twice the tolerance
/// is then accepted where the drag agrees with the load on the cloth.
bool agrees_with_load(const SteadyIteration& last, const CouplingSettings& settings, double tolerance) {
  return settings.load == CanopyLoad::of_flow && last.drag_change < 2 * tolerance &&
         std::abs(last.nodal_load / last.fluid_force - 1) < tolerance;
}

bool drag_settled(const SteadyIteration& last, const CouplingSettings& settings, double chance = 0) {
  const double tolerance = settings.drag_tolerance + chance;
  return last.drag_change < tolerance || agrees_with_load(last, settings, tolerance);
}

std::string drag_change_text(const SteadyIteration& last, const CouplingSettings& settings) {
  const bool twice = last.drag_change >= settings.drag_tolerance &&
                     agrees_with_load(last, settings, settings.drag_tolerance);
  return with_limit(100 * last.drag_change, (twice ? 200 : 100) * settings.drag_tolerance, "%");
}

std::string shape_change_text(const SteadyIteration& last, const CouplingSettings& settings) {
  return with_limit(1000 * last.shape_change, 1000 * settings.shape_tolerance_m, "mm");
}

}  // namespace

void enter_shape_change(SteadyIteration& now, const std::vector<Vec3>& before,
                        const std::vector<Vec3>& after) {
  double moved = 0, size = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    now.shape_change += norm(after[i] - before[i]) / double(after.size());
    moved += dot(after[i] - before[i], after[i] - before[i]);
    size += dot(before[i], before[i]);
  }
  now.omega = std::sqrt(moved / size);
}

std::vector<std::string> unmet_criteria(const SteadyIteration& last, const CouplingSettings& settings) {
  std::vector<std::string> unmet;
  if (!(last.shape_change < settings.shape_tolerance_m))
    unmet.push_back("the shape changes by " + shape_change_text(last, settings));
  if (!last.in_time && !drag_settled(last, settings))
    unmet.push_back(std::isfinite(last.drag_change)
                        ? "the drag changes by " + drag_change_text(last, settings)
                        : "the drag is known from one iteration only");
  if (!(last.regularisation_share < regularisation_tolerance))
    unmet.push_back(
        fmt::format("slack cloth is restrained to the previous shape by {} of the load",
                    with_limit(100 * last.regularisation_share, 100 * regularisation_tolerance, "%")));
  if (!ledger_closes(last, ledger_tolerance))
    unmet.push_back("air load, cloth load and line load differ by " +
                    with_limit(100 * ledger_gap(last), 100 * ledger_tolerance, "%"));
  if (!last.flow_converged && !(last.flow_averaged > 0 && momentum_closes(last, ledger_tolerance)))
    unmet.emplace_back("the flow has not converged");
  if (unmet.empty()) unmet.emplace_back("the last flow solution was not solved to the full tolerance");
  return unmet;
}

std::string last_changes(const SteadyIteration& last, const CouplingSettings& settings) {
  if (last.in_time)
    return fmt::format("last change of the shape {:.2g} mm (limit {:g} mm and the scatter of the means)",
                       1000 * last.shape_change, 1000 * settings.shape_tolerance_m);
  if (!std::isfinite(last.drag_change))
    return "last change of the shape " + shape_change_text(last, settings);
  return fmt::format("last change of the drag {}, of the shape {}", drag_change_text(last, settings),
                     shape_change_text(last, settings));
}

// Random displacement of the canopy between two means in time with the standard error of the last one: twice
// the standard error of the direction of the load, times the mean distance from the fixed end [m].
double SteadyConvergence::lean_by_chance(const SteadyState& state) const {
  if (state.iterations.empty() || !state.iterations.back().in_time) return 0;
  const Vec3& fixed = state.shape[fixed_.front()];
  double distance = 0;
  for (const Vec3& x : state.shape) distance += norm(x - fixed) / double(state.shape.size());
  const Vec3& error = state.window.side_error;
  const double lean =
      2 * std::sqrt(2.) * std::hypot(error.x, error.y) / std::abs(state.window.drag) * distance;
  return std::isfinite(lean) ? lean : 0;
}

bool SteadyConvergence::shape_settled(const SteadyState& state, const SteadyIteration& now) const {
  return now.shape_change < settings_.shape_tolerance_m + lean_by_chance(state);
}

bool SteadyConvergence::asks_for_full_flow(const SteadyState& state, const SteadyIteration& now) const {
  if (state.iterations.empty() || !shape_settled(state, now)) return false;
  const SteadyIteration& last = state.iterations.back();
  // Cloth with regularisation does not justify a whole window.
  if (state.in_time) return now.regularisation_share < regularisation_tolerance && last.in_time;
  // With CanopyLoad::of_flow, the drag of a flow that was left early does not show whether it settles.
  return settings_.load == CanopyLoad::of_flow || last.drag_change < settings_.drag_tolerance;
}

// The load of the flow follows the wake, whose growth the drag alone does not show: a flow in full waits for it. Until
// then the wake develops from one shape to the next. If the drag settles away from the load on the cloth, the force
// balance cannot close in this iteration, and the flow is not solved in full. A flow that is not averaged where it does
// not converge has to meet its residual only.
Stopping SteadyConvergence::stopping(const FlowProblem& problem, const SteadyIteration& now,
                                     bool in_full) const {
  Stopping stopping = problem.stopping;
  const bool of_flow = settings_.load == CanopyLoad::of_flow && stopping.average_over > 0;
  const double settled = of_flow ? settled_drag_of_flow : settled_drag;
  if (!in_full) stopping.settled_drag = settled;
  if (!of_flow || !in_full) return stopping;
  stopping.momentum_gap = settled_wake;
  stopping.most_drag_left = most_drag_left;
  // The drag of an iteration of the flow is that of all bodies.
  if (problem.bodies.size() == 1) {
    stopping.settled_drag = settled;
    stopping.reference_drag = now.nodal_load;
    stopping.near = ledger_tolerance + (window_ ? window_->standard_error : 0);
  }
  return stopping;
}

// Before a window, drag and force balance need not be more accurate than the mean in time will be. In time only the
// force balance is tested: the nodal load is the mean of the previous windows, from which this one may differ by
// twice the standard error of the difference.
bool SteadyConvergence::reached(const SteadyState& state, const SteadyIteration& now, bool in_full) const {
  if (!shape_settled(state, now) || (state.in_time && !in_full)) return false;
  double chance = window_ ? window_->standard_error : 0;
  if (state.in_time)
    chance = 2 * std::hypot(now.drag_error, state.iterations.back().drag_error) / std::abs(now.fluid_force);
  const double tolerance = ledger_tolerance + chance;
  const bool settled = state.in_time || drag_settled(now, settings_, chance);
  const bool flow_known = now.flow_converged || (now.flow_averaged > 0 && momentum_closes(now, tolerance));
  return settled && now.regularisation_share < regularisation_tolerance && flow_known &&
         ledger_closes(now, tolerance);
}

}  // namespace ripstop::inline fsi
