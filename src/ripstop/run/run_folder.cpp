#include "ripstop/run/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "ripstop/core/build_info.h"
#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/coupling/pressure_profile.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/stl.h"
#include "ripstop/output/vtk.h"
#include "ripstop/parachute/known_shape.h"

namespace ripstop {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::vector<std::string> iteration_columns = {
    "iteration",         "drag_n",         "nodal_load_n",     "line_tension_n",  "momentum_deficit_n",
    "transfer_factor",   "load_remainder", "drag_change",      "shape_change_m",  "omega",
    "printed_tolerance", "cloth_steps",    "cloth_residual",   "flow_iterations", "flow_residual",
    "flow_converged",    "flow_averaged",  "drag_deviation_n", "cut_cells",       "wall_time_s"};

std::vector<double> row_of(const SteadyIteration& i) {
  return {double(i.iteration),
          i.fluid_force,
          i.nodal_load,
          i.line_tension,
          i.momentum_deficit,
          i.transfer_factor,
          i.load_remainder,
          i.drag_change,
          i.shape_change,
          i.omega,
          i.printed_tolerance,
          double(i.cloth_steps),
          i.cloth_residual,
          double(i.flow_iterations),
          i.flow_residual,
          double(i.flow_converged),
          double(i.flow_averaged),
          i.drag_deviation,
          double(i.cut_cells),
          i.wall_time};
}

std::string now_utc() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&t, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                     utc.tm_hour, utc.tm_min, utc.tm_sec);
}

ordered_json read_json(const fs::path& file) {
  try {
    return ordered_json::parse(read_file(file));
  } catch (const nlohmann::json::exception& error) {
    throw Error(ExitCode::bad_data,
                fmt::format("{}: damaged ({}); start again with --fresh", file.string(), error.what()));
  }
}

constexpr const char* description = "run.json";

std::string inputs_hash(const Case& value, const std::string& solver) {
  return hash_bytes(fmt::format("{}\n{}\n{}", version(), solver, case_json(value)));
}

/// pressure.csv and pressure.png: coefficients along the gores; load.png: the load over the cloth.
void write_pressure(const fs::path& folder, const std::string& title, const SteadySolver& solver,
                    const SteadyState& state, double dynamic_pressure) {
  CsvTable table{{"arc_m", "radius_m", "z_m", "cp_inside", "cp_outside", "cp_load"}, {}};
  Plot plot;
  plot.title = title;
  plot.x.label = "along the cloth from the vent [m]";
  plot.y.label = "pressure coefficient";
  for (const char* name : {"inside", "outside", "load on the cloth"}) plot.series.emplace_back().name = name;
  for (const PressureRing& ring : pressure_profile(solver.cells(), state.shape, state.sides, state.applied)) {
    const double values[] = {ring.inside / dynamic_pressure, ring.outside / dynamic_pressure,
                             ring.load / dynamic_pressure};
    table.rows.push_back({ring.arc, ring.radius, ring.z, values[0], values[1], values[2]});
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      plot.series[s].x.push_back(ring.arc);
      plot.series[s].y.push_back(values[s]);
    }
  }
  write_csv(folder / "pressure.csv", table);
  write_plot(folder / "pressure.png", plot);
  write_canopy_picture(folder / "load.png", solver.mesh(), state.shape,
                       {title, "pressure inside over outside [Pa]", state.applied, {}});
}

}  // namespace

bool holds_run(const RunSettings& settings, const Case& value, const std::string& solver) {
  const fs::path& folder = settings.folder;
  if (!fs::exists(folder) || fs::is_empty(folder)) return false;
  if (!fs::exists(folder / description)) {
    throw Error(ExitCode::usage,
                fmt::format("{}: is not empty and holds no run of Ripstop (no run.json); choose "
                            "another --out",
                            folder.string()));
  }
  if (settings.fresh) return false;
  if (read_json(folder / description).value("inputs_hash", "") != inputs_hash(value, solver)) {
    throw Error(ExitCode::usage,
                fmt::format("{}: holds a run of other inputs (case, speed, grid, ranks, program or "
                            "flow engine differ); choose another --out, or --fresh to replace it",
                            folder.string()));
  }
  return true;
}

void open_run_folder(const RunSettings& settings, const Case& value, const std::string& solver, int threads) {
  if (holds_run(settings, value, solver)) return;
  const fs::path& folder = settings.folder;
  make_folder(folder);
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
  ordered_json run;
  run["program"] = "ripstop";
  run["version"] = version();
  run["compiler"] = compiler();
  run["processor"] = processor();
  run["threads"] = threads;
  run["ranks"] = value.flow.ranks;
  run["flow_engine"] = solver;
  run["started"] = now_utc();
  run["case_file"] = value.file.string();
  run["inputs_hash"] = inputs_hash(value, solver);
  run["case"] = ordered_json::parse(case_json(value));
  write_file(folder / "case.toml", case_toml(value));
  write_file(folder / description, run.dump(2) + "\n");
}

RunFolder::RunFolder(const RunSettings& settings, const Case& value, const std::string& engine, int threads)
    : folder_(settings.folder), title_(value.title), fields_(settings.fields) {
  open_run_folder(settings, value, engine, threads);
}

std::optional<std::string> RunFolder::finished_result() const {
  if (!fs::exists(folder_ / "result.json")) return std::nullopt;
  return read_json(folder_ / "result.json").dump(2);
}

void RunFolder::go_on_from(const SteadyState& state) {
  CsvLog(folder_ / "iterations.csv", iteration_columns, state.iterations.size());
}

void RunFolder::write_series(std::size_t iterations) const {
  for (const char* what : {"canopy", "lines"}) {
    std::vector<VtkSeriesFile> series;
    for (std::size_t k = 1; k <= iterations; ++k) {
      series.push_back({double(k), fmt::format("vtk/{}_{:03}.vtp", what, k)});
    }
    write_pvd(folder_ / fmt::format("{}.pvd", what), series);
  }
}

void RunFolder::write_iteration(const SteadySolver& solver, const SteadyState& state,
                                const FlowField& field) {
  if (fields_) {
    write_fields(solver, state, field);
    write_state(solver, state);
  }
  const std::size_t k = state.iterations.size();
  CsvLog(folder_ / "iterations.csv", iteration_columns, k - 1).add(row_of(state.iterations.back()));
}

void RunFolder::write_fields(const SteadySolver& solver, const SteadyState& state,
                             const FlowField& field) const {
  const Mesh& mesh = solver.mesh();
  const ClothState cloth = solver.cloth_state(state);
  const std::vector<CellStress> stress = cell_stress(solver.cloth(), cloth);
  const std::vector<double> tensions = spring_tensions(solver.cloth(), cloth);
  const std::size_t k = state.iterations.size();

  std::vector<double> largest, smallest, mises, strain;
  for (const CellStress& s : stress) {
    largest.push_back(s.principal_max);
    smallest.push_back(s.principal_min);
    mises.push_back(s.von_mises);
    strain.push_back(s.max_strain);
  }
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
  add("stress_max_n_per_m", largest);
  add("stress_min_n_per_m", smallest);
  add("von_mises_n_per_m", mises);
  add("strain_max", strain);
  make_folder(folder_ / "vtk");
  write_vtp(folder_ / fmt::format("vtk/canopy_{:03}.vtp", k), canopy);

  VtkSurface lines = spring_lines(mesh, state.shape);
  lines.cell_arrays.push_back(vtk_array("tension_n", tensions));
  write_vtp(folder_ / fmt::format("vtk/lines_{:03}.vtp", k), lines);
  write_series(k);
  write_image(folder_ / "flow", flow_image(field));
}

void RunFolder::write_state(const SteadySolver& solver, const SteadyState& state) const {
  const Mesh& mesh = solver.mesh();
  const ClothState cloth = solver.cloth_state(state);
  std::vector<double> mises;
  for (const CellStress& s : cell_stress(solver.cloth(), cloth)) mises.push_back(s.von_mises);
  const std::vector<double> tensions = spring_tensions(solver.cloth(), cloth);
  write_canopy_picture(folder_ / "canopy.png", mesh, state.shape,
                       {fmt::format("{}, coupling iteration {}: drag {:.1f} N", title_,
                                    state.iterations.size(), state.iterations.back().fluid_force),
                        "von Mises stress [N/m]",
                        mises,
                        {}});
  CsvTable table{{"line", "free_tension_n", "largest_tension_n"}, {}};
  for (const LineTension& t : line_tensions(mesh, tensions)) {
    table.rows.push_back({t.radial + 1.0, t.free_tension, t.largest_tension});
  }
  write_csv(folder_ / "lines.csv", table);
}

void RunFolder::write_result(const SteadySolver& solver, const SteadyState& state, const Case& value) {
  const SteadyResult r = steady_result(solver, state, value);
  if (!fields_) write_state(solver, state);
  write_stl(folder_ / "canopy.stl", surface_of(solver.cells(), state.shape));
  Plot plot;
  plot.title = value.title;
  plot.x.label = "coupling iteration";
  plot.y.label = "axial force [N]";
  for (const char* name : {"fluid force", "nodal load", "line tension"})
    plot.series.emplace_back().name = name;
  for (const SteadyIteration& i : state.iterations) {
    const double forces[] = {i.fluid_force, i.nodal_load, i.line_tension};
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      plot.series[s].x.push_back(i.iteration);
      plot.series[s].y.push_back(forces[s]);
    }
  }
  write_plot(folder_ / "drag.png", plot);
  write_pressure(folder_, value.title, solver, state, 0.5 * r.density * r.speed * r.speed);

  ordered_json j;
  j["title"] = value.title;
  j["drag_n"] = r.drag;
  j["drag_area_m2"] = r.drag_area;
  j["drag_coefficient"] = r.drag_coefficient;
  j["reference_area_m2"] = r.reference_area;
  const KnownRange known = known_drag_coefficient(value.parachute);
  if (known.high > 0) j["known_drag_coefficient"] = {known.low, known.high};
  j["speed_m_s"] = r.speed;
  j["density_kg_m3"] = r.density;
  j["projected_diameter_m"] = r.size.projected_diameter;
  j["projected_area_m2"] = r.size.projected_area;
  j["skirt_diameter_m"] = r.size.skirt_diameter;
  j["canopy_length_m"] = r.size.length;
  j["coupling_iterations"] = r.iterations;
  j["converged"] = r.converged;
  j["max_line_tension_n"] = r.max_line_tension;
  j["max_von_mises_n_m"] = r.stress.von_mises;
  j["max_von_mises_at_m"] = {r.stress.place.x, r.stress.place.y, r.stress.place.z};
  j["max_cloth_strain"] = r.stress.strain;
  j["transfer_factor"] = r.last.transfer_factor;
  j["load_remainder"] = r.last.load_remainder;
  j["wall_time_s"] = r.wall_time;
  j["ledger"] = {{"fluid_force_n", r.last.fluid_force},
                 {"nodal_load_n", r.last.nodal_load},
                 {"line_tension_n", r.last.line_tension},
                 {"momentum_deficit_n", r.last.momentum_deficit}};
  if (const Measured* row = measured_row(value)) {
    ordered_json measured;
    measured["nominal_speed_m_s"] = row->nominal_speed_m_s;
    measured["measured_speed_m_s"] = row->measured_speed_m_s;
    if (row->drag_n) measured["drag_n"] = *row->drag_n;
    if (row->printed_nonlinear_n) measured["printed_nonlinear_n"] = *row->printed_nonlinear_n;
    if (row->printed_linear_n) measured["printed_linear_n"] = *row->printed_linear_n;
    j["measured"] = measured;
  }
  write_file(folder_ / "result.json", j.dump(2) + "\n");
}

SteadyResult steady_result(const SteadySolver& solver, const SteadyState& state, const Case& value) {
  SteadyResult r;
  r.last = state.iterations.back();
  const Air stream = air(value);
  const double q = 0.5 * stream.density * stream.speed * stream.speed;
  r.speed = stream.speed;
  r.density = stream.density;
  r.drag = r.last.fluid_force;
  r.drag_area = r.drag / q;
  r.reference_area = nominal_area(value.parachute);
  r.drag_coefficient = r.drag_area / r.reference_area;
  r.size = canopy_size(solver.mesh(), state.shape);
  r.iterations = r.last.iteration;
  r.converged = state.converged;
  const ClothState cloth = solver.cloth_state(state);
  for (const LineTension& t : line_tensions(solver.mesh(), spring_tensions(solver.cloth(), cloth))) {
    r.max_line_tension = std::max(r.max_line_tension, t.largest_tension);
  }
  r.stress = stress_peak(solver.mesh(), state.shape, cell_stress(solver.cloth(), cloth));
  for (const SteadyIteration& i : state.iterations) r.wall_time += i.wall_time;
  return r;
}

}  // namespace ripstop
