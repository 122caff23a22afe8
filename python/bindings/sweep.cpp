// sweep(): a case over the values of its keys.
#include "ripstop/run/sweep/sweep.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/run/sweep/sweep_files.h"

namespace ripstop::python {
namespace {

struct PySweepRun {
  std::vector<std::string> names, values;  // of the axes
  SweepRow row;
};

std::vector<SweepAxis> axes_of(const py::dict& keys) {
  std::vector<SweepAxis> axes;
  for (const auto& [key, values] : keys) {
    SweepAxis axis{py::str(key), {}, {}};
    for (const py::handle value : values) {
      const Setting setting = setting_of(axis.name, value);
      axis.values.push_back(setting.value);
      axis.settings.push_back({setting});
    }
    if (axis.values.empty()) throw py::value_error(axis.name + " has no values to sweep over");
    axes.push_back(std::move(axis));
  }
  if (axes.empty())
    throw py::value_error("a sweep needs a key and its values, as {\"flow.speed_m_s\": [10, 20]}");
  return axes;
}

std::vector<PySweepRun> sweep(const PyCase& given, const py::dict& keys, const std::optional<Path>& out,
                              int jobs, bool warm, bool fresh) {
  const std::vector<SweepAxis> axes = axes_of(keys);
  Listener listener(py::none{});
  const py::gil_scoped_release release;
  Overrides own;
  own.set = given.set;
  const std::vector<SweepPoint> points = sweep_points(
      [&](const Overrides& all) {
        Case made = parse_case(given.text, given.name, all);
        made.file = given.file;
        return made;
      },
      own, axes);
  const SweepSettings settings{out.value_or(Path()), fresh, warm, false, jobs, false};
  if (out) check_sweep(points, settings);
  const std::vector<SweepRow> rows =
      run_sweep(points, settings,
                {[&](std::size_t, const SteadyProgress&, const SteadyState&) { listener.listen(); }, {}});
  if (out) finish_sweep(*out, axes, points, rows);
  std::vector<PySweepRun> runs;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    PySweepRun run;
    for (const SweepAxis& axis : axes) run.names.push_back(axis.name);
    run.values = points[i].values, run.row = rows[i];
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

void add_sweep(py::module_& module) {
  py::class_<PySweepRun> type(module, "SweepRun", "One run of a sweep: the values of its result.json.");
  const auto result = [](const PySweepRun& run) -> const SteadyResult& { return run.row.result; };
  add_members(type, result);
  add_json(type, result);
  type.def_property_readonly(
      "values",
      [](const PySweepRun& run) {
        py::dict values;
        for (std::size_t i = 0; i < run.names.size(); ++i) values[py::str(run.names[i])] = run.values[i];
        return values;
      },
      "Values of the varied keys, as text.");
  type.def_property_readonly(
      "done", [](const PySweepRun& run) { return run.row.done; }, "Whether there is a result.");
  type.def_property_readonly(
      "error", [](const PySweepRun& run) { return run.row.error; }, "Reason why there is no result.");
  module.def("sweep", &sweep, py::arg("case"), py::arg("keys"), py::kw_only(), py::arg("out") = py::none(),
             py::arg("jobs") = 0, py::arg("warm") = true, py::arg("fresh") = false,
             "Computes steady runs of a case for every combination of values: ripstop sweep.\n\n"
             "keys: lists of values by key, as {\"flow.speed_m_s\": [10, 20]}.\n"
             "out: folder with one run folder for each combination; finished runs are read from it. None: no "
             "files.\n"
             "jobs: number of simultaneous runs; 0: as many as cores and free memory allow.\n"
             "warm: whether each run starts from a neighbouring run; False: from the undeformed "
             "canopy.\nfresh: replace the runs in the folder.\n\n"
             "A failed run has `done` False and an `error`; the others continue.");
}

}  // namespace ripstop::python
