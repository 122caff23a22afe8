// fly(): a free flight with its path as arrays.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "members.h"
#include "module.h"
#include "notebook.h"
#include "ripstop/run/flight/flight_folder.h"
#include "ripstop/run/json.h"
#include "ripstop/run/report/report_flight.h"
#include "runs.h"

namespace ripstop {
/// Called after every step of the flow.
struct FlightProgress {
  double time = 0, duration = 0;  // [s]
  double descent = 0;             // [m/s]
  double angle = 0;               // [deg]
};
template <Of<FlightProgress> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("time_s", p.time);
  visit("duration_s", p.duration);
  visit("rate_of_descent_m_s", p.descent);
  visit("oscillation_deg", p.angle);
}
}  // namespace ripstop

namespace ripstop::python {
namespace {

struct PyFlight {
  PyCase made;
  FlightResult result;
  std::vector<FreeFlightRow> path;
  std::vector<Vec3> shape;         // at the end
  std::vector<CellStress> stress;  // likewise
  CanopyMesh mesh;
  std::vector<Cell> cells;
  Path folder;  // empty: in memory only
};

class FlightListener : public FlightObserver {
 public:
  FlightListener(Listener& listener, PyFlight& run) : listener_(listener), run_(run) {}
  void starting(const SteadyProgress&, const SteadyState&) override { listener_.listen(); }
  InflationObserver& opening() override { return opening_; }
  void begin(FreeFlight& flight, FreeFlightState&, FlightHistory&) override {
    run_.mesh = flight.mesh();
    run_.cells = cells_of(run_.mesh);
  }
  void advanced(FreeFlight& flight, const FreeFlightState&, const FlightHistory& history, bool) override {
    const FreeFlightRow& row = history.rows.back();
    listener_.tell(FlightProgress{row.time - flight.began(), flight.problem().settings.duration_s,
                                  -row.velocity.z, row.angle});
  }
  void ended(FreeFlight& flight, const FreeFlightState& state, const FlightHistory& history,
             const FlightResult& result) override {
    run_.result = result, run_.path = history.rows;
    run_.shape = positions(state.coupled.cloth, flight.cloth());
    run_.stress = cell_stress(flight.cloth(), state.coupled.cloth);
  }

 private:
  /// An interruption ends the inflation that comes first, too.
  struct Interruption : InflationObserver {
    explicit Interruption(Listener& to) : listener(to) {}
    void advanced(const fsi::Opening&, const InflationState&, const InflationHistory&,
                  const InflationFrame*) override {
      listener.listen();
    }
    Listener& listener;
  };
  Listener& listener_;
  PyFlight& run_;
  Interruption opening_{listener_};
};

std::unique_ptr<PyFlight> fly(const PyCase& given, Callback<FlightProgress> progress, int threads,
                              const std::optional<Path>& out, bool fresh, const std::optional<Path>& from,
                              bool deploy) {
  auto run = std::make_unique<PyFlight>();
  run->made = given;
  if (out) run->folder = *out;
  if (deploy) run->made.given.flight.start = FlightSettings::Start::inflation;
  const std::filesystem::path opening = from.value_or(std::filesystem::path());
  Listener listener(std::move(progress));
  FlightListener observer(listener, *run);
  const py::gil_scoped_release release;
  const Settings resolved = flight_settings(run->made.given, opening);
  const int used = threads > 0 ? threads : resolved.coupling().threads;
  if (!out)
    run_flight(resolved, used, observer, opening);
  else if (!run_flight_in({{*out, fresh}, used, 30, opening}, resolved, observer))
    run->result = from_json_text<FlightResult>(*finished_result(*out), "the result of a flight");
  return run;
}

const PyFlight& run_of_flight(const py::object& self) {
  return self.cast<const PyFlight&>();
}

}  // namespace

void add_fly(py::module_& module) {
  add_class<CanopyMotion>(module, "CanopyMotion",
                          "Spread angle and loads of one canopy of a cluster in flight.");
  add_class<ClusterMotion>(module, "ClusterMotion",
                           "Spread angles, loads and distances of the canopies of a cluster in flight.");
  add_class<FlightBody>(module, "FlightBody", "Mean loads on a rigid body in flight.");
  add_class<FlightCluster>(module, "FlightCluster", "The cluster of a flight.");
  add_class<Handover>(module, "Handover", "End of an inflation and start of the flight that continues it.");
  add_class<FlightProgress>(module, "FlightProgress", "Progress of a flight.");
  py::class_<PyFlight> type(module, "Flight",
                            "Result of a free flight: the values of result.json, and arrays.");
  const auto result = [](const PyFlight& run) -> const FlightResult& { return run.result; };
  add_members(type, result);
  add_json(type, result);
  type.def_property_readonly(
      "path", [](const py::object& self) { return table_of(run_of_flight(self).path, self); },
      "A row for each step of the flow, with the columns of path.csv.");
  type.def_property_readonly(
      "shape", [](const py::object& self) { return view_of(run_of_flight(self).shape, self); },
      "Position of every node of the parachute in the flow domain at the end: x, y, z; z is up [m]");
  type.def_property_readonly(
      "cells", [](const py::object& self) { return view_of_cells(run_of_flight(self).cells, self); },
      "Nodes at the four corners of every cloth cell; the first is -1 for a missing cell.");
  add_page(type, [](const PyFlight& run) {
    ReportRun shown = memory_report("flight", to_json(run.result), run.made.settings());
    shown.plots = flight_plots(run.path);
    shown.shape = memory_shape(run.mesh, run.shape, run.stress);
    return shown;
  });
  type.def_property_readonly(
      "case", [](const PyFlight& run) { return run.made; }, "Case of the flight.");
  module.def(
      "fly", &fly, py::arg("case"), py::kw_only(), py::arg("progress") = py::none(), py::arg("threads") = 0,
      py::arg("out") = py::none(), py::arg("fresh") = false, py::arg("from_run") = py::none(),
      py::arg("deploy") = false,
      "Computes the free flight of parachute and payload: ripstop fly.\n\n"
      "progress: called with a FlightProgress after every step of the flow; an exception in it\n"
      "  stops the run.\n"
      "threads: number of threads; 0: coupling.threads of the case.\n"
      "out: run folder, as in steady(). The values of a finished flight are read from it, and the\n"
      "  arrays are empty. None: no files.\n"
      "fresh: replace the run in the folder.\n"
      "from_run: folder of a coupled inflation with the payload, from whose end the flight continues.\n"
      "deploy: compute that inflation first, as flight.start = \"inflation\" does.");
}

}  // namespace ripstop::python
