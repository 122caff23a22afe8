#include "ripstop/run/steady/steady_folder.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/core/thread_team.h"
#include "ripstop/flow/stl.h"
#include "ripstop/fsi/pressure_profile.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/checkpoint_parts.h"
#include "ripstop/run/engine.h"
#include "ripstop/run/steady/checkpoint.h"
#include "ripstop/run/steady/watch_files.h"
#include "ripstop/run/stress_arrays.h"
#include "ripstop/run/used_run.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// canopy.png while a run continues: it takes half a second.
constexpr std::chrono::seconds between_pictures{10};

/// Writes every file of the run before it calls the next observer.
class SteadyFolder : public SteadyObserver {
 public:
  SteadyFolder(RunFolder& folder, const SteadyFolderSettings& settings, SteadyObserver& next)
      : folder_(folder), fields_(settings.run.fields), warm_from_(settings.warm_from), next_(next) {}

  void begin(const SteadyRun& run, SteadyState& state) override;
  void solved_coarse(const SteadyRun& run, const SteadyResult& result) override {
    next_.solved_coarse(run, result);
  }
  void warned(const std::string& text) override { next_.warned(text); }
  void progress(const SteadyProgress& progress, const SteadyState& state) override {
    next_.progress(progress, state);
  }
  void iterated(const SteadyRun& run, const SteadyState& state, const FlowField& flow) override;
  void turned(const SteadyTurn& turn) override { next_.turned(turn); }
  void ended(const SteadyRun& run, const SteadyState& state, const SteadyResult& result) override;

 private:
  void write_series(std::size_t iterations) const;
  void write_shape(const SteadyRun& run, const SteadyState& state) const;
  void write_flow(const FlowField& field) const;
  void draw(const SteadyRun& run, const SteadyState& state);
  void write_drag_plot(const SteadyState& state, const std::string& title) const;
  void write_pressure(const SteadyRun& run, const SteadyState& state, const SteadyResult& result) const;
  CsvLog iterations(std::size_t kept) const {
    return {folder_.own("iterations.csv"), columns_of<SteadyIteration>(), kept};
  }

  RunFolder& folder_;
  bool fields_;
  fs::path warm_from_;
  std::size_t drawn_ = 0;  // the iteration of canopy.png; 0: not drawn yet
  std::chrono::steady_clock::time_point drawn_at_;
  SteadyObserver& next_;
};

void SteadyFolder::begin(const SteadyRun& run, SteadyState& state) {
  if (auto saved = load_checkpoint(folder_.own("checkpoint/"), run.solver.flow())) {
    state = std::move(saved->state);
    if (!saved->damage.empty())
      next_.warned(fmt::format("{}; resuming from the previous checkpoint, iteration {}", saved->damage,
                               state.iterations.size()));
  } else if (!warm_from_.empty()) {
    if (start_from(settings_of_run(warm_from_), final_state(warm_from_), run, state)) {
      const auto neighbour = load_checkpoint(warm_from_ / "checkpoint", run.solver.flow());
      if (neighbour && !neighbour->damage.empty())  // an older one would make other numbers
        throw Error(ExitCode::bad_data, neighbour->damage);
    }
  }
  std::vector<std::vector<double>> rows;  // of the checkpoint, whatever became of the table
  for (const SteadyIteration& i : state.iterations) rows.push_back(row_of(i));
  iterations(0).add_rows(rows);
  refuse_lost(folder_);
  next_.begin(run, state);
}

void SteadyFolder::iterated(const SteadyRun& run, const SteadyState& state, const FlowField& flow) {
  if (fields_) {
    write_shape(run, state);
    write_flow(flow);
    if (drawn_ == 0 || std::chrono::steady_clock::now() - drawn_at_ >= between_pictures) draw(run, state);
  }
  if (state.iterations.back().in_time) write_watch(folder_, run.resolved, run.solver.record());
  iterations(state.iterations.size() - 1).add(row_of(state.iterations.back()));
  folder_.keep();
  save_checkpoint(folder_.own("checkpoint/"), state, run.solver.flow());
  next_.iterated(run, state, flow);
}

void SteadyFolder::ended(const SteadyRun& run, const SteadyState& state, const SteadyResult& result) {
  if (!fields_) write_shape(run, state);
  if (drawn_ < state.iterations.size()) draw(run, state);
  write_stl(folder_.own("canopy.stl"), surface_of(run.solver.cells(), state.shape));
  for (std::size_t n = 1; n < run.solver.bodies().size(); ++n) {
    const FlowBody& body = run.solver.bodies()[n];
    write_stl(folder_.own(fmt::format("body-{}.stl", body.name)), body.surface);
  }
  write_drag_plot(state, result.title);
  write_pressure(run, state, result);
  if (const std::string failure = folder_.end(result); !failure.empty()) next_.warned(failure);
  next_.ended(run, state, result);
}

void SteadyFolder::write_series(std::size_t iterations) const {
  for (const char* what : {"canopy", "lines"}) {
    std::vector<VtkSeriesFile> series;
    for (std::size_t k = 1; k <= iterations; ++k) {
      series.push_back({double(k), fmt::format("vtk/{}_{:03}.vtp", what, k)});
    }
    folder_.write(fmt::format("{}.pvd", what), series);
  }
}

void SteadyFolder::write_shape(const SteadyRun& run, const SteadyState& state) const {
  const SteadySolver& solver = run.solver;
  const CanopyMesh& mesh = solver.mesh();
  const ClothState cloth = solver.cloth_state(state);
  const std::vector<CellStress> stress = cell_stress(solver.cloth(), cloth);
  const std::vector<double> tensions = spring_tensions(solver.cloth(), cloth);
  const std::size_t k = state.iterations.size();

  VtkSurface canopy = canopy_surface(mesh, state.shape);
  std::vector<Vec3> displacement(state.shape.size());
  for (std::size_t i = 0; i < displacement.size(); ++i) displacement[i] = state.shape[i] - mesh.start[i];
  canopy.point_arrays.push_back(vtk_array("displacement_m", displacement));
  const auto add = [&](const char* name, const std::vector<double>& values) {
    canopy.cell_arrays.push_back(vtk_array(name, cloth_cells_only(mesh, values)));
  };
  add("pressure_inside_pa", state.sides.inside);
  add("pressure_outside_pa", state.sides.outside);
  add("pressure_difference_applied_pa", state.applied);
  for (VtkArray& array : stress_arrays(mesh, state.shape, stress))
    canopy.cell_arrays.push_back(std::move(array));
  make_folder(folder_.path() / "vtk");
  folder_.write(fmt::format("vtk/canopy_{:03}.vtp", k), canopy);

  VtkSurface lines = spring_lines(mesh, state.shape);
  lines.cell_arrays.push_back(vtk_array("tension_n", tensions));
  folder_.write(fmt::format("vtk/lines_{:03}.vtp", k), lines);
  write_series(k);
  CsvTable table{{"line", "free_tension_n", "largest_tension_n"}, {}};
  for (const LineTension& t : line_tensions(mesh, tensions))
    table.rows.push_back({double(table.rows.size() + 1), t.free_tension, t.largest_tension});
  folder_.write("lines.csv", table);
}

void SteadyFolder::write_flow(const FlowField& field) const {
  folder_.own(field.grid.uniform() ? "flow.vti" : "flow.vtr");
  write_image(folder_.path() / "flow", flow_image(field));
}

void SteadyFolder::draw(const SteadyRun& run, const SteadyState& state) {
  const SteadySolver& solver = run.solver;
  const ClothState cloth = solver.cloth_state(state);
  std::vector<double> mises;
  for (const CellStress& s : cell_stress(solver.cloth(), cloth)) mises.push_back(s.von_mises);
  drawn_ = state.iterations.size();
  drawn_at_ = std::chrono::steady_clock::now();
  write_canopy_picture(folder_.own("canopy.png"), solver.mesh(), state.shape,
                       {fmt::format("{}, coupling iteration {}: drag {:.1f} N", run.resolved.title(), drawn_,
                                    state.iterations.back().fluid_force),
                        "von Mises stress [N/m]",
                        mises,
                        {}});
}

// pressure.csv and pressure.png: coefficients along the gores; load.png: the load over the cloth.
void SteadyFolder::write_pressure(const SteadyRun& run, const SteadyState& state,
                                  const SteadyResult& result) const {
  const double dynamic_pressure = 0.5 * result.density * result.speed * result.speed;
  CsvTable table{{"arc_m", "radius_m", "z_m", "cp_inside", "cp_outside", "cp_load"}, {}};
  Plot plot;
  plot.title = result.title;
  plot.x.label = "distance along the cloth from the vent [m]";
  plot.y.label = "pressure coefficient";
  for (const char* name : {"inside", "outside", "cloth load"}) plot.series.emplace_back().name = name;
  const Cluster* cluster = run.solver.cluster();
  const std::vector<PressureRing> rings = pressure_profile(
      run.solver.cells(), cluster ? cluster->overlaid(state.shape) : state.shape, state.sides, state.applied);
  for (const PressureRing& ring : rings) {
    const double values[] = {ring.inside / dynamic_pressure, ring.outside / dynamic_pressure,
                             ring.load / dynamic_pressure};
    table.rows.push_back({ring.arc, ring.radius, ring.z, values[0], values[1], values[2]});
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      plot.series[s].x.push_back(ring.arc);
      plot.series[s].y.push_back(values[s]);
    }
  }
  folder_.write("pressure.csv", table);
  folder_.write("pressure.png", plot);
  write_canopy_picture(folder_.own("load.png"), run.solver.mesh(), state.shape,
                       {result.title, "pressure difference, inside minus outside [Pa]", state.applied, {}});
}

void SteadyFolder::write_drag_plot(const SteadyState& state, const std::string& title) const {
  Plot plot;
  plot.title = title;
  plot.x.label = "coupling iteration";
  plot.y.label = "axial force [N]";
  for (const char* name : {"air load", "cloth load", "line load"}) plot.series.emplace_back().name = name;
  for (const SteadyIteration& i : state.iterations) {
    const double forces[] = {i.fluid_force, i.nodal_load, i.line_tension};
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      plot.series[s].x.push_back(i.iteration);
      plot.series[s].y.push_back(forces[s]);
    }
  }
  folder_.write("drag.png", plot);
}

}  // namespace

SteadyFolderRun run_steady_in(const SteadyFolderSettings& settings, const Settings& resolved,
                              SteadyObserver& observer) {
  const fs::path& folder = settings.run.folder;
  require_hosts(settings.hostfile, resolved);
  const int threads = settings.threads > 0 ? settings.threads : resolved.coupling().threads;
  // By the engine's name, before one is made: making it clears the flow's
  // folder, which may still be another run's.
  const auto claimed = open_run_folder(
      settings.run, resolved, engine_of(resolved).name(engine_options(resolved)), ThreadTeam(threads).size());
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (const auto finished = claimed->finished()) return {true, steady_result_from_json(*finished)};
  const fs::path flow_folder = engine_of(resolved).needs_folder ? claimed->own("flow/") : fs::path();
  SteadyFolder files(*claimed, settings, observer);
  SteadyResult result = run_steady(resolved, files, {threads, flow_folder, settings.hostfile}).result;
  result.inputs_hash = inputs_of_run(folder);
  return {false, std::move(result)};
}

void check_steady_in(const SteadyFolderSettings& settings, const Settings& resolved) {
  const fs::path& folder = settings.run.folder;
  require_hosts(settings.hostfile, resolved);
  require_unclaimed(folder);
  const std::string engine = engine_of(resolved).name(engine_options(resolved));  // it is there
  if (!continues_run(settings.run, resolved, engine) && holds_run(settings.run, resolved, engine) &&
      finished_result(folder))
    return;
  if (!settings.elsewhere) require_steady_memory(resolved);
}

namespace {

struct RunOfFolder {
  Settings resolved;
  SteadyResult result;
};

RunOfFolder run_of_folder(const fs::path& folder) {
  const std::optional<std::string> text = finished_result(folder);
  if (!text) refuse_unfinished(folder, "steady");
  return {settings_of_run(folder), steady_result_from_json(*text)};
}

void require_for_opening(const Settings& resolved, const SteadyResult& result, const std::string& where,
                         const Settings& opening) {
  require_one_canopy(resolved, "an opening");
  if (!result.converged)
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}: the steady run has not converged; increase coupling.max_iterations and continue it",
                    where));
  require_same_parachute(resolved, where, opening);
}

}  // namespace

double drag_for_opening(const fs::path& folder, const Settings& opening) {
  const RunOfFolder run = run_of_folder(folder);
  return drag_for_opening(run.resolved, run.result, folder.string(), opening);
}

double drag_for_opening(const Settings& resolved, const SteadyResult& result, const std::string& where,
                        const Settings& opening) {
  require_for_opening(resolved, result, where, opening);
  const auto check = [&](const char* what, double there, double now) {
    if (std::abs(there - now) <= 1e-6 * now) return;
    throw Error(ExitCode::usage,
                fmt::format("{}: is a run at a different {}: {:g} in that run and {:g} in this case", where,
                            what, there, now));
  };
  check("speed (m/s)", result.speed, opening.flow().speed_m_s);
  check("density (kg/m3)", result.density, opening.flow().density_kg_m3);
  return result.drag;
}

LoadSource steady_load(const fs::path& folder, const Settings& opening) {
  const RunOfFolder run = run_of_folder(folder);
  LoadSource load = steady_load(run.resolved, run.result, folder.string(), opening);
  load.text = "steady run " + load.text;
  return load;
}

LoadSource steady_load(const Settings& resolved, const SteadyResult& result, const std::string& where,
                       const Settings& opening) {
  if (!result.payload) {
    const double drag = drag_for_opening(resolved, result, where, opening);
    return {fmt::format("{}: {:.4g} N", where, drag), drag,
            warnings_if_usable(end_of_run(to_json(result), where))};
  }
  require_for_opening(resolved, result, where, opening);
  const double speed = opening.flow().speed_m_s;
  const double drag = result.drag_area * 0.5 * opening.flow().density_kg_m3 * speed * speed;
  return {fmt::format("{}: drag area of {:.4g} m2 at {:.4g} m/s, {:.4g} N at {:g} m/s", where,
                      result.drag_area, result.speed, drag, speed),
          drag, warnings_if_usable(end_of_run(to_json(result), where))};
}

void require_same_parachute(const Settings& resolved, const std::string& where, const Settings& opening) {
  auto asked = nlohmann::json::parse(case_json(opening)).at("parachute");
  auto had = nlohmann::json::parse(case_json(resolved)).at("parachute");
  asked.erase("mesh"), had.erase("mesh");
  for (const auto& [key, value] : asked.items()) {
    if (had.contains(key) && had.at(key) == value) continue;
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{}: is a run of a different parachute: parachute.{} is {} in that run and {} in this case",
            where, key, had.contains(key) ? had.at(key).dump() : "absent", value.dump()));
  }
}

SteadyState final_state(const fs::path& folder) {
  const fs::path checkpoint = folder / "checkpoint";
  if (!fs::exists(folder / "result.json")) refuse_unfinished(folder, "steady");
  if (!fs::exists(checkpoint / "current"))
    throw Error(ExitCode::bad_data, fmt::format("{}: is missing; compute the run again with --fresh",
                                                (checkpoint / "current").string()));
  return steady_state_from_bytes(read_sealed(checkpoint / read_sealed(checkpoint / "current") / "state"));
}

Settings settings_of_run(const fs::path& folder) {
  if (!fs::exists(folder / "case.toml")) {
    throw Error(
        ExitCode::usage,
        fmt::format(
            "{}: has no case.toml, so it is no run of this program, or not complete; give the folder of "
            "a finished run",
            folder.string()));
  }
  return resolve(read_case(folder / "case.toml"));
}

void drop_flow_checkpoint(const fs::path& folder) {
  if (!fs::exists(folder / "result.json")) return;
  for (const char* name : alternating_folders) remove_path(folder / "checkpoint" / name / "flow");
}

}  // namespace ripstop::inline run
