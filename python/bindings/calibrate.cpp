// calibrate_damping(): C_a from a measured opening.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "opening.h"
#include "ripstop/core/claimed_folder.h"
#include "ripstop/run/opening/damping.h"

namespace ripstop::python {
namespace {

DampingResult calibrate(const PyCase& given, const OptionalSource& steady, std::optional<double> pressure,
                        const DampingSearch& search, Callback<DampingTrial> progress, int threads,
                        const std::optional<Path>& out) {
  Listener listener(std::move(progress));
  const py::gil_scoped_release release;
  const Opening opening = opening_of(given.given, steady, pressure, threads);
  damping_target(opening.resolved);
  if (out) make_results_folder(*out, "calibrate");
  const auto alive = [&] { listener.listen(); };
  DampingResult result = run_damping(
      opening.resolved, opening.source,
      opening_problem(opening.resolved, opening.source, opening.threads, alive), search,
      [&](const DampingTrial& trial) { listener.tell(trial); }, alive);
  if (out) write_damping(*out, result);
  return result;
}

}  // namespace

void add_calibrate(py::module_& module) {
  add_class<DampingTrial>(module, "DampingTrial", "One opening of the calibration with one C_a.");
  add_result<DampingResult>(module, "Damping",
                            "Damping C_a calibrated with a measured opening: the values of result.json.");
  module.def(
      "calibrate_damping",
      [](PyCase given, const OptionalSource& steady, std::optional<double> pressure, double from, double to,
         int points, int refinements, Callback<DampingTrial> progress, int threads,
         const std::optional<Path>& out) {
        return calibrate(given, steady, pressure, {from, to, points, refinements}, std::move(progress),
                         threads, out);
      },
      py::arg("case"), py::kw_only(), py::arg("steady") = py::none(), py::arg("pressure_pa") = py::none(),
      py::arg("smallest") = 4.0, py::arg("largest") = 16.0, py::arg("points") = 7, py::arg("refinements") = 4,
      py::arg("progress") = py::none(), py::arg("threads") = 0, py::arg("out") = py::none(),
      "Determines the damping C_a [N s/m3] from the measured opening load of a reference parachute:\nripstop "
      "calibrate damping.\n\nsteady, pressure_pa, threads: as in inflate().\nsmallest, largest: range of C_a "
      "[N s/m3].\npoints: number of logarithmically spaced C_a.\nrefinements: number of further openings "
      "around the best C_a.\nprogress: called with a DampingTrial after every opening; an exception in it "
      "stops the search.\nout: folder for the files of the result. None: no files.");
}

}  // namespace ripstop::python
