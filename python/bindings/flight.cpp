// descent() and export(): uses of the drag of a steady run.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/run/descent/descent.h"
#include "ripstop/run/descent/export.h"
#include "runs.h"

namespace ripstop::python {

void add_flight(py::module_& module) {
  add_class<DescentRow>(module, "DescentRow", "Rate of descent at one height, and time to the ground.");
  add_result<Descent>(module, "Descent", "Descent of a payload under the parachute of a steady run.");
  module.def(
      "descent",
      [](const SteadySource& run, double mass, const std::vector<double>& heights, double ground) {
        const py::gil_scoped_release release;
        if (const Path* folder = std::get_if<Path>(&run))
          return run_descent(carrying_run(*folder), mass, heights, ground);
        return run_descent(finished(run), mass, heights, ground);
      },
      py::arg("run"), py::arg("payload_mass_kg"), py::kw_only(),
      py::arg("heights_m") = std::vector<double>{0, 300, 1000, 3000}, py::arg("ground_m") = 0.0,
      "Computes rate of descent [m/s] and time to the ground [s] of a payload: ripstop descent.\n\nrun: a "
      "Steady or its run folder, or the run folder of a flight, whose coefficient in descent is used.\n"
      "payload_mass_kg: mass of the payload, without the parachute.\nheights_m: heights above sea level, "
      "one row each.\nground_m: height of the ground above sea level.");
  add_result<ExportedParachute>(module, "ExportedParachute",
                                "Parachute of a steady run in the terms of flight simulators.")
      .def("rocketpy", py::overload_cast<const ExportedParachute&, const std::string&>(&rocketpy_text),
           py::arg("trigger") = "apogee",
           "Returns Python code with the arguments of Rocket.add_parachute of RocketPy. trigger: \"apogee\", "
           "or a height above\nground [m].")
      .def("openrocket", py::overload_cast<const ExportedParachute&>(&openrocket_text),
           "Returns a component database of OpenRocket with the parachute.");
  module.def(
      "export",
      [](const SteadySource& run, std::optional<double> deployment_speed, const std::optional<Path>& flight) {
        const py::gil_scoped_release release;
        return exported(finished(run), deployment_speed,
                        flight ? std::optional(finished_flight(*flight)) : std::nullopt);
      },
      py::arg("run"), py::kw_only(), py::arg("deployment_speed_m_s") = py::none(),
      py::arg("flight") = py::none(),
      "Exports the parachute of a steady run to flight simulators: ripstop export.\n\nrun: a Steady or its "
      "run folder.\ndeployment_speed_m_s: speed for the filling time. None: speed of the run, or with a "
      "payload three times the\n  "
      "rate of descent, but at least 20 m/s.\nflight: run folder of a flight of this parachute, whose "
      "coefficient in descent replaces the axial\n  "
      "one.");
}

}  // namespace ripstop::python
