#include "ripstop/run/flight/flight_folder.h"

#include <fmt/format.h>

#include <utility>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/hash.h"
#include "ripstop/output/csv.h"
#include "ripstop/output/picture.h"
#include "ripstop/output/plot.h"
#include "ripstop/output/vtk.h"
#include "ripstop/run/canopy_curves.h"
#include "ripstop/run/json.h"
#include "ripstop/run/march_files.h"

namespace ripstop::inline run {
namespace {

namespace fs = std::filesystem;

// Of the list of members of FreeFlightState: one more with every change of it.
constexpr int flight_format = 5;
constexpr const char* what_is_saved = "a checkpoint of a flight";

std::string body_series(const std::string& name) {
  return "body-" + name;
}

/// Writes every file of the flight before it calls the next observer.
class FlightFolder : public FlightObserver {
 public:
  FlightFolder(RunFolder& folder, const FlightFolderSettings& settings, FlightObserver& next)
      : folder_(folder), files_(folder, settings.checkpoint_every_s), next_(next) {}

  void warned(const std::string& text) override { next_.warned(text); }
  void starting(const SteadyProgress& progress, const SteadyState& state) override {
    next_.starting(progress, state);
  }
  InflationObserver& opening() override { return next_.opening(); }
  RunSettings opening_run() override {
    RunSettings run = folder_.settings();
    run.folder /= opening_name;
    return run;
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

  RunFolder& folder_;
  MarchFiles files_;
  FlightObserver& next_;
};

void FlightFolder::begin(FreeFlight& flight, FreeFlightState& state, FlightHistory& history) {
  const std::optional<std::string> saved = files_.load();
  if (saved) {
    state = from_cbor<FreeFlightState>(*saved, flight_format, what_is_saved);
    files_.restore(flight.air());
  }
  const auto steps = static_cast<std::size_t>(saved ? state.coupled.air.steps : 0);
  history.rows = files_.open<FreeFlightRow>("path.csv", steps);
  if (const int canopies = flight.canopies(); canopies > 1)
    history.canopies = files_.open<CanopyRow>("canopies.csv", steps * static_cast<std::size_t>(canopies));
  if (const std::size_t bodies = flight.problem().air.flow.bodies.size() - 1; bodies > 0)
    history.bodies = files_.open<FlightBodyRow>("bodies.csv", steps * bodies);
  files_.check();
  if (!saved) write_shape(flight, state, 0);
  next_.begin(flight, state, history);
}

void FlightFolder::advanced(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
                            bool shape) {
  if (shape)
    write_shape(flight, state,
                shapes_until(history.rows.back().time - flight.began(), flight.problem().settings));
  if (files_.due()) save(flight, state, history);
  next_.advanced(flight, state, history, shape);
}

void FlightFolder::save(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history) {
  files_.add("path.csv", history.rows);
  if (!history.canopies.empty()) files_.add("canopies.csv", history.canopies);
  if (!history.bodies.empty()) files_.add("bodies.csv", history.bodies);
  files_.save(to_cbor(state, flight_format), &flight.air());
}

// In the box, which follows the canopy.
void FlightFolder::write_shape(FreeFlight& flight, const FreeFlightState& state, long long index) {
  write_frame(folder_, flight.mesh(), flight.cloth(), state.coupled.cloth, state.coupled.air.pressure, index);
  const std::vector<FlowBody>& bodies = flight.problem().air.flow.bodies;
  for (const Placement& placed : flight.bodies(state))
    folder_.write(frame_file(body_series(bodies[placed.body].name), index), triangle_surface(placed.surface));
  if (index > 0) write_air_frame(folder_, flight.air(), index);
}

void FlightFolder::write_series(const FreeFlight& flight, double end) {
  const FlightSettings& s = flight.problem().settings;
  const long long last = shapes_until(end - flight.began(), s);
  const auto time = [&](long long frame) {
    return flight.began() + static_cast<double>(frame) / s.shapes_per_s;
  };
  for (const char* what : {"canopy", "lines"}) write_frames(folder_, what, 0, last, time);
  const std::vector<FlowBody>& bodies = flight.problem().air.flow.bodies;
  for (std::size_t n = 1; n < bodies.size(); ++n)
    write_frames(folder_, body_series(bodies[n].name), 0, last, time);
  write_frames(folder_, "air", 1, last, time, air_ending(flight.problem().air.flow.grid));
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
  draw("path", {result.title, {"horizontal position of the payload [m]"}, {"height [m]"}, {x, y}});
  draw("angle", {result.title, {"time [s]"}, {"angle [deg]"}, {angle, attack}});
  draw("descent", {result.title, {"time [s]"}, {"rate of descent [m/s]"}, {down}});
  draw("force", {result.title, {"time [s]"}, {"force of the lines on the payload [N]"}, {force}});
  if (history.canopies.empty()) return;
  draw("canopies", {result.title,
                    {"time [s]"},
                    {"spread angle [deg]"},
                    canopy_curves(history.canopies, [](const CanopyRow& row) { return row.spread; })});
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
  if (const std::string failure = folder_.end(result); !failure.empty()) next_.warned(failure);
  files_.drop_air();
  next_.ended(flight, state, history, result);
}

}  // namespace

std::optional<FlightResult> run_flight_in(const FlightFolderSettings& settings, const Settings& resolved,
                                          FlightObserver& observer) {
  const std::string solver =
      settings.from.empty() ? "flight" : "flight from " + inputs_of_run(settings.from).value_or("");
  const auto claimed = open_run_folder(settings.run, resolved, solver, settings.threads);
  if (!claimed->warning().empty()) observer.warned(claimed->warning());
  if (claimed->finished()) return std::nullopt;
  FlightFolder files(*claimed, settings, observer);
  FlightResult result = run_flight(resolved, settings.threads, files, settings.from).result;
  result.inputs_hash = inputs_of_run(settings.run.folder);
  return result;
}

}  // namespace ripstop::inline run
