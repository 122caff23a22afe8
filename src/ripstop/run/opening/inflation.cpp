#include "ripstop/run/opening/inflation.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"

namespace ripstop {
namespace {

// The first work is so small that its residual says nothing.
constexpr double share_of_work_judged = 0.1;

double energy_residual(const std::vector<InflationFrame>& frames) {
  double most = 0, worst = 0;
  for (const InflationFrame& frame : frames) most = std::max(most, frame.pressure_work);
  for (const InflationFrame& frame : frames)
    if (frame.pressure_work >= share_of_work_judged * most) worst = std::max(worst, std::abs(frame.residual));
  return worst;
}

/// Nothing of an opening that is not reefed.
std::optional<std::vector<StageSummary>> stages_of(const Opening& solver, const InflationState& state,
                                                   const InflationHistory& history) {
  if (solver.problem().reefing.empty()) return {};
  std::vector<double> lines;
  for (const ReefingLine& line : solver.problem().reefing) lines.push_back(line.length);
  return summarise_stages(history.rows, history.air, lines, state.cuts,
                          solver.problem().settings.low_pass_hz);
}

std::vector<double> line_peaks(const std::optional<std::vector<StageSummary>>& stages) {
  std::vector<double> peaks;
  for (const StageSummary& stage : stages.value_or(std::vector<StageSummary>{}))
    if (stage.line_peak) peaks.push_back(*stage.line_peak);
  return peaks;
}

InflationResult result_of(const Settings& resolved, const LoadSource& source, const Opening& solver,
                          const InflationState& state, const InflationHistory& history) {
  const InflationSettings& settings = solver.problem().settings;
  InflationResult r;
  r.title = resolved.title();
  r.peak_load = state.peak_load;
  r.peak_time = state.peak_time;
  r.summary = summarise(history.rows, settings.low_pass_hz);
  const double steady = r.summary.steady_load;
  if (settings.low_pass_hz > 0) {
    r.low_pass = settings.low_pass_hz;
    r.smooth_peak = r.summary.smooth_peak;
    r.smooth_peak_time = r.summary.smooth_peak_time;
    r.smooth_overshoot = r.summary.smooth_peak / steady;
  }
  r.overshoot = r.peak_load / steady;
  r.impulse = state.impulse;
  if (!solver.air()) r.pressure = solver.problem().pressure;
  for (const AirRow& row : history.air)
    r.drag_area = std::max(r.drag_area.value_or(row.drag_area), row.drag_area);
  if (solver.air()) r.added_mass = state.air.added_mass;
  if (solver.air() && solver.problem().air->payload) {
    r.end_speed = state.air.flight.speed;
    r.end_angle = state.air.flight.angle * 180 / std::numbers::pi;
    r.height_lost = state.air.flight.fallen;
  }
  r.source = source;
  if (source.steady_drag) r.steady_drag_returned = steady / *source.steady_drag;
  r.settings = settings;
  r.viscosity_limit = solver.viscosity_limit();
  r.folds = solver.folded().folds;
  r.inner_fold_radius = solver.folded().inner_radius;
  r.outer_fold_radius = solver.folded().outer_radius;
  r.start_strain = start_strain(solver.mesh(), solver.folded().positions).largest;
  r.line_peaks = solver.peak_tension_of_lines(state);
  r.max_line_tension = *std::max_element(r.line_peaks.begin(), r.line_peaks.end());
  r.stress = state.highest_stress;
  r.stress_time = state.highest_stress_time;
  r.break_load = resolved.materials().canopy.break_load_n_m;
  if (r.break_load > 0) r.cloth_margin = r.break_load / std::max(r.stress.warp, r.stress.weft);
  r.stages = stages_of(solver, state, history);
  r.margins =
      case_margins(resolved, solver.mesh(), state.record.peak_tension, r.stress, line_peaks(r.stages));
  r.energy_residual = energy_residual(history.frames);
  for (const InflationFrame& frame : history.frames) {
    r.contact_depth = std::max(r.contact_depth, frame.contact_depth);
    r.pierced = std::max(r.pierced, frame.pierced);
  }
  r.estimate = opening_estimate(resolved.parachute(), source.steady_drag.value_or(steady));
  r.settled = settled(r.summary, solver.problem().settings.duration_s);
  r.steps = state.cloth.steps;
  r.step_changes = state.step_changes;
  return r;
}

}  // namespace

std::string to_json(const InflationResult& result) {
  return json_text(result);
}

double opening_seconds(const Opening& solver, const InflationState& start) {
  constexpr double nodes_a_second = 1.25e8;  // docs/tables/performance.md
  return solver.problem().settings.duration_s / start.step * solver.mesh().node_count() / nodes_a_second;
}

InflationProblem with_engine(const Settings& resolved, InflationProblem problem) {
  if (!problem.air) return problem;
  EngineOptions options = engine_options(resolved);
  options.threads = problem.threads;
  problem.air->engine = engine_of(resolved).make(options);
  return problem;
}

InflationSolution run_inflation(const Settings& resolved, const LoadSource& source, InflationProblem problem,
                                InflationObserver& observer) {
  const std::unique_ptr<Opening> opening = make_opening(with_engine(resolved, std::move(problem)));
  Opening& solver = *opening;
  InflationSolution solution;
  auto& [result, state, history] = solution;
  state = solver.start();
  observer.begin(solver, state, history);
  while (state.blocks < solver.blocks()) {
    const std::vector<HistoryRow> rows = solver.advance(state, &history.air);
    history.rows.insert(history.rows.end(), rows.begin(), rows.end());
    const bool at_frame = solver.at_frame(state);
    if (at_frame) history.frames.push_back(solver.frame(state));
    observer.advanced(solver, state, history, at_frame ? &history.frames.back() : nullptr);
  }
  result = result_of(resolved, source, solver, state, history);
  observer.ended(solver, state, history, result);
  return solution;
}

}  // namespace ripstop
