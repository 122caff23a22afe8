#include "ripstop/run/flight/flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/opening.h"
#include "ripstop/case/payload.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/finished_opening.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/steady/steady_folder.h"
#include "ripstop/run/steady/warnings.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// How often the standard error is looked at, and so many half-swings it needs at least: ten periods.
constexpr double look_every = 1;  // [s]
constexpr int least_half_swings = 20;
// A start-up longer than this share of the flight is a flight whose motion still changes.
constexpr double longest_start_up = 1.0 / 3;
// Of the mouth at the start, below which a canopy of the second half of a flight counts as partly closed (assumed).
constexpr double open_mouth = 0.8;
constexpr int shots_on_sheet = 8;

/// The equilibrium on the axis; saves its flow.
class AxialRun : public SteadyObserver {
 public:
  AxialRun(FlightObserver& observer, fs::path flow) : observer_(observer), flow_(std::move(flow)) {}
  void progress(const SteadyProgress& progress, const SteadyState& state) override {
    observer_.starting(progress, state);
  }
  void warned(const std::string& text) override { observer_.warned(text); }
  void ended(const SteadyRun& run, const SteadyState&, const SteadyResult&) override {
    run.solver.flow().save(flow_);
  }

 private:
  FlightObserver& observer_;
  fs::path flow_;
};

FlightStart equilibrium_on_axis(const Settings& resolved, int threads, const fs::path& flow,
                                FlightObserver& observer) {
  AxialRun axial(observer, flow);
  SteadySettings settings;
  settings.threads = threads;
  const SteadySolution solution = run_steady(in_full_domain(resolved), axial, settings);
  if (!solution.result.converged)
    observer.warned(
        fmt::format("the canopy on the axis did not come to equilibrium within {} iterations; the "
                    "flight begins with its last shape",
                    solution.result.iterations));
  return {solution.result.speed,
          solution.result.drag_coefficient,
          solution.state.shape,
          solution.state.pressure,
          {},
          true};
}

/// A start and the folder of the state of its air.
struct Beginning {
  FlightStart start;
  fs::path flow;
};

/// The folder of the inflation from whose end a flight continues: `from`, or where the flight computes it first; empty:
/// it starts in equilibrium.
RunSettings inflation_run(const Settings& resolved, const fs::path& from, const fs::path& temporary,
                          FlightObserver& observer) {
  if (!from.empty()) return {from};
  if (resolved.flight().start != FlightSettings::Start::inflation) return {};
  RunSettings run = observer.opening_run();
  if (run.folder.empty()) run.folder = temporary;
  return run;
}

/// Computes the inflation first where `from` is empty.
Beginning end_of_inflation(const Settings& resolved, int threads, const fs::path& from,
                           const RunSettings& run, FlightObserver& observer) {
  if (from.empty()) {
    const LoadSource source = load_source(resolved);
    run_inflation_in(
        {run, threads}, resolved, source, [&] { return opening_problem(resolved, source, threads); },
        observer.opening());
  }
  FinishedOpening opening = finished_opening(run.folder);
  Beginning begin;
  const FlowProblem flow = flow_problem(resolved);
  begin.start.same_flow = flow.grid == opening.flow.grid && flow.sides == opening.flow.sides &&
                          flow.outlet == opening.flow.outlet;
  begin.start.speed = opening.end.speed;
  begin.start.opening = std::move(opening.end);
  begin.flow = opening.at_end;
  return begin;
}

std::optional<double> relative_error(const FlightHistory& history) {
  const FlightSummary s = summarise_flight(history.rows);
  if (s.peaks < least_half_swings || !s.descent.standard_error) return {};
  return *s.descent.standard_error / s.descent.mean;
}

/// Reason why the flight has ended; empty: it continues.
std::string end_of(const FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history) {
  const FlightSettings& s = flight.problem().settings;
  const FreeFlightRow& row = history.rows.back();
  if (const std::string failure = flight.failure(state, row); !failure.empty()) return failure;
  if (s.height_m && row.payload.z <= 0) return "ground";
  if (row.time - flight.began() >= s.duration_s * (1 - 1e-12)) return "duration";
  if (s.standard_error && std::floor(row.time / look_every) > std::floor((row.time - row.step) / look_every))
    if (const auto error = relative_error(history); error && *error <= *s.standard_error)
      return "standard error";
  return "";
}

bool failed(const std::string& ended_by) {
  return ended_by != "ground" && ended_by != "duration" && ended_by != "standard error";
}

void take_means(FlightResult& r, const FlightSummary& s) {
  r.start_up = s.start_up, r.peaks = s.peaks;
  r.descent = s.descent.mean, r.descent_error = s.descent.standard_error;
  const double v = s.descent.mean;
  r.coefficient =
      2 * (r.payload_mass + r.parachute_mass) * standard_gravity / (r.density * v * v * r.reference_area);
  if (r.descent_error) r.coefficient_error = 2 * *r.coefficient * *r.descent_error / v;
  r.glide = s.glide.mean, r.glide_error = s.glide.standard_error;
  if (s.oscillation) r.oscillation = s.oscillation->mean, r.oscillation_error = s.oscillation->standard_error;
  if (s.largest_oscillation)
    r.largest = s.largest_oscillation->mean, r.largest_error = s.largest_oscillation->standard_error;
  if (s.period) r.period = s.period->mean, r.period_error = s.period->standard_error;
  r.roundness = s.roundness, r.mean_angle = s.mean_angle;
  r.mean_attack = s.mean_attack, r.largest_attack = s.largest_attack;
}

/// Mean distance of neighbouring nodes of the cloth: nodes of two canopies that are nearer touch [m].
double contact_gap(const CanopyMesh& mesh) {
  double area = 0;
  int cells = 0;
  for (const Patch& patch : mesh.patches)
    for (const double cut : patch.cell_area)
      if (cut > 0) area += cut, ++cells;
  return std::sqrt(area / cells);
}

FlightCluster cluster_of_flight(const FlightResult& r, const Settings& resolved, const FreeFlight& flight,
                                const FreeFlightState& state, const FlightHistory& history, double start_up) {
  FlightCluster cluster;
  const ClusterKeys& keys = *resolved.written().cluster;
  cluster.canopies = flight.canopies(), cluster.first_spread = keys.spread_angle_deg;
  cluster.pierced = state.pierced;
  if (r.coefficient && keys.single_descent_drag_coefficient)
    cluster.factor = *r.coefficient / *keys.single_descent_drag_coefficient;
  if (!failed(r.ended_by))
    cluster.motion = summarise_cluster(history.canopies, flight.canopies(), flight.began(), start_up,
                                       contact_gap(flight.mesh()));
  if (cluster.motion && !equal_canopies(resolved.written()))
    for (int k = 0; k < flight.canopies(); ++k)
      cluster.motion->canopies[static_cast<std::size_t>(k)].size_ratio = size_ratio(resolved.written(), k);
  return cluster;
}

std::vector<std::string> canopy_warnings(const FlightCluster& cluster) {
  std::vector<std::string> all = {
      "cluster: the flight of a cluster is experimental (docs/guide/cluster-of-canopies.md)"};
  if (cluster.motion && cluster.motion->first_contact)
    all.push_back(
        fmt::format("the canopies of the cluster touch, first at {:.3g} s and for {:.2g} % of the time",
                    *cluster.motion->first_contact, 100 * cluster.motion->contact_share));
  return all;
}

void take_quality(FlightResult& r, const Settings& resolved) {
  std::vector<QualityValue> values = {{"flight_energy_residual", std::abs(r.energy_residual)},
                                      {"flight_momentum_residual", r.momentum_residual},
                                      {"mass_defect", r.mass_defect},
                                      {"cells_across", r.cells_across}};
  if (r.cluster) values.push_back({"pierced_edges", r.cluster->pierced});
  Judgement judgement = judge(values);
  if (r.cluster) judgement.add(canopy_warnings(*r.cluster));
  judgement.add(unused_delays(resolved.written(), "a flight of a cluster"));
  judgement.add(margin_warnings(r.margins));
  judgement.add(mesh_warnings(resolved));
  judgement.add(air_warnings(resolved));
  judgement.add(strain_warnings(resolved, r.stress.strain));
  judgement.add(body_warnings(resolved, flow_grid(resolved.flow()), true,
                              "increase flight.cells_across, or flow.cells"));
  if (r.bodies) judgement.add(flight_body_warnings(resolved, *r.bodies));
  r.warnings = std::move(judgement.warnings);
  if (failed(r.ended_by)) {
    r.warnings.push_back(fmt::format("{}: the result {}; no mean is given", r.ended_by, refused_text));
    judgement.usable = false;
  } else {
    if (r.peaks < least_half_swings)
      r.warnings.push_back(
          fmt::format("the means are over {} half-swings; ten periods (20) or more are needed: take a "
                      "longer flight (flight.duration_s)",
                      r.peaks));
    if (r.start_up > longest_start_up * r.duration)
      r.warnings.push_back(fmt::format(
          "the start-up takes {:.3g} s of {:.3g} s: the motion still changes, and the means depend on "
          "the duration; take a longer flight (flight.duration_s)",
          r.start_up, r.duration));
  }
  r.usable = judgement.usable;
}

std::optional<Handover> handover_of(const Settings& resolved, const FreeFlight& flight,
                                    const FlightStart& start, const FreeFlightState& state,
                                    const FlightHistory& history) {
  if (!start.opening) return {};
  const OpeningEnd& end = *start.opening;
  const FreeFlightRow& first = history.rows.front();
  Handover h;
  h.time = flight.began(), h.same_flow = start.same_flow;
  DeploymentSpeed deployed = opening_speed(resolved);
  h.deployment_speed = deployed.speed, h.deployment_speed_from = std::move(deployed.from);
  h.height_lost = end.fallen, h.opening_speed = end.speed, h.opening_peak = end.peak_load;
  h.path_angle = end.angle * 180 / std::numbers::pi;
  h.load_before = end.load, h.load_after = norm(first.line_force);
  h.drag_before = end.drag, h.drag_after = norm(first.air_force);
  h.elastic_before = end.elastic, h.elastic_after = state.elastic_at_start;
  return h;
}

FlightResult result_of(const Settings& resolved, const FreeFlight& flight, const FlightStart& start,
                       const FreeFlightState& state, const FlightHistory& history,
                       const std::string& ended_by) {
  FlightResult r;
  const FreeFlightRow &last = history.rows.back(), &first = history.rows.front();
  r.title = resolved.title(), r.ended_by = ended_by, r.duration = last.time - flight.began();
  r.payload_mass = *resolved.payload().mass_kg, r.parachute_mass = flight.mass() - r.payload_mass;
  r.air_source = opening_air(resolved).from;
  r.density = resolved.flow().density_kg_m3,
  r.reference_area = area_ratio(resolved.written()) * nominal_area(resolved.parachute());
  if (!start.opening) r.axial_speed = start.speed, r.axial_coefficient = start.coefficient;
  r.known_coefficient = experience(resolved.parachute()).drag_coefficient.if_known();
  const FlightSummary summary = summarise_flight(history.rows);
  if (!failed(ended_by)) take_means(r, summary);
  if (std::vector<FlowBody> rigid = flight.problem().air.flow.bodies; rigid.size() > 1 && !failed(ended_by)) {
    rigid.erase(rigid.begin());
    r.bodies = flight_bodies(resolved, rigid, history.bodies, flight.began(), summary.start_up);
  }
  r.handover = handover_of(resolved, flight, start, state, history);
  r.largest_load = std::max(summary.largest_load, start.opening ? start.opening->peak_load : 0);
  r.load_factor = r.largest_load / (r.payload_mass * standard_gravity);
  const Vec3 way = last.payload - first.payload;
  r.distance = std::hypot(way.x, way.y), r.height_lost = -way.z;
  const FreeFlight::Balance balance = flight.balance(state, last);
  r.energy_residual = balance.energy_residual, r.momentum_residual = balance.momentum_residual;
  const double weight = flight.mass() * standard_gravity;
  for (const FreeFlightRow& row : history.rows)
    r.air_momentum_residual = std::max(r.air_momentum_residual, row.momentum_gap / weight),
    r.mass_defect = std::max(r.mass_defect, row.mass_defect);
  r.cells_across = cells_across(resolved);
  r.stress = state.coupled.highest_stress;
  r.margins = case_margins(resolved, flight.mesh(), state.coupled.record.peak_tension, r.stress);
  r.flow_steps = state.coupled.air.steps, r.cloth_steps = state.coupled.cloth.steps;
  if (flight.canopies() > 1)
    r.cluster = cluster_of_flight(r, resolved, flight, state, history, summary.start_up);
  take_quality(r, resolved);
  if (!start.opening)
    if (const auto warning = mouth_warning(history.rows)) r.warnings.push_back(*warning);
  return r;
}

/// A flight after an inflation that must not be used must not be used either.
void take_end(const RunEnd& inflation, FlightResult& r) {
  add_warnings_of(inflation, r.warnings);
  r.usable = r.usable && inflation.usable;
}

/// Keeps the highest stress of all shapes, and some shapes for the contact sheet.
void look_at_shape(const FreeFlight& flight, FreeFlightState& state) {
  const ClothState& cloth = state.coupled.cloth;
  const std::vector<Vec3> x = positions(cloth, flight.cloth());
  const std::vector<CellStress> stress = cell_stress(flight.cloth(), cloth);
  const StressPeak now = stress_peak(flight.mesh(), x, stress);
  StressPeak& highest = state.coupled.highest_stress;
  if (now.von_mises > highest.von_mises) highest = now, state.coupled.highest_stress_time = cloth.time;
  if (flight.canopies() > 1) state.pierced = std::max(state.pierced, pierced_share(flight.mesh(), x));
  std::vector<Snapshot>& shots = state.coupled.snapshots;
  const double share = cloth.time / flight.problem().settings.duration_s;
  if (double(shots.size()) >= std::min(shots_on_sheet * share + 1, double(shots_on_sheet))) return;
  shots.push_back({cloth.time, x, {}});
  for (const CellStress& cell : stress) shots.back().von_mises.push_back(cell.von_mises);
}

}  // namespace

std::optional<std::string> mouth_warning(const std::vector<FreeFlightRow>& rows) {
  const double middle = 0.5 * (rows.front().time + rows.back().time);
  double area = 0, time = 0;
  for (const FreeFlightRow& row : rows)
    if (row.time >= middle) area += row.step * row.mouth_area, time += row.step;
  const double share = area / (time * rows.front().mouth_area);
  if (share >= open_mouth) return {};
  return fmt::format(
      "in the second half of the flight the mouth has {:.0f} % of its area at the start: narrow rings or "
      "sails may have turned over; use more nodes (parachute.mesh.cloth_nodes), and "
      "inflation.cloth_compression = 0.1 (docs/guide/fly.md)",
      100 * share);
}

std::string to_json(const FlightResult& result) {
  return json_text(result);
}

InflationObserver& FlightObserver::opening() {
  static InflationObserver nobody;
  return nobody;
}

Settings flight_settings(const Case& given, const fs::path& from) {
  if (from.empty()) return resolve(flight_case(given));
  const Settings opening = settings_of_run(from);
  warnings_of_used({from});
  Case folded = given;
  if (folded.inflation.folds == 0 && !folded.inflation.initial_radius_m)
    folded.inflation.folds = opening.inflation().folds;  // that of a closed mouth
  require_same_parachute(opening, from.string(), resolve(foldable_case(folded)));
  return resolve(continued_case(given, opening));
}

FlightSolution run_flight(const Settings& resolved, int threads, FlightObserver& observer,
                          const fs::path& from) {
  require_payload(resolved);
  const TemporaryFolder temporary("flight");
  const std::optional<FlightStart> earlier = observer.earlier_start();
  const RunSettings inflation = inflation_run(resolved, from, temporary.path / "opening", observer);
  Beginning begin;
  if (earlier)
    begin.start = *earlier;
  else if (!inflation.folder.empty())
    begin = end_of_inflation(resolved, threads, from, inflation, observer);
  else
    begin = {equilibrium_on_axis(resolved, threads, temporary.path, observer), temporary.path};
  const FlightStart& start = begin.start;
  observer.started(start);
  const Settings now = start.opening ? resolved : at_speed(resolved, start.speed);
  FlightProblem problem = start.opening ? flight_problem(now, *start.opening, threads)
                                        : flight_problem(now, start.shape, start.pressure, threads);
  EngineOptions options = engine_options(now);
  options.threads = threads;
  options.small_eddies = now.flow().watch.eddies;
  problem.air.engine = engine_of(now).make(options);
  FreeFlight flight(std::move(problem));
  if (!earlier && start.same_flow) flight.air().restore(begin.flow);
  if (!earlier && !start.same_flow) flight.air().continue_from(begin.flow);
  FlightSolution solution;
  auto& [result, state, history] = solution;
  state = flight.start();
  observer.begin(flight, state, history);
  std::string ended_by = history.rows.empty() ? "" : end_of(flight, state, history);
  while (ended_by.empty()) {
    history.rows.push_back(flight.advance(state));
    const std::vector<FlightBodyRow>& bodies = history.rows.back().bodies;
    history.bodies.insert(history.bodies.end(), bodies.begin(), bodies.end());
    if (flight.canopies() > 1)
      for (const CanopyRow& row : flight.canopy_rows(state)) history.canopies.push_back(row);
    ended_by = end_of(flight, state, history);
    const double until = history.rows.back().time - flight.began();
    const bool shape =
        shapes_until(until, now.flight()) > shapes_until(until - history.rows.back().step, now.flight());
    if (shape) look_at_shape(flight, state);
    observer.advanced(flight, state, history, shape);
  }
  result = result_of(now, flight, start, state, history, ended_by);
  if (!inflation.folder.empty()) take_end(end_of_run(inflation.folder), result);
  observer.ended(flight, state, history, result);
  return solution;
}

}  // namespace ripstop::inline run
