#include "ripstop/run/opening/inflation_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/finished_opening.h"
#include "ripstop/run/report/report.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

// Of InflationState's list of members: one more with every change of it.
constexpr int opening_format = 8;

double clock_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string shape_file(const char* what, long long frame) {
  return fmt::format("vtk/{}_{:04}.vtp", what, frame);
}

/// Of the air's state, in turn.
constexpr const char* air_names[] = {"even", "odd"};

// The run does not resume from it when the opening is sealed.
void drop_air_checkpoint(const fs::path& folder) {
  remove_path(folder / "air");
}

std::string air_file(const Opening& solver, long long frame) {
  return fmt::format("vtk/air_{:04}.{}", frame, solver.problem().air->flow.grid.uniform() ? "vti" : "vtr");
}

/// Writes every file of the opening before it calls the next observer.
class InflationFolder : public InflationObserver {
 public:
  InflationFolder(ClaimedFolder& folder, const InflationFolderSettings& settings, InflationObserver& next)
      : folder_(folder),
        report_(settings.run.report),
        keep_end_(settings.keep_end),
        checkpoint_every_(settings.checkpoint_every_s),
        next_(next) {}

  void begin(const Opening& solver, InflationState& state, InflationHistory& history) override;
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory& history,
                const InflationFrame* frame) override;
  void ended(const Opening& solver, const InflationState& state, const InflationHistory& history,
             const InflationResult& result) override;

 private:
  void write_start(const Opening& solver, const InflationState& state) const;
  void write_shape(const Opening& solver, const InflationState& state) const;
  std::string tables_hash() const;
  /// Everything so far is on the disk when this returns.
  void save(const Opening& solver, const InflationState& state, const InflationHistory& history);
  void write_air(const Opening& solver, long long frame) const;
  void write_air_plot(const InflationHistory& history, const InflationResult& result) const;
  void write_load(const Opening& solver, const std::vector<HistoryRow>& rows,
                  const InflationResult& result) const;
  void write_shapes(const Opening& solver, const InflationState& state, const std::string& title) const;

  /// Columns of reefed openings are at the end of a row.
  template <class Row>
  std::vector<double> written(const Row& row) const {
    std::vector<double> values = row_of(row);
    values.resize(values.size() - unwritten<Row>());
    return values;
  }
  template <class Row>
  CsvLog table(const char* name, std::size_t kept) const {
    std::vector<std::string> columns = columns_of<Row>();
    columns.resize(columns.size() - unwritten<Row>());
    return {folder_.own(name), std::move(columns), kept};
  }
  template <class Row>
  std::vector<Row> rows_of(const char* name) const {
    std::vector<Row> rows;
    for (std::vector<double> row : read_csv(folder_.own(name)).rows) {
      row.resize(row.size() + unwritten<Row>());
      rows.push_back(from_row<Row>(row));
    }
    return rows;
  }
  template <class Row>
  std::size_t unwritten() const {
    return reefed_ ? 0 : std::is_same_v<Row, HistoryRow> ? 2 : std::is_same_v<Row, InflationFrame> ? 1 : 0;
  }

  ClaimedFolder& folder_;
  bool report_, keep_end_;
  double checkpoint_every_;  // [s]
  InflationObserver& next_;
  double saved_ = clock_now();  // when [s]
  bool with_air_ = false, reefed_ = false;
  std::size_t saved_rows_ = 0, saved_frames_ = 0, saved_air_ = 0;  // of the history, that the tables have
  int air_ = 0;  // which of its two folders the next checkpoint's air goes to
};

// The tables belong to the state of the checkpoint: it begins with their hash.
std::string InflationFolder::tables_hash() const {
  std::string hashes = hash_file(folder_.own("history.csv")) + hash_file(folder_.own("balance.csv"));
  if (with_air_) hashes += hash_file(folder_.own("air.csv"));
  return hash_bytes(hashes);
}

void InflationFolder::begin(const Opening& solver, InflationState& state, InflationHistory& history) {
  const fs::path saved = folder_.own("checkpoint");
  const bool goes_on = fs::exists(saved);
  with_air_ = solver.air() != nullptr;
  reefed_ = !solver.problem().reefing.empty();
  std::string tables;
  if (goes_on) {
    const std::string bytes = read_sealed(saved);
    tables = bytes.substr(0, bytes.find('\n'));
    InflationState earlier =
        inflation_state_from_bytes(bytes.substr(std::min(bytes.size(), tables.size() + 1)));
    if (earlier.cloth.x.size() != state.cloth.x.size()) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: belongs to a different mesh; start again with --fresh", saved.string()));
    }
    state = std::move(earlier);
    if (with_air_) {  // the hash is followed by the folder of its air
      air_ = tables.ends_with(air_names[1]) ? 1 : 0;
      tables.resize(tables.find(' '));
      solver.air()->restore(folder_.own("air/") / air_names[air_]);
      air_ = 1 - air_;
    }
  }
  saved_rows_ = static_cast<std::size_t>(state.blocks * solver.rows_per_block());
  saved_frames_ = static_cast<std::size_t>(state.blocks * solver.problem().settings.frames / solver.blocks());
  table<HistoryRow>("history.csv", saved_rows_);
  table<InflationFrame>("balance.csv", saved_frames_);
  saved_air_ = static_cast<std::size_t>(state.air.steps);
  if (with_air_) table<AirRow>("air.csv", saved_air_);
  if (goes_on && tables != tables_hash()) {
    throw Error(
        ExitCode::bad_data,
        fmt::format(
            "{}: history.csv or balance.csv is missing or was changed after the checkpoint; start again with "
            "--fresh",
            folder_.path().string()));
  }
  history = {rows_of<HistoryRow>("history.csv"), rows_of<InflationFrame>("balance.csv"), {}};
  if (with_air_) history.air = rows_of<AirRow>("air.csv");
  refuse_lost(folder_);
  if (!goes_on) write_start(solver, state);
  next_.begin(solver, state, history);
}

void InflationFolder::advanced(const Opening& solver, const InflationState& state,
                               const InflationHistory& history, const InflationFrame* frame) {
  if (frame) {
    write_shape(solver, state);
    if (clock_now() - saved_ > (with_air_ ? 6 : 1) * checkpoint_every_) save(solver, state, history);
  }
  next_.advanced(solver, state, history, frame);
}

void InflationFolder::save(const Opening& solver, const InflationState& state,
                           const InflationHistory& history) {
  const auto add = [&](CsvLog log, const auto& all, std::size_t& done) {
    std::vector<std::vector<double>> rows;
    for (; done < all.size(); ++done) rows.push_back(written(all[done]));
    log.add_rows(rows);
  };
  add(table<HistoryRow>("history.csv", saved_rows_), history.rows, saved_rows_);
  add(table<InflationFrame>("balance.csv", saved_frames_), history.frames, saved_frames_);
  if (with_air_) add(table<AirRow>("air.csv", saved_air_), history.air, saved_air_);
  std::string tables = tables_hash();
  if (with_air_) {  // the last checkpoint keeps its own until this one is whole
    solver.air()->save(folder_.own("air/") / air_names[air_]);
    tables += fmt::format(" {}", air_names[air_]);
    air_ = 1 - air_;
  }
  folder_.keep();
  write_sealed(folder_.own("checkpoint"), tables + '\n' + to_bytes(state));
  saved_ = clock_now();
}

void InflationFolder::ended(const Opening& solver, const InflationState& state,
                            const InflationHistory& history, const InflationResult& result) {
  save(solver, state, history);
  write_load(solver, history.rows, result);
  write_shapes(solver, state, result.title);
  if (with_air_) write_air_plot(history, result);
  CsvTable lines{{"line", "peak_tension_n"}, {}};
  for (std::size_t i = 0; i < result.line_peaks.size(); ++i)
    lines.rows.push_back({static_cast<double>(i + 1), result.line_peaks[i]});
  write_csv(folder_.own("lines.csv"), lines);
  const InflationSettings& settings = solver.problem().settings;
  for (const char* what : {"canopy", "lines"}) {
    std::vector<VtkSeriesFile> series;
    for (int i = 0; i <= settings.frames; ++i) {
      series.push_back({settings.duration_s * i / settings.frames, shape_file(what, i)});
    }
    write_pvd(folder_.own(fmt::format("{}.pvd", what)), series);
  }
  if (with_air_) {
    std::vector<VtkSeriesFile> series;
    for (int i = 1; i <= settings.frames; ++i)
      series.push_back({settings.duration_s * i / settings.frames, air_file(solver, i)});
    write_pvd(folder_.own("air.pvd"), series);
  }
  InflationResult named = result;
  named.inputs_hash = inputs_of_run(folder_.path());
  write_file(folder_.own("result.json"), to_json(named));
  if (report_)
    if (const std::string failure = write_run_report(folder_); !failure.empty()) next_.warned(failure);
  if (keep_end_ && with_air_ && solver.problem().air->payload)
    solver.air()->save(folder_.own(std::string(end_folder) + "/"));
  folder_.seal();
  drop_air_checkpoint(folder_.path());
  next_.ended(solver, state, history, result);
}

void InflationFolder::write_start(const Opening& solver, const InflationState& state) const {
  make_folder(folder_.path() / "vtk");
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
  write_canopy_picture(folder_.own("folded.png"), solver.mesh(), folded.positions,
                       {fmt::format("folded start: {} folds between {:.3f} m and {:.3f} m", folded.folds,
                                    folded.inner_radius, folded.outer_radius),
                        "strips between the folds, alternately", flat, ColourRange{-0.5, 1.5}});
  const std::vector<Vec3> x = positions(state.cloth, solver.cloth());
  write_vtp(folder_.own(shape_file("canopy", 0)), canopy_surface(solver.mesh(), x));
  write_vtp(folder_.own(shape_file("lines", 0)), spring_lines(solver.mesh(), x));
}

void InflationFolder::write_shape(const Opening& solver, const InflationState& state) const {
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
  if (with_air_)
    canopy.cell_arrays.push_back(vtk_array_single("pressure_difference_applied_pa",
                                                  cloth_cells_only(solver.mesh(), state.air.pressure)));
  write_vtp(folder_.own(shape_file("canopy", index)), canopy);
  VtkSurface lines = spring_lines(solver.mesh(), x);
  lines.cell_arrays.push_back(vtk_array_single("tension_n", spring_tensions(solver.cloth(), state.cloth)));
  write_vtp(folder_.own(shape_file("lines", index)), lines);
  if (with_air_) write_air(solver, index);
}

void InflationFolder::write_air(const Opening& solver, long long frame) const {
  const fs::path file = folder_.own(air_file(solver, frame));
  write_image(fs::path(file).replace_extension(), flow_image(middle_plane(solver.air()->flow().field())));
}

void InflationFolder::write_air_plot(const InflationHistory& history, const InflationResult& r) const {
  PlotSeries area{"C_D S", {}, {}, true, false};
  for (const AirRow& row : history.air) area.x.push_back(row.time), area.y.push_back(row.drag_area);
  PlotSeries projected{"projected area", {}, {}, true, false, true};
  for (const InflationFrame& frame : history.frames)
    projected.x.push_back(frame.time), projected.y.push_back(frame.size.projected_area);
  write_plot(folder_.own("drag_area.png"),
             {r.title, {"time from deployment [s]"}, {"area [m²]"}, {area, projected}});
  PlotSeries added{"added mass", {}, {}, true, false};
  for (const AirRow& row : history.air) added.x.push_back(row.time), added.y.push_back(row.added_mass);
  write_plot(folder_.own("added_mass.png"),
             {r.title, {"time from deployment [s]"}, {"added mass [kg]"}, {added}});
}

void InflationFolder::write_load(const Opening& solver, const std::vector<HistoryRow>& rows,
                                 const InflationResult& r) const {
  std::vector<double> smooth;
  if (r.settings.low_pass_hz > 0) {
    for (const HistoryRow& row : rows) smooth.push_back(row.mean);
    smooth = low_pass(smooth, solver.row_duration(), r.settings.low_pass_hz);
  }
  write_plot(folder_.own("load.png"), load_plot(rows, smooth, r));
  if (smooth.empty()) return;
  CsvTable table{{"time_s", "load_n"}, {}};
  for (std::size_t i = 0; i < rows.size(); ++i) table.rows.push_back({rows[i].time, smooth[i]});
  write_csv(folder_.own("history_low_pass.csv"), table);
}

void InflationFolder::write_shapes(const Opening& solver, const InflationState& state,
                                   const std::string& title) const {
  std::vector<CanopyShot> shots;
  for (const Snapshot& shot : state.snapshots) {
    shots.push_back({fmt::format("t = {:.1f} ms", 1000 * shot.time), shot.positions, shot.von_mises});
  }
  write_contact_sheet(folder_.own("shapes.png"), solver.mesh(), title, "von Mises stress [N/m]", shots);
}

}  // namespace

Plot load_plot(const std::vector<HistoryRow>& rows, const std::vector<double>& smooth,
               const InflationResult& r) {
  const InflationSettings& settings = r.settings;
  PlotSeries load{"load", {}, {}, true, false}, largest{"maximum in the interval", {}, {}, true, false};
  for (const HistoryRow& row : rows) {
    load.x.push_back(row.time);
    load.y.push_back(row.mean);
    largest.x.push_back(row.time);
    largest.y.push_back(row.largest);
  }
  Plot plot{r.title, {"time from deployment [s]"}, {"axial load [N]"}, {largest, load}};
  if (!smooth.empty())
    plot.series.push_back(
        {fmt::format("low-passed at {:g} Hz", settings.low_pass_hz), load.x, smooth, true, false});
  if (r.stages) {
    PlotSeries line{"tension of the reefing line", load.x, {}, true, false};
    for (const HistoryRow& row : rows) line.y.push_back(row.reefing_mean);
    plot.series.push_back(std::move(line));
  }
  for (const StageSummary& stage : r.stages.value_or(std::vector<StageSummary>{}))
    if (stage.begin > 0)
      plot.series.push_back({fmt::format("cut at {:g} s", stage.begin),
                             {stage.begin, stage.begin},
                             {0, r.peak_load},
                             true,
                             false,
                             true});
  const auto level = [&](const std::string& name, std::optional<double> value_n) {
    if (value_n)
      plot.series.push_back({name, {0, settings.duration_s}, {*value_n, *value_n}, true, false, true});
  };
  level("steady", r.steady_load);
  level("infinite mass, C_x C_D S0 q", r.estimate.load);
  level("measured peak", settings.measured_peak_n);
  level("peak, model of the source", settings.printed_peak_n);
  return plot;
}

std::string to_bytes(const InflationState& state) {
  return to_cbor(state, opening_format);
}

InflationState inflation_state_from_bytes(const std::string& bytes) {
  return from_cbor<InflationState>(bytes, opening_format, "a checkpoint of an opening");
}

namespace {

std::string solver_of(const LoadSource& source) {
  return "inflation; pressure from " + source.text;
}

}  // namespace

void check_inflation_in(const InflationFolderSettings& settings, const Settings& resolved,
                        const LoadSource& source) {
  require_unclaimed(settings.run.folder);
  if (holds_run(settings.run, resolved, solver_of(source))) finished_result(settings.run.folder);
}

std::optional<InflationResult> run_inflation_in(const InflationFolderSettings& settings,
                                                const Settings& resolved, const LoadSource& source,
                                                const std::function<InflationProblem()>& problem,
                                                InflationObserver& observer) {
  const auto claimed = open_run_folder(settings.run, resolved, solver_of(source), settings.threads);
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (finished_result(settings.run.folder)) {
    drop_air_checkpoint(settings.run.folder);
    return std::nullopt;
  }
  InflationFolder files(*claimed, settings, observer);
  InflationResult result = run_inflation(resolved, source, problem(), files).result;
  result.inputs_hash = inputs_of_run(settings.run.folder);
  return result;
}

}  // namespace ripstop
