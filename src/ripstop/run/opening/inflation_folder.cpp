#include "ripstop/run/opening/inflation_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/flow/stl.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/canopy_curves.h"
#include "ripstop/run/json.h"
#include "ripstop/run/march_files.h"
#include "ripstop/run/opening/finished_opening.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// Of InflationState's list of members: one more with every change of it.
constexpr int opening_format = 9;

/// Riser loads of the canopies of a cluster, and when each of them opens.
Plot riser_plot(const std::vector<CanopyRow>& rows, const InflationResult& result) {
  Plot plot{result.title,
            {"time from deployment [s]"},
            {"riser load [N]"},
            canopy_curves(rows, [](const CanopyRow& row) { return row.riser_load; })};
  double largest = 0;
  for (const CanopyOpening& canopy : result.cluster->canopies) largest = std::max(largest, canopy.peak_load);
  for (std::size_t k = 0; k < result.cluster->canopies.size(); ++k)
    if (const double delay = result.cluster->canopies[k].delay.value_or(0); delay > 0)
      plot.series.push_back(
          {fmt::format("canopy {} opens", k + 1), {delay, delay}, {0, largest}, true, false, true});
  return plot;
}

/// Writes every file of the opening before it calls the next observer.
class InflationFolder : public InflationObserver {
 public:
  InflationFolder(RunFolder& folder, const InflationFolderSettings& settings, InflationObserver& next)
      : folder_(folder),
        files_(folder, settings.checkpoint_every_s),
        keep_end_(settings.keep_end),
        next_(next) {}

  void begin(const Opening& solver, InflationState& state, InflationHistory& history) override;
  void advanced(const Opening& solver, const InflationState& state, const InflationHistory& history,
                const InflationFrame* frame) override;
  void ended(const Opening& solver, const InflationState& state, const InflationHistory& history,
             const InflationResult& result) override;

 private:
  void write_start(const Opening& solver, const InflationState& state) const;
  /// Everything so far is on the disk when this returns.
  void save(const Opening& solver, const InflationState& state, const InflationHistory& history);
  void write_air_plot(const InflationHistory& history, const InflationResult& result) const;
  void write_load(const Opening& solver, const std::vector<HistoryRow>& rows,
                  const InflationResult& result) const;
  void write_bodies(const Opening& solver) const;
  void write_shapes(const Opening& solver, const InflationState& state, const std::string& title) const;

  /// Columns of reefed openings are at the end of a row.
  std::size_t unwritten(std::size_t of_reefing) const { return reefed_ ? 0 : of_reefing; }

  RunFolder& folder_;
  MarchFiles files_;
  bool keep_end_;
  InflationObserver& next_;
  bool with_air_ = false, with_bodies_ = false, reefed_ = false;
};

void InflationFolder::begin(const Opening& solver, InflationState& state, InflationHistory& history) {
  with_air_ = solver.air() != nullptr;
  with_bodies_ = with_air_ && solver.problem().air->flow.bodies.size() > 1;
  reefed_ = !solver.problem().reefing.empty();
  const std::optional<std::string> saved = files_.load();
  if (saved) {
    InflationState earlier = inflation_state_from_bytes(*saved);
    if (earlier.cloth.x.size() != state.cloth.x.size()) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{}/checkpoint: belongs to a different mesh; start again with --fresh",
                              folder_.path().string()));
    }
    state = std::move(earlier);
    if (with_air_) files_.restore(*solver.air());
  }
  const long long frames = solver.problem().settings.frames;
  history = {
      files_.open<HistoryRow>("history.csv", static_cast<std::size_t>(state.blocks * solver.rows_per_block()),
                              unwritten(2)),
      files_.open<InflationFrame>(
          "balance.csv", static_cast<std::size_t>(state.blocks * frames / solver.blocks()), unwritten(1)),
      {},
      {},
      {}};
  if (const int canopies = solver.canopies(); canopies > 1)
    history.canopies =
        files_.open<CanopyRow>("canopies.csv", static_cast<std::size_t>(state.blocks * canopies));
  if (with_air_) history.air = files_.open<AirRow>("air.csv", static_cast<std::size_t>(state.air.steps));
  if (with_bodies_)
    history.bodies =
        files_.open<OpeningBodyRow>("bodies.csv", static_cast<std::size_t>(state.air.steps) *
                                                      (solver.problem().air->flow.bodies.size() - 1));
  files_.check();
  if (!saved) write_start(solver, state);
  next_.begin(solver, state, history);
}

void InflationFolder::advanced(const Opening& solver, const InflationState& state,
                               const InflationHistory& history, const InflationFrame* frame) {
  if (frame) {
    const long long index = state.blocks * solver.problem().settings.frames / solver.blocks();
    write_frame(folder_, solver.mesh(), solver.cloth(), state.cloth,
                with_air_ ? state.air.pressure : std::vector<double>(), index);
    if (with_air_) write_air_frame(folder_, *solver.air(), index);
    if (files_.due(with_air_ ? 6 : 1)) save(solver, state, history);
  }
  next_.advanced(solver, state, history, frame);
}

void InflationFolder::save(const Opening& solver, const InflationState& state,
                           const InflationHistory& history) {
  files_.add("history.csv", history.rows);
  files_.add("balance.csv", history.frames);
  if (!history.canopies.empty()) files_.add("canopies.csv", history.canopies);
  if (with_air_) files_.add("air.csv", history.air);
  if (with_bodies_) files_.add("bodies.csv", history.bodies);
  files_.save(to_bytes(state), solver.air());
}

void InflationFolder::ended(const Opening& solver, const InflationState& state,
                            const InflationHistory& history, const InflationResult& result) {
  save(solver, state, history);
  write_load(solver, history.rows, result);
  write_shapes(solver, state, result.title);
  if (with_air_) write_air_plot(history, result);
  if (result.cluster) folder_.write("canopies.png", riser_plot(history.canopies, result));
  CsvTable lines{{"line", "peak_tension_n"}, {}};
  for (std::size_t i = 0; i < result.line_peaks.size(); ++i)
    lines.rows.push_back({static_cast<double>(i + 1), result.line_peaks[i]});
  folder_.write("lines.csv", lines);
  const InflationSettings& settings = solver.problem().settings;
  const auto time = [&](long long frame) {
    return settings.duration_s * static_cast<double>(frame) / settings.frames;
  };
  for (const char* what : {"canopy", "lines"}) write_frames(folder_, what, 0, settings.frames, time);
  if (with_bodies_) write_bodies(solver);
  if (with_air_)
    write_frames(folder_, "air", 1, settings.frames, time, air_ending(solver.problem().air->flow.grid));
  if (keep_end_ && with_air_ && solver.problem().air->payload)
    solver.air()->save(folder_.own(std::string(end_folder) + "/"));
  if (const std::string failure = folder_.end(result); !failure.empty()) next_.warned(failure);
  files_.drop_air();
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
  folder_.write(frame_file("canopy", 0), canopy_surface(solver.mesh(), x));
  folder_.write(frame_file("lines", 0), spring_lines(solver.mesh(), x));
}

void InflationFolder::write_air_plot(const InflationHistory& history, const InflationResult& r) const {
  PlotSeries area{"C_D S", {}, {}, true, false};
  for (const AirRow& row : history.air) area.x.push_back(row.time), area.y.push_back(row.drag_area);
  PlotSeries projected{"projected area", {}, {}, true, false, true};
  for (const InflationFrame& frame : history.frames)
    projected.x.push_back(frame.time), projected.y.push_back(frame.size.projected_area);
  folder_.write("drag_area.png",
                Plot{r.title, {"time from deployment [s]"}, {"area [m²]"}, {area, projected}});
  PlotSeries added{"added mass", {}, {}, true, false};
  for (const AirRow& row : history.air) added.x.push_back(row.time), added.y.push_back(row.added_mass);
  folder_.write("added_mass.png", Plot{r.title, {"time from deployment [s]"}, {"added mass [kg]"}, {added}});
}

void InflationFolder::write_load(const Opening& solver, const std::vector<HistoryRow>& rows,
                                 const InflationResult& r) const {
  std::vector<double> smooth;
  if (r.settings.low_pass_hz > 0) {
    for (const HistoryRow& row : rows) smooth.push_back(row.mean);
    smooth = low_pass(smooth, solver.row_duration(), r.settings.low_pass_hz);
  }
  folder_.write("load.png", load_plot(rows, smooth, r));
  if (smooth.empty()) return;
  CsvTable table{{"time_s", "load_n"}, {}};
  for (std::size_t i = 0; i < rows.size(); ++i) table.rows.push_back({rows[i].time, smooth[i]});
  folder_.write("history_low_pass.csv", table);
}

void InflationFolder::write_bodies(const Opening& solver) const {
  const std::vector<FlowBody>& bodies = solver.problem().air->flow.bodies;
  for (std::size_t n = 1; n < bodies.size(); ++n)
    write_stl(folder_.own(fmt::format("body-{}.stl", bodies[n].name)), bodies[n].surface);
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
  level("peak, published model", settings.printed_peak_n);
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
  if (claimed->finished()) {
    MarchFiles::drop_air(settings.run.folder);
    return std::nullopt;
  }
  InflationFolder files(*claimed, settings, observer);
  InflationResult result = run_inflation(resolved, source, problem(), files).result;
  result.inputs_hash = inputs_of_run(settings.run.folder);
  return result;
}

}  // namespace ripstop::inline run
