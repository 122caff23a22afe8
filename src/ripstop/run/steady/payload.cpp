// A steady run of a case with a payload: the speed is changed between the coupling's iterations until the drag of a
// converged one and the payload's own are the weight.
#include "ripstop/case/payload.h"

#include <fmt/format.h>

#include <cmath>

#include "ripstop/run/engine.h"
#include "ripstop/run/steady/coarse_start.h"
#include "ripstop/run/steady/steady_parts.h"

namespace ripstop::inline run {
namespace {

/// The pressures go with the dynamic pressure, those that the acceleration remembers too.
void scale_pressures(SteadyState& state, double ratio) {
  for (double& dp : state.pressure) dp *= ratio;
  state.residual_traction = {ratio * state.residual_traction.at_centre,
                             ratio * state.residual_traction.twist};
  for (auto* history : {&state.accelerator.guesses, &state.accelerator.residuals})
    for (std::vector<double>& values : *history)
      for (double& value : values) value *= ratio;
}

/// Part of the weight carried by the drag of the payload itself at the speed of the state [N].
double own_drag(const Settings& resolved, double speed) {
  return 0.5 * resolved.flow().density_kg_m3 * speed * speed * resolved.payload().drag_area_m2;
}

}  // namespace

// D goes with v^2 as long as the shape stays: the next speed is v (W / D)^(1/2). The coupling iterates the shape at
// the same time, so the search costs about as many iterations as one run.
SteadySolution run_with_payload(const Settings& resolved, SteadyObserver& observer,
                                const SteadySettings& settings, RunClock clock) {
  const double weight = suspended_weight(resolved, *resolved.payload().mass_kg);
  const int most = resolved.coupling().max_iterations;
  Settings now = resolved;
  SteadyParts parts = steady_parts(now, settings);
  SteadySolution solution;
  SteadyState& state = solution.state;
  state = parts.solver->start();
  observer.begin({now, *parts.solver, parts.engine->name()}, state);
  clock.count_earlier(state);
  const auto start = coarse_start(resolved, *parts.solver, state, observer, settings);
  if (start) start->give(state);
  if (state.speed == 0) state.speed = now.flow().speed_m_s, state.speeds = 1;
  const auto drag_over_weight = [&] {
    return (state.iterations.back().fluid_force + own_drag(resolved, state.speed)) / weight;
  };
  const auto take_speed = [&] {
    now = at_speed(now, state.speed);
    parts = parts_with(std::move(parts), now, settings, engine_of(now).can.other_air);
  };
  if (state.speed != now.flow().speed_m_s) take_speed();  // of a coarse start, or of a run that was killed
  if (start) parts.solver->flow().continue_from(start->flow.path);
  for (;;) {
    if (!state.iterations.empty()) {
      const double share = drag_over_weight();
      const bool held = std::abs(share - 1) <= payload_tolerance;
      const bool last = static_cast<int>(state.iterations.size()) >= most;
      if (last || (state.converged && held)) {
        state.converged = state.converged && held;
        break;
      }
      if (!held) {
        state.converged = false;
        state.speed /= std::sqrt(share), ++state.speeds;
        scale_pressures(state, 1 / share);
        take_speed();
      }
    }
    const SteadyRun run{now, *parts.solver, parts.engine->name()};
    solution.flow = parts.solver->iterate(
        state, [&](const SteadyProgress& progress) { observer.progress(progress, state); });
    observer.iterated(run, state, solution.flow);
  }
  solution.result = steady_result(*parts.solver, state, now);
  solution.result.payload = {*resolved.payload().mass_kg,     mass_of_canopies(resolved), weight,
                             own_drag(resolved, state.speed), drag_over_weight(),         state.speeds};
  solution.result.wall_time = clock.elapsed();
  observer.ended({now, *parts.solver, parts.engine->name()}, state, solution.result);
  return solution;
}

}  // namespace ripstop::inline run
