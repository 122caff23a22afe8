#include "ripstop/run/steady_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/flow/cartesian/cartesian.h"
#include "ripstop/flow/openfoam/installation.h"
#include "ripstop/flow/openfoam/openfoam.h"
#include "ripstop/run/checkpoint.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::unique_ptr<FlowEngine> make_engine(const Case& value, const SteadyRunSettings& run, int threads) {
  if (value.flow.engine == EngineKind::builtin) {
    CartesianSettings settings;
    settings.threads = threads;
    settings.second_order = resolve(value).flow.convection == Convection::second_order;
    return make_cartesian(settings);
  }
  OpenFoamSettings settings;
  settings.folder = run.folder.folder / "flow";
  settings.ranks = value.flow.ranks;
  settings.second_order = resolve(value).flow.convection == Convection::second_order;
  settings.hostfile = run.hostfile;
  settings.time_limit_s = value.flow.time_limit_s > 0 ? value.flow.time_limit_s : 1e9;
  return make_openfoam(settings);
}

double dynamic_pressure(const Case& value) {
  const Air stream = air(value);
  return 0.5 * stream.density * stream.speed * stream.speed;
}

// Both solve on the same grid, so that a field of one can start the other. OpenFOAM's has to be of the same
// air; the built-in engine scales what it has to other air.
bool same_flow(const Case& a, const Case& b) {
  json first = json::parse(case_json(a)).at("flow"), second = json::parse(case_json(b)).at("flow");
  std::vector<std::string> free = {"canopy_position_m"};
  if (a.flow.engine == EngineKind::builtin) {
    free.insert(free.end(), {"speed_m_s", "speed_basis", "density_kg_m3", "viscosity_pa_s", "temperature_k",
                             "turbulence_intensity", "viscosity_ratio"});
  }
  for (const std::string& key : free) first.erase(key), second.erase(key);
  return first == second;
}

/// The neighbour's shape, moved to this case's place, under its pressure at this case's q; and its flow field
/// where that fits (same_flow). Another mesh starts cold.
SteadyState warm_start(const Case& value, const SteadySolver& solver, const fs::path& neighbour,
                       FlowEngine& engine) {
  SteadyState state = solver.start();
  const Case other = case_of_run(neighbour);
  const SteadyState end = final_state(neighbour);
  const bool same_mesh =
      json::parse(case_json(value)).at("parachute") == json::parse(case_json(other)).at("parachute") &&
      end.shape.size() == state.shape.size() && end.pressure.size() == state.pressure.size();
  if (!same_mesh) return state;
  state.shape = end.shape;
  state.pressure = end.pressure;
  const double shift = canopy_position(value) - canopy_position(other);
  const double ratio = dynamic_pressure(value) / dynamic_pressure(other);
  for (Vec3& p : state.shape) p.z += shift;
  for (double& dp : state.pressure) dp *= ratio;
  if (same_flow(value, other)) load_checkpoint(neighbour / "checkpoint", engine);
  return state;
}

}  // namespace

// Known before the engine is made: making it clears the flow's folder, which may still be another run's.
std::string name_of_engine(const Case& value) {
  if (value.flow.engine == EngineKind::builtin) return make_cartesian()->name();
  return "OpenFOAM " + openfoam::find_installation({}, value.flow.ranks > 1).version;
}

SteadyRunOutcome run_steady(const Case& value, const SteadyRunSettings& settings,
                            const SteadyRunEvents& events) {
  SteadyProblem problem = steady_problem(value);
  const int threads = settings.threads > 0 ? settings.threads : value.coupling.threads;
  problem.settings.threads = threads;
  RunFolder files(settings.folder, value, name_of_engine(value), ThreadTeam(threads).size());
  SteadyRunOutcome outcome;
  if (auto finished = files.finished_result()) {
    outcome.already_finished = true;
    outcome.json = *finished;
    return outcome;
  }
  const std::unique_ptr<FlowEngine> engine = make_engine(value, settings, threads);
  const int nodes = problem.mesh.node_count();
  SteadySolver solver(std::move(problem), *engine);
  SteadyState state;
  if (auto saved = load_checkpoint(files.checkpoint_folder(), *engine)) {
    state = std::move(*saved);
  } else if (!settings.warm_from.empty()) {
    state = warm_start(value, solver, settings.warm_from, *engine);
  } else {
    state = solver.start();
  }
  files.go_on_from(state);
  if (events.begun) events.begun(state, engine->name(), nodes);
  while (!solver.finished(state)) {
    const FlowField field = solver.iterate(state, [&](const SteadyProgress& progress) {
      if (events.progress) events.progress(progress, state);
    });
    files.write_iteration(solver, state, field);
    save_checkpoint(files.checkpoint_folder(), state, *engine);
    if (events.iterated) events.iterated(state);
  }
  files.write_result(solver, state, value);
  outcome.json = *files.finished_result();
  outcome.result = steady_result(solver, state, value);
  return outcome;
}

SteadyState final_state(const fs::path& folder) {
  const fs::path checkpoint = folder / "checkpoint";
  if (!fs::exists(folder / "result.json") || !fs::exists(checkpoint / "current")) {
    throw Error(ExitCode::usage, fmt::format("{}: holds no finished run of ripstop steady", folder.string()));
  }
  return steady_state_from_bytes(read_sealed(checkpoint / read_sealed(checkpoint / "current") / "state"));
}

Case case_of_run(const fs::path& folder) {
  if (!fs::exists(folder / "case.toml")) {
    throw Error(ExitCode::usage,
                fmt::format("{}: has no case.toml; run ripstop steady again with --fresh", folder.string()));
  }
  return read_case(folder / "case.toml");
}

void drop_flow_checkpoint(const fs::path& folder) {
  if (!fs::exists(folder / "result.json")) return;
  std::error_code ignored;
  for (const char* name : {"even", "odd"}) fs::remove_all(folder / "checkpoint" / name / "flow", ignored);
}

}  // namespace ripstop
