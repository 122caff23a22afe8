#include "ripstop/run/steady/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "ripstop/canopy/mirror.h"
#include "ripstop/case/assemble.h"
#include "ripstop/case/bodies.h"
#include "ripstop/case/cluster.h"
#include "ripstop/case/cost.h"
#include "ripstop/case/resolve.h"
#include "ripstop/core/error.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/quality.h"
#include "ripstop/run/steady/cluster_result.h"
#include "ripstop/run/steady/coarse_start.h"
#include "ripstop/run/steady/steady_parts.h"
#include "ripstop/run/steady/warnings.h"

namespace ripstop::inline run {
namespace {

using nlohmann::json;

double dynamic_pressure(const Settings& resolved) {
  const FlowSettings& flow = resolved.flow();
  return 0.5 * flow.density_kg_m3 * flow.speed_m_s * flow.speed_m_s;
}

void take_quality(SteadyResult& r, const Settings& resolved, bool own_mesh) {
  const auto gap = [&](double force) { return std::abs(force / r.ledger.fluid_force - 1); };
  std::vector<QualityValue> values = {
      {"ledger_gap", std::max(gap(r.ledger.nodal_load), gap(r.ledger.line_tension))},
      {"momentum_deficit_gap", gap(r.ledger.momentum_deficit)}};
  if (r.unsteady) values.push_back({"mass_defect", r.unsteady->watched.mass_defect});
  if (std::isfinite(r.last.drag_left)) values.push_back({"drag_left", r.last.drag_left});
  if (r.domain && r.domain->asymmetry)
    values.push_back({"canopy_asymmetry", *r.domain->asymmetry / r.size.projected_diameter});
  Judgement judgement = judge(values);
  if (r.cluster) judgement.add(cluster_warnings(*r.cluster));
  judgement.add(unused_delays(resolved.written(), "a steady run"));
  judgement.add(margin_warnings(r.margins));
  judgement.add(warnings_of(resolved, r.stress.strain, own_mesh));
  const bool needs_cells = resolved.coupling().load == CanopyLoad::of_flow;
  r.usable = judgement.usable && (!needs_cells || judge({{"cells_across", cells_across(resolved)}}).usable);
  r.warnings = std::move(judgement.warnings);
}

SolvedDomain solved_domain(const SteadySolver& solver, const SteadyState& state) {
  SolvedDomain domain{solver.full_box_because().empty() ? "quarter" : "full", solver.full_box_because(), {}};
  if (!domain.because.empty()) return domain;
  if (const std::optional<MirrorImages> images = mirror_images(solver.mesh()))
    domain.asymmetry = mirror_gap(solver.mesh(), *images, state.shape);
  return domain;
}

UnsteadyResult unsteady_result(const WindowAverage& watched, const Settings& resolved) {
  UnsteadyResult result;
  result.watched = watched;
  // Not a number in JSON.
  if (std::isfinite(watched.error)) result.standard_error = watched.error;
  for (double* error : {&result.watched.error, &result.watched.side_error.x, &result.watched.side_error.y})
    if (!std::isfinite(*error)) *error = 0;
  result.strouhal = watched.swing * inflated_diameter(resolved.parachute()) / resolved.flow().speed_m_s;
  return result;
}

std::vector<BodyResult> body_results(const std::vector<FlowBody>& bodies, const SteadyState& state,
                                     const Settings& resolved) {
  std::vector<BodyResult> results;
  for (std::size_t n = 0; n < state.body_forces.size(); ++n) {
    const FlowBody& body = bodies.at(n + 1);
    const Vec3 force = state.body_forces[n];
    const double area = reference_area(resolved, body);
    results.push_back({body.name,
                       force.z,
                       std::hypot(force.x, force.y),
                       state.body_moments[n],
                       area,
                       force.z / (dynamic_pressure(resolved) * area),
                       {}});
    if (n < state.body_errors.size() && std::isfinite(state.body_errors[n]))
      results.back().standard_error = state.body_errors[n];
  }
  return results;
}
}  // namespace

SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Settings& resolved) {
  SteadyResult r;
  r.title = resolved.title();
  r.last = state.iterations.back();
  r.speed = resolved.flow().speed_m_s;
  r.density = resolved.flow().density_kg_m3;
  r.approach_speed = r.last.approach_speed;
  r.drag = r.last.fluid_force;
  r.drag_area = r.drag / dynamic_pressure(resolved);
  r.reference_area = solver.reference_area();
  r.drag_coefficient = r.drag_area / r.reference_area;
  if (!solver.has_own_mesh())
    r.known_drag_coefficient = experience(resolved.parachute()).drag_coefficient.if_known();
  r.size =
      solver.cluster() ? mean_size(*solver.cluster(), state.shape) : canopy_size(solver.mesh(), state.shape);
  const ClothState cloth = solver.cloth_state(state);
  const std::vector<double> tensions = spring_tensions(solver.cloth(), cloth);
  for (const LineTension& t : line_tensions(solver.mesh(), tensions))
    r.max_line_tension = std::max(r.max_line_tension, t.largest_tension);
  r.stress = stress_peak(solver.mesh(), state.shape, cell_stress(solver.cloth(), cloth));
  r.margins = case_margins(resolved, solver.mesh(), tensions, r.stress);
  r.iterations = r.last.iteration;
  r.converged = state.converged;
  r.first_estimate = state.first_estimate;
  r.transfer_factor = r.last.transfer_factor;
  r.load_remainder = r.last.residual_traction;
  r.axial_moment = r.last.axial_moment;
  r.section_gap = r.last.section_gap;
  r.ledger = {r.last.fluid_force, r.last.nodal_load, r.last.line_tension, r.last.momentum_deficit};
  r.domain = solved_domain(solver, state);
  if (state.in_time) r.unsteady = unsteady_result(state.window, resolved);
  r.measured = resolved.measured_row();
  if (solver.cluster()) {
    r.cluster = cluster_result(solver, state, tensions, r.drag_coefficient, resolved);
    r.cluster->one_failed = margins_after_failure(solver, tensions, r.stress, resolved);
  }
  if (!state.body_forces.empty()) r.bodies = body_results(solver.bodies(), state, resolved);
  take_quality(r, resolved, solver.has_own_mesh());
  return r;
}

std::string to_json(const SteadyResult& result) {
  return json_text(result);
}

SteadyResult steady_result_from_json(const std::string& text) {
  return from_json_text<SteadyResult>(text, "the result of a steady run");
}

SteadyParts steady_parts(const Settings& resolved, const SteadySettings& settings) {
  SteadyParts parts;
  SteadyProblem problem = steady_problem(resolved, settings.mesh.get());
  const int threads = settings.threads > 0 ? settings.threads : problem.settings.threads;
  problem.settings.threads = threads;
  const EngineRecord& record = engine_of(resolved);
  EngineOptions options = engine_options(resolved);
  options.threads = threads;
  options.small_eddies = resolved.flow().watch.eddies;
  options.folder = settings.flow_folder;
  options.hostfile = settings.hostfile;
  if (record.needs_folder && options.folder.empty()) {
    parts.temporary = std::make_unique<TemporaryFolder>("flow");
    options.folder = parts.temporary->path;
  }
  parts.engine = record.make(options);
  parts.solver = std::make_unique<SteadySolver>(std::move(problem), *parts.engine);
  return parts;
}

SteadyParts parts_with(SteadyParts old, const Settings& now, const SteadySettings& settings, bool continues) {
  if (!continues) {
    old.solver.reset(), old.engine.reset();
    return steady_parts(now, settings);
  }
  const TemporaryFolder saved("flow");
  old.solver->flow().save(saved.path);
  old.solver.reset(), old.engine.reset();
  SteadyParts parts = steady_parts(now, settings);
  parts.solver->flow().restore(saved.path);
  return parts;
}

void require_steady_memory(const Settings& resolved) {
  const Cost cost = cost_of(resolved);
  require_memory(cost.memory,
                 fmt::format("a steady run on {:.3g} cells and {:.3g} nodes", cost.cells, cost.nodes),
                 canopy_count(resolved.written()));
}

SteadySolution run_steady(const Settings& resolved, SteadyObserver& observer,
                          const SteadySettings& settings) {
  require_steady_memory(resolved);
  RunClock clock;
  if (settings.mesh && resolved.payload().mass_kg)
    throw Error(ExitCode::usage,
                "payload.mass_kg: the weight is that of the parachute of the case, which a mesh of your own "
                "replaces; remove the payload and give flow.speed_m_s");
  if (resolved.payload().mass_kg) return run_with_payload(resolved, observer, settings, clock);
  if (const auto& cluster = resolved.written().cluster; cluster && cluster->equilibrium)
    return run_to_equilibrium(resolved, observer, settings, clock);
  const SteadyParts parts = steady_parts(resolved, settings);
  SteadySolver& solver = *parts.solver;
  const SteadyRun run{resolved, solver, parts.engine->name()};
  SteadySolution solution;
  SteadyState& state = solution.state;
  state = solver.start();
  observer.begin(run, state);
  clock.count_earlier(state);
  if (const auto start = coarse_start(resolved, solver, state, observer, settings)) {
    start->give(state);
    solver.flow().continue_from(start->flow.path);
  }
  while (!solver.finished(state)) {
    solution.flow =
        solver.iterate(state, [&](const SteadyProgress& progress) { observer.progress(progress, state); });
    observer.iterated(run, state, solution.flow);
  }
  solution.result = steady_result(solver, state, resolved);
  solution.result.wall_time = clock.elapsed();
  observer.ended(run, state, solution.result);
  return solution;
}

bool start_from(const Settings& other, const SteadyState& end, const SteadyRun& run, SteadyState& state) {
  const Settings& resolved = run.resolved;
  const json here = json::parse(case_json(resolved)), before = json::parse(case_json(other));
  const auto same = [&](const char* table) {
    return here.value(table, json()) == before.value(table, json());
  };
  const bool same_mesh = same("parachute") && same("cluster") && end.shape.size() == state.shape.size() &&
                         end.pressure.size() == state.pressure.size();
  if (!same_mesh) return false;
  state.shape = end.shape;
  state.pressure = end.pressure;
  state.spread.angle = end.spread.angle;
  const double shift = resolved.flow().canopy_position_m - other.flow().canopy_position_m;
  const double there =
      end.speed > 0 ? 0.5 * other.flow().density_kg_m3 * end.speed * end.speed : dynamic_pressure(other);
  const double ratio = dynamic_pressure(resolved) / there;
  for (Vec3& p : state.shape) p.z += shift;
  for (double& dp : state.pressure) dp *= ratio;
  state.residual_traction = {ratio * end.residual_traction.at_centre, ratio * end.residual_traction.twist};
  return same_flow(resolved.flow(), other.flow()) &&
         steady_problem(other).flow.quarter == run.solver.full_box_because().empty();
}

}  // namespace ripstop::inline run
