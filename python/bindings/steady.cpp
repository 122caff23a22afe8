// steady(): a run with its state, its air and its stresses as arrays.
#include "ripstop/run/steady/steady.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "notebook.h"
#include "ripstop/case/assemble.h"
#include "ripstop/run/steady/steady_folder.h"
#include "runs.h"

namespace ripstop::python {
namespace {

/// The end of another run, to start from.
struct WarmStart {
  Settings settings;
  SteadyState end;
};

/// Reports every iteration to Python, and keeps the values that the run of a folder does not return.
class SteadyListener : public SteadyObserver {
 public:
  SteadyListener(Listener& listener, Listener& estimate, PySteady& run, const std::optional<WarmStart>& start)
      : listener_(listener), estimate_(estimate), run_(run), start_(start) {}
  void begin(const SteadyRun& run, SteadyState& state) override {
    run_.engine = run.engine;
    estimated_ = state.first_estimate.has_value();
    if (start_) start_from(start_->settings, start_->end, run, state);
  }
  void progress(const SteadyProgress& progress, const SteadyState& state) override {
    listener_.listen();
    if (!state.first_estimate || estimated_ || progress.coarse) return;
    estimated_ = true;
    estimate_.tell(*state.first_estimate);
  }
  void iterated(const SteadyRun&, const SteadyState& state, const FlowField& flow) override {
    if (!run_.folder.empty()) run_.flow = flow;
    listener_.tell(state.iterations.back());
  }
  void ended(const SteadyRun& run, const SteadyState& state, const SteadyResult&) override {
    run_.stress = cell_stress(run.solver.cloth(), run.solver.cloth_state(state));
    if (!run_.folder.empty()) run_.state = state;
  }

 private:
  Listener &listener_, &estimate_;
  PySteady& run_;
  const std::optional<WarmStart>& start_;
  bool estimated_ = false;  // reported
};

void compute(PySteady& run, SteadyListener& observer, int threads, bool fresh, const Path& warm_from) {
  const Settings resolved = run.made.settings();
  if (run.folder.empty()) {
    SteadySolution solution = run_steady(resolved, observer, {threads, {}, {}, run.own_mesh});
    run.result = std::move(solution.result);
    run.state = std::move(solution.state);
    run.flow = std::move(solution.flow);
  } else {
    const SteadyFolderRun done =
        run_steady_in({{run.folder, fresh}, threads, {}, warm_from}, resolved, observer);
    run.result = done.result;
    if (done.already_finished) run.state = final_state(run.folder);
    run.result.last = run.state.iterations.back();
  }
  run.cells = cells_of(steady_mesh(resolved, run.own_mesh.get()));
}

std::unique_ptr<PySteady> steady(const PyCase& given, Callback<SteadyIteration> progress, int threads,
                                 const std::optional<Path>& out, bool fresh,
                                 const std::optional<SteadySource>& start, const OptionalMesh& mesh,
                                 Callback<FirstEstimate> estimate) {
  auto run = std::make_unique<PySteady>();
  run->made = given;
  run->own_mesh = own_mesh(mesh, out.has_value());
  if (out) run->folder = *out;
  Path warm_from;
  std::optional<WarmStart> warm;
  if (start) {
    const Path* folder = std::get_if<Path>(&*start);
    const PySteady* other = folder ? nullptr : &std::get<1>(*start).get();
    warm_from = folder ? *folder : other->folder;
    if (out && warm_from.empty())
      throw py::value_error("a run in a folder starts from a run in a folder: give that one an `out` too");
    if (!out && other)
      warm = WarmStart{other->made.settings(), other->state};
    else if (!out)
      warm = WarmStart{finished_steady(*folder).resolved, final_state(*folder)};
  }
  Listener listener(std::move(progress)), estimate_listener(std::move(estimate));
  SteadyListener observer(listener, estimate_listener, *run, warm);
  const py::gil_scoped_release release;
  compute(*run, observer, threads, fresh, out ? warm_from : Path());
  return run;
}

const PySteady& run_of_steady(const py::object& self) {
  return self.cast<const PySteady&>();
}

/// Values of the flow's cells, (z, y, x) as they lie in memory.
py::array of_flow(const double* data, const FlowGrid& grid, bool vectors, py::handle owner) {
  std::vector<py::ssize_t> shape = {grid.nz, grid.ny, grid.nx};
  if (vectors) shape.push_back(3);
  return view_of(data, shape, owner);
}

void add_flow(py::module_& module) {
  py::class_<FlowField> type(module, "Flow", "Flow in the domain; arrays of cells are [z, y, x].");
  const auto self_of = [](const py::object& self) -> const FlowField& {
    return self.cast<const FlowField&>();
  };
  type.def_property_readonly(
      "pressure",
      [self_of](const py::object& self) {
        const FlowField& f = self_of(self);
        return of_flow(f.pressure.data(), f.grid, false, self);
      },
      "Pressure of every cell relative to the outlet [Pa]");
  type.def_property_readonly(
      "velocity",
      [self_of](const py::object& self) {
        const FlowField& f = self_of(self);
        return of_flow(&f.velocity.front().x, f.grid, true, self);
      },
      "Velocity of every cell: x, y and z; z is downstream [m/s]");
  type.def_property_readonly(
      "edges",
      [](const FlowField& f) {
        py::list axes;
        for (int axis = 0; axis < 3; ++axis) axes.append(py::array(py::cast(f.grid.edges(axis))));
        return axes;
      },
      "Edges of the cells along x, y and z, one more than cells [m]");
  type.def_property_readonly(
      "converged", [](const FlowField& f) { return f.converged; }, "Whether the flow converged.");
}

void add_arrays(py::class_<PySteady>& type) {
  type.def_property_readonly(
      "shape", [](const py::object& self) { return view_of(run_of_steady(self).state.shape, self); },
      "Position of every node of the parachute at the end: x, y, z; z is downstream [m]");
  type.def_property_readonly(
      "cells", [](const py::object& self) { return view_of_cells(run_of_steady(self).cells, self); },
      "Nodes at the four corners of every cloth cell; the first is -1 for a missing cell.");
  type.def_property_readonly(
      "pressure_difference",
      [](const py::object& self) { return view_of(run_of_steady(self).state.applied, self); },
      "Pressure difference over every cloth cell that caused the shape [Pa]");
  type.def_property_readonly(
      "stress", [](const py::object& self) { return table_of(run_of_steady(self).stress, self); },
      "Stress of every cloth cell: columns in [N/m], max_strain without unit; empty if the run was "
      "already\nfinished.");
  type.def_property_readonly(
      "iterations",
      [](const py::object& self) { return table_of(run_of_steady(self).state.iterations, self); },
      "One row for each coupling iteration, with the columns of iterations.csv.");
  type.def_property_readonly(
      "flow", [](const PySteady& run) { return run.flow.velocity.empty() ? nullptr : &run.flow; },
      py::return_value_policy::reference_internal,
      "Flow around the final shape; None if the run was already finished.");
}

}  // namespace

FinishedSteady finished(const SteadySource& source) {
  if (const Path* folder = std::get_if<Path>(&source)) return finished_steady(*folder);
  const PySteady& run = std::get<1>(source);
  refuse_own_mesh(run);
  FinishedSteady done = finished_steady(run.made.settings(), run.result);
  done.folder = run.folder;
  return done;
}

void add_steady(py::module_& module) {
  add_class<Ledger>(module, "Ledger", "Axial forces, equal in equilibrium [N].");
  add_class<Measured>(module, "Measured", "Wind-tunnel condition of the case.");
  add_class<WindowAverage>(module, "Watched", "State of the averaging window of an unsteady run.");
  add_class<UnsteadyResult>(module, "UnsteadyResult", "Averages of an unsteady wake and their uncertainty.");
  add_class<HeldPayload>(module, "HeldPayload", "Equilibrium of drag and weight in a run with a payload.");
  add_class<BodyResult>(module, "BodyResult", "Loads on a rigid body of the case.");
  add_class<SolvedDomain>(module, "SolvedDomain",
                          "The part of the flow domain in which the flow was solved.");
  add_class<Margin>(module, "Margin",
                    "Margin of safety of one part; `unit` is the unit of load and strength.");
  add_class<Margins>(module, "Margins", "Margins of safety of all parts.");
  add_class<ClusterCanopy>(module, "ClusterCanopy", "Loads on one canopy of a cluster.");
  add_class<SpreadTrial>(module, "SpreadTrial",
                         "One solution of the search for the spread angle of a cluster.");
  add_class<ClusterResult>(module, "ClusterResult", "Angles and loads of a cluster of canopies.");
  add_class<SteadyIteration>(module, "SteadyIteration", "Values of one coupling iteration.");
  add_class<FirstEstimate>(
      module, "FirstEstimate",
      "Drag and shape early in the first coupling iteration, whose flow has not settled.");
  add_flow(module);
  py::class_<PySteady> type(module, "Steady",
                            "Result of a steady run: the values of result.json, and arrays.");
  const auto result = [](const PySteady& run) -> const SteadyResult& { return run.result; };
  add_members(type, result);
  add_json(type, result);
  add_arrays(type);
  add_page(type, [](const PySteady& run) {
    const Settings resolved = run.made.settings();
    ReportRun shown = memory_report("steady", to_json(run.result), resolved);
    shown.plots = iteration_plots(memory_table(run.state.iterations));
    shown.shape = memory_shape(steady_mesh(resolved, run.own_mesh.get()), run.state.shape, run.stress);
    return shown;
  });
  type.def_property_readonly(
      "case", [](const PySteady& run) { return run.made; }, "Case of the run.");
  type.def_property_readonly(
      "engine", [](const PySteady& run) { return run.engine; },
      "Flow engine and version; empty if the run was already finished.");
  type.def_property_readonly(
      "warnings",
      [](const PySteady& run) { return run.result.warnings.value_or(std::vector<std::string>{}); },
      "Exceeded quality limits, negative margins and other warnings.");
  module.def("steady", &steady, py::arg("case"), py::kw_only(), py::arg("progress") = py::none(),
             py::arg("threads") = 0, py::arg("out") = py::none(), py::arg("fresh") = false,
             py::arg("start") = py::none(), py::arg("mesh") = py::none(), py::arg("estimate") = py::none(),
             "Computes inflated shape, drag and loads in a steady flow: ripstop steady.\n\n"
             "progress: called with a SteadyIteration after every coupling iteration; an exception in it "
             "stops the\n"
             "  run.\n"
             "threads: number of threads; 0: coupling.threads of the case.\n"
             "out: run folder. A finished run of this case is read from it, an interrupted run resumes. "
             "None: no\n"
             "  files.\n"
             "fresh: replace the run in the folder.\n"
             "start: finished run or its folder whose shape and pressure are the initial state; ignored "
             "for\n"
             "  another mesh. None: undeformed canopy.\n"
             "mesh: a Mesh in place of the canopy of the case; coefficients refer to the area of its "
             "cloth. Without\n"
             "  `out`.\n"
             "estimate: called once with a FirstEstimate early in the first coupling iteration; not for "
             "clusters and\n"
             "  bodies.\n\n"
             "A result that is not converged is also returned: check `converged`. Forces are in [N], "
             "lengths in [m],\n"
             "speeds in [m/s].");
}

}  // namespace ripstop::python
