#include "ripstop/run/flight/flight_folder.h"

#include <fmt/format.h>

#include <chrono>
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
#include "ripstop/run/report/report.h"

namespace ripstop {
namespace {

namespace fs = std::filesystem;

// Of the list of members of FreeFlightState: one more with every change of it.
constexpr int flight_format = 2;
constexpr const char* what_is_saved = "a checkpoint of a flight";
/// Of the state of the air, alternating.
constexpr const char* air_folders[] = {"even", "odd"};

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Writes every file of the flight before it calls the next observer.
class FlightFolder : public FlightObserver {
 public:
  FlightFolder(ClaimedFolder& folder, const FlightFolderSettings& settings, FlightObserver& next)
      : folder_(folder), settings_(settings), next_(next) {}

  void warned(const std::string& text) override { next_.warned(text); }
  void starting(const SteadyProgress& progress, const SteadyState& state) override {
    next_.starting(progress, state);
  }
  InflationObserver& opening() override { return next_.opening(); }
  RunSettings opening_run() override {
    return {folder_.path() / opening_name, settings_.run.fresh, settings_.run.fields, settings_.run.report};
  }
  std::optional<FlightStart> earlier_start() override {
    if (!fs::exists(folder_.own("checkpoint"))) return {};
    return from_cbor<FlightStart>(read_sealed(folder_.own("start")), flight_format, what_is_saved);
  }
  void started(const FlightStart& start) override {
    if (!fs::exists(folder_.own("checkpoint")))
      write_sealed(folder_.own("start"), to_cbor(start, flight_format));
    next_.started(start);
  }
  void begin(FreeFlight& flight, FreeFlightState& state, FlightHistory& history) override;
  void advanced(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
                bool shape) override;
  void ended(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
             const FlightResult& result) override;

 private:
  void save(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history);
  void write_shape(FreeFlight& flight, const FreeFlightState& state, long long index);
  void write_series(const FreeFlight& flight, double end);
  void write_plots(const FlightHistory& history, const FlightResult& result);
  static std::string shape_file(const char* what, long long index, const char* ending = "vtp") {
    return fmt::format("vtk/{}_{:04}.{}", what, index, ending);
  }
  const char* air_ending(FreeFlight& flight) const { return flight.air().grid().uniform() ? "vti" : "vtr"; }

  ClaimedFolder& folder_;
  FlightFolderSettings settings_;
  FlightObserver& next_;
  double saved_ = wall_clock();
  std::size_t saved_rows_ = 0;
  int air_ = 0;
};

// The checkpoint begins with the hash of the table that belongs to it and the folder of its air.
void FlightFolder::begin(FreeFlight& flight, FreeFlightState& state, FlightHistory& history) {
  const fs::path saved = folder_.own("checkpoint");
  make_folder(folder_.path() / "vtk");
  if (!fs::exists(saved)) {
    CsvLog(folder_.own("path.csv"), columns_of<FreeFlightRow>(), 0);
    write_shape(flight, state, 0);
    return next_.begin(flight, state, history);
  }
  const std::string bytes = read_sealed(saved);
  const std::string head = bytes.substr(0, bytes.find('\n'));
  state = from_cbor<FreeFlightState>(bytes.substr(std::min(bytes.size(), head.size() + 1)), flight_format,
                                     what_is_saved);
  saved_rows_ = static_cast<std::size_t>(state.coupled.air.steps);
  CsvLog(folder_.own("path.csv"), columns_of<FreeFlightRow>(), saved_rows_);
  if (!head.starts_with(hash_file(folder_.own("path.csv"))))
    throw Error(ExitCode::bad_data,
                fmt::format("{}: path.csv was lost or changed since the checkpoint; start again "
                            "with --fresh",
                            folder_.path().string()));
  for (const std::vector<double>& row : read_csv(folder_.own("path.csv")).rows)
    history.rows.push_back(from_row<FreeFlightRow>(row));
  const int air = head.ends_with(air_folders[1]) ? 1 : 0;
  flight.air().restore(folder_.own("air/") / air_folders[air]);
  air_ = 1 - air;
  refuse_lost(folder_);
  next_.begin(flight, state, history);
}

void FlightFolder::advanced(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
                            bool shape) {
  if (shape)
    write_shape(flight, state,
                shapes_until(history.rows.back().time - flight.began(), flight.problem().settings));
  if (wall_clock() - saved_ > settings_.checkpoint_every_s) save(flight, state, history);
  next_.advanced(flight, state, history, shape);
}

void FlightFolder::save(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history) {
  CsvLog table(folder_.own("path.csv"), columns_of<FreeFlightRow>(), saved_rows_);
  std::vector<std::vector<double>> rows;
  for (; saved_rows_ < history.rows.size(); ++saved_rows_) rows.push_back(row_of(history.rows[saved_rows_]));
  table.add_rows(rows);
  flight.air().save(folder_.own("air/") / air_folders[air_]);
  folder_.keep();
  write_sealed(folder_.own("checkpoint"),
               fmt::format("{} {}\n", hash_file(folder_.own("path.csv")), air_folders[air_]) +
                   to_cbor(state, flight_format));
  air_ = 1 - air_;
  saved_ = wall_clock();
}

// In the box, which follows the canopy.
void FlightFolder::write_shape(FreeFlight& flight, const FreeFlightState& state, long long index) {
  const ClothState& cloth = state.coupled.cloth;
  const std::vector<Vec3> x = positions(cloth, flight.cloth());
  std::vector<double> mises;
  for (const CellStress& stress : cell_stress(flight.cloth(), cloth)) mises.push_back(stress.von_mises);
  VtkSurface canopy = canopy_surface(flight.mesh(), x);
  canopy.point_arrays.push_back(vtk_array_single("velocity_m_per_s", velocities(cloth, flight.cloth())));
  canopy.cell_arrays.push_back(vtk_array_single("von_mises_n_per_m", cloth_cells_only(flight.mesh(), mises)));
  if (!state.coupled.air.pressure.empty())
    canopy.cell_arrays.push_back(vtk_array_single(
        "pressure_difference_applied_pa", cloth_cells_only(flight.mesh(), state.coupled.air.pressure)));
  write_vtp(folder_.own(shape_file("canopy", index)), canopy);
  VtkSurface lines = spring_lines(flight.mesh(), x);
  lines.cell_arrays.push_back(vtk_array_single("tension_n", spring_tensions(flight.cloth(), cloth)));
  write_vtp(folder_.own(shape_file("lines", index)), lines);
  if (index == 0) return;
  const fs::path file = folder_.own(shape_file("air", index, air_ending(flight)));
  write_image(fs::path(file).replace_extension(), flow_image(middle_plane(flight.air().flow().field())));
}

void FlightFolder::write_series(const FreeFlight& flight, double end) {
  const FlightSettings& s = flight.problem().settings;
  const auto series = [&](const char* what, const char* ending, long long first) {
    std::vector<VtkSeriesFile> files;
    for (long long i = first; i <= shapes_until(end - flight.began(), s); ++i)
      files.push_back({flight.began() + double(i) / s.shapes_per_s, shape_file(what, i, ending)});
    write_pvd(folder_.own(fmt::format("{}.pvd", what)), files);
  };
  series("canopy", "vtp", 0), series("lines", "vtp", 0);
  series("air", flight.problem().air.flow.grid.uniform() ? "vti" : "vtr", 1);
}

void FlightFolder::write_plots(const FlightHistory& history, const FlightResult& result) {
  PlotSeries x{"x", {}, {}, true, false}, y{"y", {}, {}, true, false, true},
      angle{"angle from the vertical", {}, {}, true, false},
      attack{"angle of attack", {}, {}, true, false, true}, down{"payload", {}, {}, true, false},
      force{"lines and riser", {}, {}, true, false};
  for (const FreeFlightRow& row : history.rows) {
    x.x.push_back(row.payload.x), x.y.push_back(row.payload.z);
    y.x.push_back(row.payload.y), y.y.push_back(row.payload.z);
    angle.x.push_back(row.time), angle.y.push_back(row.angle);
    attack.x.push_back(row.time), attack.y.push_back(row.attack);
    down.x.push_back(row.time), down.y.push_back(-row.velocity.z);
    force.x.push_back(row.time), force.y.push_back(norm(row.line_force));
  }
  const auto draw = [&](const char* name, const Plot& plot) {
    for (const char* ending : {".png", ".svg"}) write_plot(folder_.own(std::string(name) + ending), plot);
  };
  draw("path", {result.title, {"horizontal place of the payload [m]"}, {"height [m]"}, {x, y}});
  draw("angle", {result.title, {"time [s]"}, {"angle [deg]"}, {angle, attack}});
  draw("descent", {result.title, {"time [s]"}, {"rate of descent [m/s]"}, {down}});
  draw("force", {result.title, {"time [s]"}, {"force of the lines on the payload [N]"}, {force}});
}

void FlightFolder::ended(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
                         const FlightResult& result) {
  save(flight, state, history);
  write_series(flight, history.rows.back().time);
  write_plots(history, result);
  std::vector<CanopyShot> shots;
  for (const Snapshot& shot : state.coupled.snapshots)
    shots.push_back({fmt::format("t = {:.2f} s", shot.time), shot.positions, shot.von_mises});
  if (!shots.empty())
    write_contact_sheet(folder_.own("shapes.png"), flight.mesh(), result.title, "von Mises stress [N/m]",
                        shots);
  FlightResult named = result;
  named.inputs_hash = inputs_of_run(folder_.path());
  write_file(folder_.own("result.json"), to_json(named));
  if (settings_.run.report)
    if (const std::string failure = write_run_report(folder_); !failure.empty()) next_.warned(failure);
  folder_.seal();
  remove_path(folder_.path() / "air");
  next_.ended(flight, state, history, result);
}

}  // namespace

std::optional<FlightResult> run_flight_in(const FlightFolderSettings& settings, const Settings& resolved,
                                          FlightObserver& observer) {
  const std::string solver =
      settings.from.empty() ? "flight" : "flight from " + inputs_of_run(settings.from).value_or("");
  const auto claimed = open_run_folder(settings.run, resolved, solver, settings.threads);
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (finished_result(settings.run.folder)) return std::nullopt;
  FlightFolder files(*claimed, settings, observer);
  FlightResult result = run_flight(resolved, settings.threads, files, settings.from).result;
  result.inputs_hash = inputs_of_run(settings.run.folder);
  return result;
}

}  // namespace ripstop
