#include "ripstop/run/opening/inflation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "ripstop/case/cluster.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/core/words.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/handbook.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

constexpr double slow_opening = 1.5;  // of the rate of descent (assumed)

// The first work is so small that its residual is meaningless.
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
                                                   const InflationHistory& history, double start_up) {
  if (solver.problem().reefing.empty()) return {};
  std::vector<double> lines;
  for (const ReefingLine& line : solver.problem().reefing) lines.push_back(line.length);
  return summarise_stages(history.rows, history.air, lines, state.cuts, solver.problem().settings.low_pass_hz,
                          start_up);
}

std::vector<double> line_peaks(const std::optional<std::vector<StageSummary>>& stages) {
  std::vector<double> peaks;
  for (const StageSummary& stage : stages.value_or(std::vector<StageSummary>{}))
    if (stage.line_peak) peaks.push_back(*stage.line_peak);
  return peaks;
}

// The air of a coupled opening starts impulsively about the folded canopy and strikes it once, which no deployment
// does: the share of a nominal diameter that the stream travels until then. The transients seen ended within 0.03; the
// earliest peak of an opening came after 1.2 (docs/theory/inflation.md).
constexpr double start_up_diameters = 0.1;
constexpr double start_ups_of_a_run = 3;  // in a shorter one the opening may not have had its peak yet

double start_up_of(const Settings& resolved, const Opening& solver) {
  return solver.air()
             ? start_up_diameters * nominal_diameter(resolved.parachute()) / resolved.flow().speed_m_s
             : 0;
}

/// The rigid bodies of its flow.
std::vector<FlowBody> rigid_of(const Opening& solver) {
  std::vector<FlowBody> bodies = solver.problem().air->flow.bodies;
  bodies.erase(bodies.begin());
  return bodies;
}

bool flies(const Opening& solver) {
  return solver.air() && solver.problem().air->payload;
}

void take_peaks(InflationResult& r, const InflationState& state, const InflationHistory& history,
                double start_up) {
  r.peak_load = state.peak_load, r.peak_time = state.peak_time;
  if (start_up <= 0) return;
  r.start_up_time = start_up, r.start_up_peak = 0;
  for (const HistoryRow& row : history.rows)
    if (row.time <= start_up) r.start_up_peak = std::max(*r.start_up_peak, row.largest);
  if (state.peak_time > start_up) return;
  const HighestLoad after = highest_load(history.rows, start_up);
  r.peak_load = after.load, r.peak_time = after.time;
}

/// Values that depend on a steady load are absent without one.
void take_steady_load(InflationResult& r, const LoadSource& source, const Opening& solver,
                      const InflationHistory& history, double start_up) {
  const InflationSettings& settings = solver.problem().settings;
  r.summary = summarise(history.rows, settings.low_pass_hz, start_up);
  r.settled = settled(r.summary, settings.duration_s);
  if (r.settled && !flies(solver)) r.steady_load = r.summary.last_load;
  if (settings.low_pass_hz > 0) {
    r.low_pass = settings.low_pass_hz;
    r.smooth_peak = r.summary.smooth_peak;
    r.smooth_peak_time = r.summary.smooth_peak_time;
  }
  if (!r.steady_load) {
    r.summary.inflation_time.reset(), r.summary.filling_time.reset(), r.summary.settling_time.reset();
    return;
  }
  r.overshoot = r.peak_load / *r.steady_load;
  if (r.smooth_peak) r.smooth_overshoot = *r.smooth_peak / *r.steady_load;
  if (source.steady_drag) r.steady_drag_returned = *r.steady_load / *source.steady_drag;
}

/// Projected area over S0, below which a canopy is folded: an open one has 0.35 to 0.5.
constexpr double folded_share = 0.25;

/// Speed at the start of the opening: after a deployment, that at which the canopy leaves its container [m/s].
double stream_speed(const Settings& resolved, const Opening& solver) {
  return solver.air() ? solver.problem().air->flow.air.speed() : resolved.flow().speed_m_s;
}

/// C_x times the drag of the open canopy at the speed of the opening, and the handbook's methods for a payload.
void compare_with_handbook(InflationResult& r, const Settings& resolved, const LoadSource& source,
                           const Opening& solver) {
  const double speed = stream_speed(resolved, solver);
  const double q = 0.5 * resolved.flow().density_kg_m3 * speed * speed;
  std::optional<double> drag = source.steady_drag;
  std::string from = drag ? "the given steady drag" : "";
  if (!drag && r.steady_load) {
    drag = r.steady_load, from = "the steady load of this opening";
  } else if (!drag && solver.air()) {
    const double coefficient = usual_drag_coefficient(resolved.parachute());
    drag = area_ratio(resolved.written()) * coefficient * nominal_area(resolved.parachute()) * q;
    from = fmt::format("C_D {:.3g} (middle of the handbook range) on S0{} at {:.4g} m/s{}", coefficient,
                       solver.canopies() > 1 ? " of all canopies" : "", speed,
                       speed == resolved.flow().speed_m_s ? "" : ", the speed after the deployment");
  }
  r.estimate = opening_estimate(resolved.parachute(), drag, q, from);
  const double peak = r.smooth_peak.value_or(r.peak_load);
  const bool full = r.filled.value_or(true);
  if (solver.air() && !flies(solver) && drag && full) r.opening_force_coefficient = peak / *drag;
  if (!flies(solver)) return;
  if (r.estimate.load && full) r.finite_mass_factor = peak / *r.estimate.load;
  if (solver.canopies() == 1) r.handbook = handbook_methods(resolved, speed);
}

/// The deployment before the opening, and how the canopy has left its container and filled.
void take_filling(InflationResult& r, const Settings& resolved, const Opening& solver,
                  const InflationState& state, const InflationHistory& history) {
  r.filling_time = r.summary.filling_time;
  if (!solver.air()) return;
  r.deployment = deployment_of(resolved);
  if (const auto& container = state.air.container) {
    r.container_left = container->left;
    r.outside = container->farthest / solver.problem().air->container->canopy_length;
  }
  const auto filling = filling_of(history.frames);
  r.filling_time = filling ? std::optional(filling->time) : std::nullopt;
  const double start_area = history.frames.empty() ? 0 : history.frames.front().size.projected_area;
  const double area =
      nominal_area(resolved.parachute()) * (area_ratio(resolved.written()) / solver.canopies());  // mean
  if (start_area < folded_share * area) r.filled = filling.has_value();
  if (!filling) return;
  r.growth_exponent = filling->exponent;
  double path = filling->time * stream_speed(resolved, solver);
  if (flies(solver))
    for (const AirRow& row : history.air)
      if (row.time <= filling->time) path = row.path;
  r.filling_distance = path / nominal_diameter(resolved.parachute());
}

/// A case with a payload has as flow.speed_m_s an estimate of its rate of descent.
std::vector<std::string> slow_opening_warnings(const Settings& resolved, const Opening& solver) {
  const double speed = stream_speed(resolved, solver);
  if (!resolved.payload().mass_kg || resolved.payload().deployment_speed_m_s) return {};
  const double rate = payload_first_speed(resolved.written(), resolved.flow().density_kg_m3);
  if (speed > slow_opening * rate) return {};
  return {fmt::format(
      "the opening begins at {} m/s, which is about the rate of descent of its payload ({} m/s), so its load "
      "is too small for a deployment: give the airspeed at line stretch with --speed or "
      "payload.deployment_speed_m_s",
      rounded(speed, 3), rounded(rate, 3))};
}

/// Cells of the flow that are too coarse for the canopy; a uniform pressure has none.
std::vector<std::string> coarse_cells_warnings(const Settings& resolved, const Opening& solver) {
  if (!solver.air()) return {};
  return judge({{"cells_across", cells_across(resolved)}}).warnings;
}

/// Of rigid bodies: a uniform pressure does not have their wake.
std::vector<std::string> opening_body_warnings(const Settings& resolved, const Opening& solver) {
  if (resolved.written().bodies.empty()) return {};
  if (solver.air())
    return body_warnings(resolved, solver.problem().air->flow.grid, true,
                         "increase flow.cells, or narrow flow.core.size_m");
  return {
      fmt::format("body.{}: an opening under a uniform pressure has no wake of a body but that in its "
                  "pressure; set inflation.air = \"coupled\" for one in the flow",
                  resolved.written().bodies.begin()->first)};
}

ClusterOpening openings_of(const Settings& resolved, const Opening& solver, const InflationHistory& history,
                           double start_up) {
  ClusterOpening cluster =
      summarise_openings(history.canopies, solver.canopies(), start_up, solver.problem().delays);
  if (!equal_canopies(resolved.written()))
    for (int k = 0; k < solver.canopies(); ++k)
      cluster.canopies[static_cast<std::size_t>(k)].size_ratio = size_ratio(resolved.written(), k);
  return cluster;
}

/// A canopy that has not filled, although the mean of all canopies has.
std::vector<std::string> unfilled_warnings(const ClusterOpening& cluster, double duration) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < cluster.canopies.size(); ++k)
    if (!cluster.canopies[k].filling_time)
      all.push_back(fmt::format(
          "canopy {} of the cluster has not filled within inflation.duration_s = {:g} s: its peak "
          "load is that until then; increase the duration{}",
          k + 1, duration, cluster.canopies[k].delay.value_or(0) > 0 ? ", or reduce its delay" : ""));
  return all;
}

void take_quality(InflationResult& r, const Settings& resolved, const Opening& solver,
                  const InflationHistory& history) {
  r.energy_residual = energy_residual(history.frames);
  for (const InflationFrame& frame : history.frames) {
    r.contact_depth = std::max(r.contact_depth, frame.contact_depth);
    r.pierced = std::max(r.pierced, frame.pierced);
  }
  std::vector<QualityValue> values = {{"energy_residual", r.energy_residual},
                                      {"start_strain", r.start_strain}};
  if (solver.problem().settings.contact_pa > 0)
    values.insert(values.end(), {{"pierced_edges", r.pierced}, {"contact_depth", r.contact_depth}});
  if (solver.air()) {
    double gap = 0, defect = 0;
    for (const AirRow& row : history.air) {
      gap = std::max(gap, std::abs(row.momentum_gap));
      if (row.time >= r.start_up_time.value_or(0)) defect = std::max(defect, row.mass_defect);
    }
    r.momentum_residual = gap / r.peak_load, r.mass_defect = defect;
    r.cells_across = cells_across(resolved);
    values.insert(values.end(), {{"momentum_residual", *r.momentum_residual},
                                 {"mass_defect", *r.mass_defect},
                                 {"cells_across", *r.cells_across}});
    const double peak_time = r.smooth_peak_time.value_or(r.peak_time);
    if (r.start_up_time && !history.rows.empty() &&
        history.rows.back().time > start_ups_of_a_run * *r.start_up_time)
      values.push_back({"peak_after_start_up", peak_time / *r.start_up_time});
  }
  Judgement judgement = judge(values);
  if (r.cluster)
    judgement.add({"cluster: the opening of a cluster is experimental (docs/guide/cluster-of-canopies.md)"});
  judgement.add(margin_warnings(r.margins));
  if (flies(solver)) judgement.add(payload_drag_warnings(resolved, r.bodies));
  if (r.outside && !r.container_left)
    judgement.add({fmt::format(
        "the canopy has not left its container within inflation.duration_s = {:g} s: {:.0f} % of its length "
        "are outside. The opening load may occur later; increase the duration, or decrease "
        "deployment.strip_force_n",
        solver.problem().settings.duration_s, 100 * *r.outside)});
  if (!r.filled.value_or(true))
    judgement.add(
        {fmt::format("the canopy has not filled within inflation.duration_s = {:g} s: peak loads are "
                     "those until then, and C_x and X_1 are not computed; increase the duration",
                     solver.problem().settings.duration_s)});
  if (r.cluster && r.filled.value_or(true))
    judgement.add(unfilled_warnings(*r.cluster, r.settings.duration_s));
  std::optional<double> distance;
  for (const AirRow& row : history.air)
    if (row.time <= r.smooth_peak_time.value_or(r.peak_time))
      distance = row.path / nominal_diameter(resolved.parachute());
  const double peak = r.smooth_peak.value_or(r.peak_load);
  if (const auto text = handbook_disagreement(peak, distance, r.handbook)) judgement.add({*text});
  if (solver.air() && r.estimate.load)
    if (const auto text = above_infinite_mass(peak, *r.estimate.load, flies(solver))) judgement.add({*text});
  if (!solver.air() && has_default_damping(solver.problem().settings))
    judgement.add({fmt::format(
        "the peak load is not a prediction in uniform-pressure inflation: {}. Calibrate the damping on a "
        "measured peak (ripstop calibrate damping), or set inflation.air = \"coupled\"",
        limit_of_damping(solver.problem().settings))});
  judgement.add(r.source.warnings);
  judgement.add(slow_opening_warnings(resolved, solver));
  judgement.add(opening_body_warnings(resolved, solver));
  judgement.add(mesh_warnings(resolved));
  if (solver.air()) judgement.add(air_warnings(resolved));
  judgement.add(strain_warnings(resolved, r.stress.strain));
  r.usable = judgement.usable;
  r.warnings = std::move(judgement.warnings);
}

InflationResult result_of(const Settings& resolved, const LoadSource& source, const Opening& solver,
                          const InflationState& state, const InflationHistory& history) {
  const double start_up = start_up_of(resolved, solver);
  InflationResult r;
  r.title = resolved.title();
  r.source = source;
  DeploymentSpeed deployed = opening_speed(resolved);
  r.speed = deployed.speed, r.speed_source = std::move(deployed.from);
  OpeningAir air = opening_air(resolved);
  r.height = air.height, r.density = air.density, r.air_source = std::move(air.from);
  r.settings = solver.problem().settings;
  take_peaks(r, state, history, start_up);
  take_steady_load(r, source, solver, history, start_up);
  take_filling(r, resolved, solver, state, history);
  r.impulse = state.impulse;
  if (!solver.air()) r.pressure = solver.problem().pressure;
  for (const AirRow& row : history.air)
    r.drag_area = std::max(r.drag_area.value_or(row.drag_area), row.drag_area);
  if (solver.air()) {
    r.added_mass = state.air.added_mass;
    r.bodies = opening_bodies(resolved, rigid_of(solver), history.bodies, start_up);
  }
  if (flies(solver)) {
    r.end_speed = state.air.flight.speed;
    r.end_angle = state.air.flight.angle * 180 / std::numbers::pi;
    r.height_lost = state.air.flight.fallen;
  }
  r.viscosity_limit = solver.viscosity_limit();
  r.folds = solver.folded().folds;
  r.inner_fold_radius = solver.folded().inner_radius;
  r.outer_fold_radius = solver.folded().outer_radius;
  r.start_strain = start_strain(solver.mesh(), solver.folded().positions).largest;
  r.line_peaks = solver.peak_tension_of_lines(state);
  r.max_line_tension = *std::max_element(r.line_peaks.begin(), r.line_peaks.end());
  r.stress = state.highest_stress;
  r.stress_time = state.highest_stress_time;
  r.stages = stages_of(solver, state, history, start_up);
  r.margins = case_margins(resolved, solver.mesh(), state.record.peak_tension, r.stress, line_peaks(r.stages),
                           r.peak_load);
  compare_with_handbook(r, resolved, source, solver);
  if (solver.canopies() > 1) r.cluster = openings_of(resolved, solver, history, start_up);
  take_quality(r, resolved, solver, history);
  r.steps = state.cloth.steps;
  r.step_changes = state.step_changes;
  return r;
}

/// How long the air of an opening will take on one thread, about [s]. Its steps follow from the Courant number of the
/// smallest cells in air at twice the speed of the stream (assumed: about the edges of an open canopy). A step sweeps
/// the cells and finds the faces of the cells that every part of the cloth cuts, which takes most of the time.
double flow_seconds(const AirProblem& air, double duration, int nodes) {
  constexpr double cells_a_second = 7.5e6;  // docs/tables/pimplefoam.md, of one of two cores
  constexpr double seconds_a_node =
      2e-5;                      // 72 steps about a cross of 25,246 nodes took 49 s of processor time
  constexpr double fastest = 2;  // of the stream's speed
  const FlowGrid& grid = air.flow.grid;
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < grid.count(axis); ++i) smallest = std::min(smallest, grid.width(axis, i));
  const double step = air.courant * smallest / (fastest * air.flow.air.speed());
  return duration / step * (grid.cells() / cells_a_second + seconds_a_node * nodes);
}

/// The next block. An opening that diverges in cells that are too coarse states so.
std::vector<HistoryRow> advanced(Opening& solver, InflationState& state, InflationHistory& history,
                                 const std::vector<std::string>& coarse) {
  try {
    const std::size_t before = history.air.size();
    std::vector<HistoryRow> rows = solver.advance(state, &history.air);
    add_body_rows(history.air, before, history.bodies);
    return rows;
  } catch (const Error& error) {
    if (coarse.empty() || error.code() != ExitCode::diverged) throw;
    throw restated(error, fmt::format("{}; the probable cause is the {}", error.what(), coarse.front()));
  }
}

}  // namespace

std::string to_json(const InflationResult& result) {
  return json_text(result);
}

std::vector<std::string> opening_warnings(const Settings& resolved, const Opening& solver) {
  std::vector<std::string> warnings = slow_opening_warnings(resolved, solver);
  for (std::string& text : coarse_cells_warnings(resolved, solver)) warnings.push_back(std::move(text));
  for (std::string& text : opening_body_warnings(resolved, solver)) warnings.push_back(std::move(text));
  return warnings;
}

double opening_seconds(const Opening& solver, const InflationState& start) {
  constexpr double nodes_a_second = 1.25e8;  // docs/tables/performance.md
  const InflationProblem& problem = solver.problem();
  const double duration = problem.settings.duration_s;
  const double cloth = duration / start.step * solver.mesh().node_count() / nodes_a_second;
  return problem.air ? 2 * cloth + flow_seconds(*problem.air, duration, solver.mesh().node_count())
                     : cloth;  // predicted and corrected
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
  for (const std::string& text : opening_warnings(resolved, solver)) observer.warned(text);
  const std::vector<std::string> coarse = coarse_cells_warnings(resolved, solver);
  while (state.blocks < solver.blocks()) {
    const std::vector<HistoryRow> rows = advanced(solver, state, history, coarse);
    history.rows.insert(history.rows.end(), rows.begin(), rows.end());
    if (solver.canopies() > 1)
      for (const CanopyRow& row : solver.canopy_rows(state)) history.canopies.push_back(row);
    const bool at_frame = solver.at_frame(state);
    if (at_frame) history.frames.push_back(solver.frame(state));
    observer.advanced(solver, state, history, at_frame ? &history.frames.back() : nullptr);
  }
  result = result_of(resolved, source, solver, state, history);
  observer.ended(solver, state, history, result);
  return solution;
}

}  // namespace ripstop::inline run
