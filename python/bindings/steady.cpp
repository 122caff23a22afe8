// steady(): a run with its state, its air and its stresses as arrays.
#include "ripstop/run/steady/steady.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
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

/// Tells Python of every iteration, and keeps what a folder's run does not return.
class SteadyListener : public SteadyObserver {
 public:
  SteadyListener(Listener& listener, PySteady& run, const std::optional<WarmStart>& start)
      : listener_(listener), run_(run), start_(start) {}
  void begin(const SteadyRun& run, SteadyState& state) override {
    run_.engine = run.engine;
    if (start_) start_from(start_->settings, start_->end, run, state);
  }
  void progress(const SteadyProgress&, const SteadyState&) override { listener_.listen(); }
  void iterated(const SteadyRun&, const SteadyState& state, const FlowField& flow) override {
    if (!run_.folder.empty()) run_.flow = flow;
    listener_.tell(state.iterations.back());
  }
  void ended(const SteadyRun& run, const SteadyState& state, const SteadyResult&) override {
    run_.stress = cell_stress(run.solver.cloth(), run.solver.cloth_state(state));
    if (!run_.folder.empty()) run_.state = state;
  }

 private:
  Listener& listener_;
  PySteady& run_;
  const std::optional<WarmStart>& start_;
};

void compute(PySteady& run, SteadyListener& observer, int threads, bool fresh, const Path& warm_from) {
  const Settings resolved = run.made.settings();
  if (run.folder.empty()) {
    SteadySolution solution = run_steady(resolved, observer, {threads, {}, {}});
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
  run.cells = cells_of(parachute_mesh(resolved));
}

std::unique_ptr<PySteady> steady(const PyCase& given, Callback<SteadyIteration> progress, int threads,
                                 const std::optional<Path>& out, bool fresh,
                                 const std::optional<SteadySource>& start) {
  auto run = std::make_unique<PySteady>();
  run->made = given;
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
  Listener listener(std::move(progress));
  SteadyListener observer(listener, *run, warm);
  const py::gil_scoped_release release;
  compute(*run, observer, threads, fresh, out ? warm_from : Path());
  return run;
}

const PySteady& run_of(const py::object& self) {
  return self.cast<const PySteady&>();
}

/// Values of the flow's cells, (z, y, x) as they lie in memory.
py::array of_flow(const double* data, const FlowGrid& grid, bool vectors, py::handle owner) {
  std::vector<py::ssize_t> shape = {grid.nz, grid.ny, grid.nx};
  if (vectors) shape.push_back(3);
  return view_of(data, shape, owner);
}

void add_flow(py::module_& module) {
  py::class_<FlowField> type(module, "Flow", "The air in the flow's box; arrays of cells are [z, y, x].");
  const auto self_of = [](const py::object& self) -> const FlowField& {
    return self.cast<const FlowField&>();
  };
  type.def_property_readonly(
      "pressure",
      [self_of](const py::object& self) {
        const FlowField& f = self_of(self);
        return of_flow(f.pressure.data(), f.grid, false, self);
      },
      "Over the outlet's, of every cell [Pa]");
  type.def_property_readonly(
      "velocity",
      [self_of](const py::object& self) {
        const FlowField& f = self_of(self);
        return of_flow(&f.velocity.front().x, f.grid, true, self);
      },
      "x, y and z of every cell; z is downstream [m/s]");
  type.def_property_readonly(
      "edges",
      [](const FlowField& f) {
        py::list axes;
        for (int axis = 0; axis < 3; ++axis) axes.append(py::array(py::cast(f.grid.edges(axis))));
        return axes;
      },
      "Sides of the cells along x, y and z, one more than cells [m]");
  type.def_property_readonly(
      "converged", [](const FlowField& f) { return f.converged; }, "Whether the flow met its residual.");
}

void add_arrays(py::class_<PySteady>& type) {
  type.def_property_readonly(
      "shape", [](const py::object& self) { return view_of(run_of(self).state.shape, self); },
      "Every node of the parachute at the end, x, y, z; z is downstream [m]");
  type.def_property_readonly(
      "cells", [](const py::object& self) { return view_of_cells(run_of(self).cells, self); },
      "Nodes at the four corners of every cell of cloth; the first is -1 where there is none.");
  type.def_property_readonly(
      "pressure_difference", [](const py::object& self) { return view_of(run_of(self).state.applied, self); },
      "Over every cell of cloth, that made the shape [Pa]");
  type.def_property_readonly(
      "stress", [](const py::object& self) { return table_of(run_of(self).stress, self); },
      "Of every cell of cloth: columns in [N/m], max_strain without unit; empty where the run was\n"
      "finished already.");
  type.def_property_readonly(
      "iterations", [](const py::object& self) { return table_of(run_of(self).state.iterations, self); },
      "A row for each coupling iteration, with the columns of iterations.csv.");
  type.def_property_readonly(
      "flow", [](const PySteady& run) { return run.flow.velocity.empty() ? nullptr : &run.flow; },
      py::return_value_policy::reference_internal,
      "The air round the final shape, a Flow; None where the run was finished already.");
}

}  // namespace

FinishedSteady finished(const SteadySource& source) {
  if (const Path* folder = std::get_if<Path>(&source)) return finished_steady(*folder);
  const PySteady& run = std::get<1>(source);
  FinishedSteady done = finished_steady(run.made.settings(), run.result);
  done.folder = run.folder;
  return done;
}

void add_steady(py::module_& module) {
  add_class<Ledger>(module, "Ledger", "Axial forces that have to agree [N].");
  add_class<Measured>(module, "Measured", "A wind-tunnel condition of the case.");
  add_class<WindowAverage>(module, "Watched", "What a watch of the flow in time came to.");
  add_class<UnsteadyResult>(module, "UnsteadyResult", "What the mean over a wake that sheds is worth.");
  add_class<HeldPayload>(module, "HeldPayload", "What a run holds that sought its speed.");
  add_class<Margin>(module, "Margin",
                    "How far one part is from breaking; `unit` is that of load and strength.");
  add_class<Margins>(module, "Margins", "How far every part is from breaking.");
  add_class<SteadyIteration>(module, "SteadyIteration", "What one coupling iteration says of itself.");
  add_flow(module);
  py::class_<PySteady> type(module, "Steady",
                            "A steady run: the numbers of its result.json, and its arrays.");
  const auto result = [](const PySteady& run) -> const SteadyResult& { return run.result; };
  add_members(type, result);
  add_json(type, result);
  add_arrays(type);
  type.def_property_readonly(
      "case", [](const PySteady& run) { return run.made; }, "The Case that was run.");
  type.def_property_readonly(
      "engine", [](const PySteady& run) { return run.engine; },
      "The flow engine and its version; empty where the run was finished already.");
  type.def_property_readonly(
      "warnings",
      [](const PySteady& run) { return run.result.warnings.value_or(std::vector<std::string>{}); },
      "Limits that the result does not keep, margins below 0, and other doubts.");
  module.def(
      "steady", &steady, py::arg("case"), py::kw_only(), py::arg("progress") = py::none(),
      py::arg("threads") = 0, py::arg("out") = py::none(), py::arg("fresh") = false,
      py::arg("start") = py::none(),
      "Inflated shape, drag and loads in a steady flow: ripstop steady.\n\n"
      "progress: called with a SteadyIteration after every coupling iteration; what it raises ends the\n"
      "  run.\n"
      "threads: 0: coupling.threads of the case.\n"
      "out: a run folder; a finished run of this case is read from it, one that was stopped goes on.\n"
      "  None: nothing is written.\n"
      "fresh: compute again what the folder holds.\n"
      "start: a finished run or its folder, whose shape and pressure this one starts from; another mesh\n"
      "  starts cold. None: cold.\n\n"
      "A result that has not converged is returned: look at `converged`. Forces in [N], lengths in [m],\n"
      "speeds in [m/s].");
}

}  // namespace ripstop::python
