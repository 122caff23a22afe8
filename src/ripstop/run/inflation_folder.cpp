#include "ripstop/run/inflation_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"

namespace ripstop {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::vector<std::string> history_columns = {"time_s", "load_mean_n", "load_least_n", "load_largest_n"};
const std::vector<std::string> balance_columns = {
    "time_s",           "pressure_work_j", "kinetic_energy_j",  "elastic_energy_j",     "damped_energy_j",
    "residual",         "step_s",          "stable_step_s",     "projected_diameter_m", "projected_area_m2",
    "skirt_diameter_m", "canopy_length_m", "max_von_mises_n_m", "max_cloth_strain",     "asymmetry_m"};
// The first work is so small that its residual says nothing.
constexpr double share_of_work_judged = 0.1;

double clock_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<double> row_of(const InflationFrame& f) {
  return {f.time,
          f.pressure_work,
          f.kinetic,
          f.elastic,
          f.damped,
          f.residual(),
          f.step,
          f.stable_step,
          f.size.projected_diameter,
          f.size.projected_area,
          f.size.skirt_diameter,
          f.size.length,
          f.stress.von_mises,
          f.stress.strain,
          f.asymmetry};
}

fs::path shape_file(const char* what, long long frame) {
  return fmt::format("vtk/{}_{:04}.vtp", what, frame);
}

ordered_json place_of(const StressPeak& stress) {
  return {stress.place.x, stress.place.y, stress.place.z};
}

}  // namespace

std::string to_bytes(const InflationState& s) {
  json shots = json::array();
  for (const InflationShot& shot : s.shots) {
    std::vector<double> x;
    for (const Vec3 p : shot.positions) x.insert(x.end(), {p.x, p.y, p.z});
    shots.push_back({{"time", shot.time}, {"positions", x}, {"von_mises", shot.von_mises}});
  }
  const json j = {{"format", 1},
                  {"x", std::vector<double>(s.cloth.x.begin(), s.cloth.x.end())},
                  {"v", std::vector<double>(s.cloth.v.begin(), s.cloth.v.end())},
                  {"time", s.cloth.time},
                  {"steps", s.cloth.steps},
                  {"peak_tension", s.record.peak_tension},
                  {"pressure_work", s.record.pressure_work},
                  {"damped", s.record.damped},
                  {"step", s.step},
                  {"blocks", s.blocks},
                  {"peak_load", s.peak_load},
                  {"peak_time", s.peak_time},
                  {"impulse", s.impulse},
                  {"step_changes", s.step_changes},
                  {"von_mises", s.highest_stress.von_mises},
                  {"strain", s.highest_stress.strain},
                  {"place", {s.highest_stress.place.x, s.highest_stress.place.y, s.highest_stress.place.z}},
                  {"patch", s.highest_stress.patch},
                  {"stress_time", s.highest_stress_time},
                  {"shots", shots}};
  const std::vector<std::uint8_t> bytes = json::to_cbor(j);
  return {bytes.begin(), bytes.end()};
}

InflationState inflation_state_from_bytes(const std::string& bytes) {
  try {
    const json j = json::from_cbor(bytes);
    if (j.at("format") != 1) throw Error(ExitCode::bad_data, "a checkpoint of another version of Ripstop");
    InflationState s;
    const auto x = j.at("x").get<std::vector<double>>(), v = j.at("v").get<std::vector<double>>();
    s.cloth.x.assign(x.begin(), x.end());
    s.cloth.v.assign(v.begin(), v.end());
    j.at("time").get_to(s.cloth.time);
    j.at("steps").get_to(s.cloth.steps);
    j.at("peak_tension").get_to(s.record.peak_tension);
    j.at("pressure_work").get_to(s.record.pressure_work);
    j.at("damped").get_to(s.record.damped);
    j.at("step").get_to(s.step);
    j.at("blocks").get_to(s.blocks);
    j.at("peak_load").get_to(s.peak_load);
    j.at("peak_time").get_to(s.peak_time);
    j.at("impulse").get_to(s.impulse);
    j.at("step_changes").get_to(s.step_changes);
    j.at("von_mises").get_to(s.highest_stress.von_mises);
    j.at("strain").get_to(s.highest_stress.strain);
    const auto place = j.at("place").get<std::vector<double>>();
    s.highest_stress.place = {place.at(0), place.at(1), place.at(2)};
    j.at("patch").get_to(s.highest_stress.patch);
    j.at("stress_time").get_to(s.highest_stress_time);
    for (const json& saved : j.at("shots")) {
      InflationShot shot{
          saved.at("time").get<double>(), {}, saved.at("von_mises").get<std::vector<double>>()};
      const auto p = saved.at("positions").get<std::vector<double>>();
      for (std::size_t i = 0; i + 2 < p.size(); i += 3) shot.positions.push_back({p[i], p[i + 1], p[i + 2]});
      s.shots.push_back(std::move(shot));
    }
    return s;
  } catch (const json::exception& error) {
    throw Error(ExitCode::bad_data, fmt::format("not a checkpoint of an opening: {}", error.what()));
  }
}

InflationFolder::InflationFolder(const RunSettings& settings, const Case& value, const std::string& solver,
                                 int threads)
    : folder_(settings.folder), opened_(clock_now()) {
  open_run_folder(settings, value, solver, threads);
}

std::optional<std::string> InflationFolder::finished_result() const {
  if (!fs::exists(folder_ / "result.json")) return std::nullopt;
  return read_file(folder_ / "result.json");
}

std::optional<InflationState> InflationFolder::go_on(const Inflation& solver) {
  const fs::path saved = folder_ / "checkpoint";
  std::optional<InflationState> state;
  if (fs::exists(saved)) {
    const std::string bytes = read_sealed(saved);
    state = inflation_state_from_bytes(bytes);
    if (state->cloth.x.size() != solver.start().cloth.x.size()) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: is of another mesh; start again with --fresh", saved.string()));
    }
  }
  const long long blocks = state ? state->blocks : 0;
  const long long rows = blocks * solver.rows_per_block();
  const long long frames = state ? blocks * solver.problem().settings.frames / solver.blocks() : 0;
  CsvLog(folder_ / "history.csv", history_columns, static_cast<std::size_t>(rows));
  CsvLog(folder_ / "balance.csv", balance_columns, static_cast<std::size_t>(frames));
  return state;
}

void InflationFolder::write_start(const Inflation& solver, const InflationState& state) {
  make_folder(folder_ / "vtk");
  const FoldedStart& folded = solver.folded();
  std::vector<double> flat(solver.mesh().cell_count(), 0.0);
  std::size_t cell = 0;
  for (const Patch& patch : solver.mesh().patches) {
    for (int i = 0; i < (patch.rows - 1) * patch.columns; ++i, ++cell) {
      if (patch.periodic) {
        flat[cell] = (i % patch.columns) * 2 * folded.folds / patch.columns % 2;
      } else {  // a sheet folded along rays: by the azimuth of the cell as cut
        const int last = std::min(patch.first_node + i + patch.columns + 1,
                                  patch.first_node + patch.rows * patch.columns - 1);
        const Vec3 middle = solver.mesh().start[patch.first_node + i] + solver.mesh().start[last];
        const double turns = std::atan2(middle.y, middle.x) / (2 * std::numbers::pi) + 1;
        flat[cell] = static_cast<int>(2 * folded.folds * turns) % 2;
      }
    }
  }
  write_canopy_picture(folder_ / "folded.png", solver.mesh(), folded.positions,
                       {fmt::format("folded start: {} folds between {:.3f} m and {:.3f} m", folded.folds,
                                    folded.inner_radius, folded.outer_radius),
                        "strips between the folds, in turn", flat, ColourRange{-0.5, 1.5}});
  const std::vector<Vec3> x = positions(state.cloth, solver.cloth());
  write_vtp(folder_ / shape_file("canopy", 0), canopy_surface(solver.mesh(), x));
  write_vtp(folder_ / shape_file("lines", 0), spring_lines(solver.mesh(), x));
}

void InflationFolder::add_rows(const std::vector<HistoryRow>& rows) {
  for (const HistoryRow& row : rows) pending_rows_.push_back({row.time, row.mean, row.least, row.largest});
}

void InflationFolder::write_frame(const Inflation& solver, const InflationState& state,
                                  const InflationFrame& frame) {
  pending_frames_.push_back(row_of(frame));
  const long long index = state.blocks * solver.problem().settings.frames / solver.blocks();
  const std::vector<Vec3> x = positions(state.cloth, solver.cloth());
  std::vector<double> mises, strain;
  for (const CellStress& stress : cell_stress(solver.cloth(), state.cloth)) {
    mises.push_back(stress.von_mises);
    strain.push_back(stress.max_strain);
  }
  VtkSurface canopy = canopy_surface(solver.mesh(), x);
  canopy.point_arrays.push_back(
      vtk_array_single("velocity_m_per_s", velocities(state.cloth, solver.cloth())));
  canopy.cell_arrays.push_back(vtk_array_single("von_mises_n_per_m", cloth_cells_only(solver.mesh(), mises)));
  canopy.cell_arrays.push_back(vtk_array_single("strain_max", cloth_cells_only(solver.mesh(), strain)));
  write_vtp(folder_ / shape_file("canopy", index), canopy);
  VtkSurface lines = spring_lines(solver.mesh(), x);
  lines.cell_arrays.push_back(vtk_array_single("tension_n", spring_tensions(solver.cloth(), state.cloth)));
  write_vtp(folder_ / shape_file("lines", index), lines);
}

void InflationFolder::save(const InflationState& state) {
  CsvLog history(folder_ / "history.csv", history_columns);
  history.add_rows(pending_rows_);
  CsvLog balance(folder_ / "balance.csv", balance_columns);
  balance.add_rows(pending_frames_);
  pending_rows_.clear();
  pending_frames_.clear();
  write_sealed(folder_ / "checkpoint", to_bytes(state));
}

std::vector<HistoryRow> InflationFolder::history() const {
  std::vector<HistoryRow> rows;
  for (const std::vector<double>& r : read_csv(folder_ / "history.csv").rows)
    rows.push_back({r[0], r[1], r[2], r[3]});
  return rows;
}

InflationResult InflationFolder::finish(const Inflation& solver, const InflationState& state,
                                        const Case& value, const LoadSource& source) {
  const InflationSettings& settings = solver.problem().settings;
  const std::vector<HistoryRow> rows = history();
  InflationResult r;
  r.summary = summarise(rows, settings.low_pass_hz);
  r.estimate = opening_estimate(value.parachute, source.steady_drag.value_or(r.summary.steady_load));
  r.peak_load = state.peak_load;
  r.peak_time = state.peak_time;
  r.impulse = state.impulse;
  r.overshoot = r.peak_load / r.summary.steady_load;
  r.smooth_overshoot = r.summary.smooth_peak / r.summary.steady_load;
  r.line_peaks = solver.peak_tension_of_lines(state);
  r.stress = state.highest_stress;
  r.stress_time = state.highest_stress_time;
  r.break_load = canopy_fabric(value).break_load_n_m;
  const CsvTable balance = read_csv(folder_ / "balance.csv");
  const std::vector<double> work = balance.column("pressure_work_j"), residual = balance.column("residual");
  const double most = *std::max_element(work.begin(), work.end());
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (work[i] >= share_of_work_judged * most)
      r.energy_residual = std::max(r.energy_residual, std::abs(residual[i]));
  }
  r.wall_time = clock_now() - opened_;

  write_pictures(solver, state, value, r, rows);
  CsvTable lines{{"line", "peak_tension_n"}, {}};
  for (std::size_t i = 0; i < r.line_peaks.size(); ++i)
    lines.rows.push_back({static_cast<double>(i + 1), r.line_peaks[i]});
  write_csv(folder_ / "lines.csv", lines);
  for (const char* what : {"canopy", "lines"}) {
    std::vector<VtkSeriesFile> series;
    for (int i = 0; i <= settings.frames; ++i) {
      series.push_back({settings.duration_s * i / settings.frames, shape_file(what, i)});
    }
    write_pvd(folder_ / fmt::format("{}.pvd", what), series);
  }

  ordered_json j;
  j["title"] = value.title;
  j["peak_load_n"] = r.peak_load;
  j["peak_time_s"] = r.peak_time;
  if (settings.low_pass_hz > 0) {
    j["low_pass_hz"] = settings.low_pass_hz;
    j["low_pass_peak_load_n"] = r.summary.smooth_peak;
    j["low_pass_peak_time_s"] = r.summary.smooth_peak_time;
    j["low_pass_overshoot"] = r.smooth_overshoot;
  }
  j["inflation_time_s"] =
      r.summary.inflation_time ? ordered_json(*r.summary.inflation_time) : ordered_json(nullptr);
  if (r.summary.filling_time) j["filling_time_s"] = *r.summary.filling_time;
  if (r.summary.settling_time) j["settling_time_s"] = *r.summary.settling_time;
  j["steady_load_n"] = r.summary.steady_load;
  j["steady_load_deviation"] = r.summary.unsteadiness;
  j["overshoot"] = r.overshoot;
  j["impulse_n_s"] = r.impulse;
  j["pressure_pa"] = solver.problem().pressure;
  j["pressure_from"] = source.text;
  if (source.steady_drag) {
    j["steady_drag_asked_n"] = *source.steady_drag;
    j["steady_drag_returned"] = r.summary.steady_load / *source.steady_drag;
  }
  j["damping_n_s_m3"] = settings.damping_n_s_m3;
  j["quadratic_damping_n_s2_m4"] = settings.quadratic_damping_n_s2_m4;
  j["line_damping_s"] = settings.line_damping_s;
  j["cloth_damping_s"] = settings.cloth_damping_s;
  j["cloth_damping_least_share"] = solver.viscosity_limit().least_share;
  j["cloth_damping_reduced_cells"] = solver.viscosity_limit().reduced_cells;
  j["folds"] = solver.folded().folds;
  j["inner_fold_radius_m"] = solver.folded().inner_radius;
  j["outer_fold_radius_m"] = solver.folded().outer_radius;
  j["start_strain"] = start_strain(solver.mesh(), solver.folded().positions).largest;
  j["max_line_tension_n"] = *std::max_element(r.line_peaks.begin(), r.line_peaks.end());
  j["max_von_mises_n_m"] = r.stress.von_mises;
  j["max_von_mises_at_m"] = place_of(r.stress);
  j["max_von_mises_time_s"] = r.stress_time;
  if (r.break_load > 0) j["cloth_margin"] = r.break_load / r.stress.von_mises;
  j["energy_residual"] = r.energy_residual;
  j["knacke_load_n"] = r.estimate.load;
  j["knacke_coefficient"] = r.estimate.coefficient;
  j["knacke_source"] = r.estimate.source;
  j["steps"] = state.cloth.steps;
  j["step_changes"] = state.step_changes;
  if (settings.measured_peak_n) j["measured_peak_n"] = *settings.measured_peak_n;
  if (settings.measured_inflation_time_s)
    j["measured_inflation_time_s"] = *settings.measured_inflation_time_s;
  if (settings.printed_peak_n) j["printed_peak_n"] = *settings.printed_peak_n;
  write_file(folder_ / "result.json", j.dump(2) + "\n");
  return r;
}

void InflationFolder::write_pictures(const Inflation& solver, const InflationState& state, const Case& value,
                                     const InflationResult& r, const std::vector<HistoryRow>& rows) const {
  const InflationSettings& settings = solver.problem().settings;
  PlotSeries load{"load", {}, {}, true, false}, largest{"largest in the interval", {}, {}, true, false};
  for (const HistoryRow& row : rows) {
    load.x.push_back(row.time);
    load.y.push_back(row.mean);
    largest.x.push_back(row.time);
    largest.y.push_back(row.largest);
  }
  Plot plot{value.title, {"time from deployment [s]"}, {"axial load [N]"}, {largest, load}};
  if (settings.low_pass_hz > 0) {
    PlotSeries smooth{fmt::format("low-passed at {:g} Hz", settings.low_pass_hz), load.x,
                      low_pass(load.y, solver.row_duration(), settings.low_pass_hz), true, false};
    CsvTable table{{"time_s", "load_n"}, {}};
    for (std::size_t i = 0; i < rows.size(); ++i) table.rows.push_back({smooth.x[i], smooth.y[i]});
    write_csv(folder_ / "history_low_pass.csv", table);
    plot.series.push_back(std::move(smooth));
  }
  const auto level = [&](const std::string& name, std::optional<double> value_n) {
    if (value_n)
      plot.series.push_back({name, {0, settings.duration_s}, {*value_n, *value_n}, true, false, true});
  };
  level("steady", r.summary.steady_load);
  level("Knacke", r.estimate.load);
  level("measured peak", settings.measured_peak_n);
  level("peak of the source's model", settings.printed_peak_n);
  write_plot(folder_ / "load.png", plot);

  std::vector<CanopyShot> shots;
  for (const InflationShot& shot : state.shots) {
    shots.push_back({fmt::format("t = {:.1f} ms", 1000 * shot.time), shot.positions, shot.von_mises});
  }
  write_contact_sheet(folder_ / "shapes.png", solver.mesh(), value.title, "von Mises stress [N/m]", shots);
}

}  // namespace ripstop
