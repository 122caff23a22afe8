// inflate(): an opening with its history, frames and shapes as arrays.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "notebook.h"
#include "opening.h"
#include "ripstop/case/deployment.h"
#include "ripstop/case/opening.h"
#include "ripstop/run/json.h"
#include "ripstop/run/opening/inflation.h"
#include "ripstop/run/opening/inflation_folder.h"
#include "ripstop/run/steady/steady_folder.h"
#include "runs.h"

namespace ripstop {
/// Called after every block of an opening.
struct OpeningProgress {
  double time = 0, duration = 0;  // [s]
  double load = 0;                // mean over the last interval [N]
  double step = 0;                // [s]
};
template <Of<OpeningProgress> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("time_s", p.time);
  visit("duration_s", p.duration);
  visit("load_n", p.load);
  visit("step_s", p.step);
}
}  // namespace ripstop

namespace ripstop::python {
namespace {

class OpeningListener : public InflationObserver {
 public:
  OpeningListener(Listener& listener, PyInflation& run) : listener_(listener), run_(run) {}
  void begin(const ripstop::Opening& solver, InflationState&, InflationHistory&) override {
    run_.mesh = solver.mesh();
    run_.cells = cells_of(run_.mesh);
  }
  void advanced(const ripstop::Opening& solver, const InflationState& state, const InflationHistory& history,
                const InflationFrame*) override {
    listener_.tell(OpeningProgress{state.cloth.time, solver.problem().settings.duration_s,
                                   history.rows.back().mean, state.step});
  }
  void ended(const ripstop::Opening& solver, const InflationState& state, const InflationHistory& history,
             const InflationResult& result) override {
    run_.history = history, run_.result = result, run_.shots = state.snapshots;
    run_.shape = positions(state.cloth, solver.cloth());
    run_.velocity = velocities(state.cloth, solver.cloth());
  }

 private:
  Listener& listener_;
  PyInflation& run_;
};

std::unique_ptr<PyInflation> inflate(const PyCase& given, const OptionalSource& steady,
                                     std::optional<double> pressure, Callback<OpeningProgress> progress,
                                     int threads, const std::optional<Path>& out, bool fresh) {
  auto run = std::make_unique<PyInflation>();
  run->made = given;
  if (out) run->folder = *out;
  Listener listener(std::move(progress));
  OpeningListener observer(listener, *run);
  const py::gil_scoped_release release;
  const Opening opening = opening_of(run->made.given, steady, pressure, threads);
  const auto problem = [&] {
    return opening_problem(opening.resolved, opening.source, opening.threads, [&] { listener.listen(); });
  };
  if (!out) {
    run_inflation(opening.resolved, opening.source, problem(), observer);
  } else if (!run_inflation_in({{*out, fresh}, opening.threads}, opening.resolved, opening.source, problem,
                               observer)) {
    run->result = from_json_text<InflationResult>(*finished_result(*out), "the result of an opening");
  }
  return run;
}

const PyInflation& run_of_inflation(const py::object& self) {
  return self.cast<const PyInflation&>();
}

void add_arrays(py::class_<PyInflation>& type) {
  type.def_property_readonly(
      "history", [](const py::object& self) { return table_of(run_of_inflation(self).history.rows, self); },
      "Load on the riser over time, one row per interval: time_s, load_mean_n, load_least_n, load_largest_n, "
      "and the tension of the reefing line, reefing_line_mean_n and reefing_line_largest_n (0 without one).");
  type.def_property_readonly(
      "frames", [](const py::object& self) { return table_of(run_of_inflation(self).history.frames, self); },
      "Energies, sizes and stress over time, with the columns of balance.csv.");
  type.def_property_readonly(
      "shots",
      [](const py::object& self) -> py::list { return to_python(run_of_inflation(self).shots, self); },
      "Shapes during the opening, each an InflationShot.");
  type.def_property_readonly(
      "shape", [](const py::object& self) { return view_of(run_of_inflation(self).shape, self); },
      "Position of every node of the parachute at the end: x, y, z; z is downstream [m]");
  type.def_property_readonly(
      "velocity", [](const py::object& self) { return view_of(run_of_inflation(self).velocity, self); },
      "Velocity of every node at the end [m/s]");
  type.def_property_readonly(
      "cells", [](const py::object& self) { return view_of_cells(run_of_inflation(self).cells, self); },
      "Nodes at the four corners of every cloth cell; the first is -1 for a missing cell.");
  type.def_property_readonly(
      "line_peaks",
      [](const py::object& self) { return view_of(run_of_inflation(self).result.line_peaks, self); },
      "Maximum tension of each line over all time steps [N]");
}

}  // namespace

Opening opening_of(const Case& given, const OptionalSource& steady, std::optional<double> pressure,
                   int threads) {
  if (steady && pressure) throw Error(ExitCode::usage, "give either pressure_pa or steady, not both");
  Case changed = given;
  Overrides overrides;
  overrides.pressure = pressure;
  apply(overrides, changed);
  if (steady) {  // replaces the value of the case
    changed.inflation.pressure_pa.reset();
    changed.inflation.drag_coefficient.reset();
  }
  close_mouth(changed.parachute, changed.inflation);
  Opening opening{resolve(opening_case(changed)), {}, threads > 0 ? threads : given.coupling.threads};
  if (!steady) {
    opening.source = load_source(opening.resolved);
  } else if (const Path* folder = std::get_if<Path>(&*steady)) {
    opening.source = steady_load(*folder, opening.resolved);
  } else {
    const PySteady& run = std::get<1>(*steady);
    refuse_own_mesh(run);
    opening.source = steady_load(run.made.settings(), run.result, "steady run", opening.resolved);
  }
  return opening;
}

void add_inflate(py::module_& module) {
  add_class<CanopyOpening>(module, "CanopyOpening", "Opening of one canopy of a cluster.");
  add_class<ClusterOpening>(module, "ClusterOpening", "Openings of the canopies of a cluster.");
  add_class<Snapshot>(module, "InflationShot",
                      "Shape during the opening: time [s], positions [m], von_mises [N/m].");
  add_class<StageSummary>(module, "StageSummary", "Results of one stage of a reefed opening.");
  add_class<OpeningBody>(module, "OpeningBody", "Loads on a rigid body in a coupled inflation.");
  add_class<MethodLoad>(module, "MethodLoad", "Opening load by one method.");
  add_class<DeploymentPhase>(module, "DeploymentPhase", "Start of a phase of a deployment.");
  add_class<Deployment>(module, "Deployment", "Deployment before an opening, in one dimension.");
  add_class<OpeningProgress>(module, "OpeningProgress", "Progress of an opening.");
  py::class_<PyInflation> type(module, "Inflation",
                               "Result of an opening: the values of result.json, and arrays.");
  const auto result = [](const PyInflation& run) -> const InflationResult& { return run.result; };
  add_members(type, result);
  add_json(type, result);
  add_arrays(type);
  add_page(type, [](const PyInflation& run) {
    ReportRun shown = memory_report("opening", to_json(run.result), run.made.settings());
    shown.plots = opening_plots(shown, memory_table(run.history.rows), {}, memory_table(run.history.frames));
    shown.shape = memory_shape(run.mesh, run.shots);
    return shown;
  });
  type.def_property_readonly(
      "case", [](const PyInflation& run) { return run.made; }, "Case of the opening.");
  type.def_property_readonly(
      "warnings",
      [](const PyInflation& run) { return run.result.warnings.value_or(std::vector<std::string>{}); },
      "Exceeded quality limits, negative margins and other warnings.");
  module.def(
      "inflate", &inflate, py::arg("case"), py::kw_only(), py::arg("steady") = py::none(),
      py::arg("pressure_pa") = py::none(), py::arg("progress") = py::none(), py::arg("threads") = 0,
      py::arg("out") = py::none(), py::arg("fresh") = false,
      "Computes the opening of the folded canopy and its load on the riser: ripstop inflate.\n\nsteady: a "
      "Steady or its run folder, whose drag determines the pressure.\npressure_pa: pressure difference over "
      "the canopy [Pa]. If both are None, the case gives it.\nprogress: called with an OpeningProgress after "
      "every block of the history; an exception in it stops\n  the run.\nthreads: number of threads; 0: "
      "coupling.threads of the case.\nout: run folder, as in steady(). The values of a finished run are read "
      "from it, and the arrays are\n  empty. None: no files.\nfresh: replace the run in the folder.\n\n"
      "Loads in [N], times in [s].");
}

}  // namespace ripstop::python
