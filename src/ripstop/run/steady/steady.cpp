#include "ripstop/run/steady/steady.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/case/cost.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/json.h"
#include "ripstop/run/steady/steady_parts.h"

namespace ripstop {
namespace {

using nlohmann::json;

double dynamic_pressure(const Case& given) {
  const Air stream = air(given);
  return 0.5 * stream.density * stream.speed * stream.speed;
}

// Both solve on the same grid, so that a field of one can start the other; one of other air where the engine
// scales what it has.
bool same_flow(const Case& a, const Case& b) {
  json first = json::parse(case_json(a)).at("flow"), second = json::parse(case_json(b)).at("flow");
  std::vector<std::string> free = {"canopy_position_m", "unsteady", "watch"};
  if (engine_of(a).can.other_air) {
    free.insert(free.end(), {"speed_m_s", "speed_basis", "height_m", "density_kg_m3", "viscosity_pa_s",
                             "temperature_k", "turbulence_intensity", "viscosity_ratio"});
  }
  for (const std::string& key : free) first.erase(key), second.erase(key);
  return first == second;
}

UnsteadyResult unsteady_result(const WindowAverage& watched, const Case& given) {
  UnsteadyResult result;
  result.watched = watched;
  // Not a number in JSON.
  if (std::isfinite(watched.error)) result.standard_error = watched.error;
  for (double* error : {&result.watched.error, &result.watched.side_error.x, &result.watched.side_error.y})
    if (!std::isfinite(*error)) *error = 0;
  result.strouhal = watched.swing * inflated_diameter(given.parachute) / air(given).speed;
  return result;
}
}  // namespace

SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Case& given) {
  SteadyResult r;
  r.title = given.title;
  r.last = state.iterations.back();
  const Air stream = air(given);
  r.speed = stream.speed;
  r.density = stream.density;
  r.approach_speed = r.last.approach_speed;
  r.drag = r.last.fluid_force;
  r.drag_area = r.drag / dynamic_pressure(given);
  r.reference_area = nominal_area(given.parachute);
  r.drag_coefficient = r.drag_area / r.reference_area;
  const KnownRange known = experience(given.parachute).drag_coefficient;
  if (known.high > 0) r.known_drag_coefficient = {known.low, known.high};
  r.size = canopy_size(solver.mesh(), state.shape);
  const ClothState cloth = solver.cloth_state(state);
  const std::vector<double> tensions = spring_tensions(solver.cloth(), cloth);
  for (const LineTension& t : line_tensions(solver.mesh(), tensions))
    r.max_line_tension = std::max(r.max_line_tension, t.largest_tension);
  r.stress = stress_peak(solver.mesh(), state.shape, cell_stress(solver.cloth(), cloth));
  r.margins = case_margins(given, solver.mesh(), tensions, r.stress);
  r.iterations = r.last.iteration;
  for (const SteadyIteration& i : state.iterations) r.wall_time += i.wall_time;
  r.converged = state.converged;
  r.transfer_factor = r.last.transfer_factor;
  r.load_remainder = r.last.residual_traction;
  r.axial_moment = r.last.axial_moment;
  r.section_gap = r.last.section_gap;
  r.ledger = {r.last.fluid_force, r.last.nodal_load, r.last.line_tension, r.last.momentum_deficit};
  if (state.in_time) r.unsteady = unsteady_result(state.window, given);
  if (const Measured* row = measured_row(given)) r.measured = *row;
  return r;
}

std::string to_json(const SteadyResult& result) {
  return json_text(result);
}

SteadyResult steady_result_from_json(const std::string& text) {
  return from_json_text<SteadyResult>(text, "the result of a steady run");
}

SteadyParts steady_parts(const Case& given, const SteadySettings& settings) {
  SteadyParts parts;
  SteadyProblem problem = steady_problem(given);
  const int threads = settings.threads > 0 ? settings.threads : problem.settings.threads;
  problem.settings.threads = threads;
  const EngineRecord& record = engine_of(given);
  EngineOptions options = engine_options(given);
  options.threads = threads;
  options.small_eddies = given.flow.watch.eddies;
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

void require_steady_memory(const Case& given) {
  const Cost cost = cost_of(given);
  require_memory(cost.memory,
                 fmt::format("a steady run on {:.3g} cells and {:.3g} nodes", cost.cells, cost.nodes));
}

SteadySolution run_steady(const Case& given, SteadyObserver& observer, const SteadySettings& settings) {
  require_steady_memory(given);
  if (given.payload.mass_kg) return run_with_payload(given, observer, settings);
  const SteadyParts parts = steady_parts(given, settings);
  SteadySolver& solver = *parts.solver;
  const SteadyRun run{given, solver, parts.engine->name()};
  SteadySolution solution;
  SteadyState& state = solution.state;
  state = solver.start();
  observer.begin(run, state);
  while (!solver.finished(state)) {
    solution.flow =
        solver.iterate(state, [&](const SteadyProgress& progress) { observer.progress(progress, state); });
    observer.iterated(run, state, solution.flow);
  }
  solution.result = steady_result(solver, state, given);
  observer.ended(run, state, solution.result);
  return solution;
}

bool start_from(const Case& other, const SteadyState& end, const SteadyRun& run, SteadyState& state) {
  const Case& given = run.given;
  const bool same_mesh =
      json::parse(case_json(given)).at("parachute") == json::parse(case_json(other)).at("parachute") &&
      end.shape.size() == state.shape.size() && end.pressure.size() == state.pressure.size();
  if (!same_mesh) return false;
  state.shape = end.shape;
  state.pressure = end.pressure;
  const double shift = canopy_position(given) - canopy_position(other);
  const double there =
      end.speed > 0 ? 0.5 * air(other).density * end.speed * end.speed : dynamic_pressure(other);
  const double ratio = dynamic_pressure(given) / there;
  for (Vec3& p : state.shape) p.z += shift;
  for (double& dp : state.pressure) dp *= ratio;
  state.residual_traction = {ratio * end.residual_traction.at_centre, ratio * end.residual_traction.twist};
  return same_flow(given, other);
}

}  // namespace ripstop
