// descent() and export(): uses of the drag of a steady run.
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <variant>

#include "members.h"
#include "module.h"
#include "ripstop/case/payload.h"
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
      "Computes the descent of a payload under the drag area of a run: ripstop descent.\n\n"
      "run: a Steady or its run folder, or the run folder of a flight, whose coefficient in descent is\n"
      "  used.\n"
      "payload_mass_kg: mass of the payload without the parachute, above 0.\n"
      "heights_m: list of heights above sea level [m], in the range of the standard atmosphere.\n"
      "ground_m: height of the ground above sea level [m].\n\n"
      "Returns a Descent. Its list heights has one DescentRow for each of heights_m, with density\n"
      "[kg/m3], speed [m/s] and time to the ground [s]. Raises Error for a mass or a height outside its\n"
      "range, and for a folder without a finished run.");
  add_result<ExportedParachute>(module, "ExportedParachute",
                                "Parachute of a steady run in the terms of flight simulators.")
      .def("rocketpy", py::overload_cast<const ExportedParachute&, const std::string&>(&rocketpy_text),
           py::arg("trigger") = "apogee",
           "Returns Python code (str) with the arguments of Rocket.add_parachute of RocketPy.\n\n"
           "trigger: \"apogee\", or a height above the ground in metres, as text (\"300\").\n\n"
           "Raises Error for another trigger.")
      .def("openrocket", py::overload_cast<const ExportedParachute&>(&openrocket_text),
           "Returns a component database of OpenRocket (str, XML) with the parachute.");
  module.def(
      "export",
      [](const SteadySource& run, std::optional<double> deployment_speed, const std::optional<Path>& flight) {
        const py::gil_scoped_release release;
        return exported(finished(run), deployment_speed,
                        flight ? std::optional(finished_flight(*flight)) : std::nullopt);
      },
      py::arg("run"), py::kw_only(), py::arg("deployment_speed_m_s") = py::none(),
      py::arg("flight") = py::none(),
      fmt::format(
          "Exports the parachute of a steady run to flight simulators: ripstop export.\n\n"
          "run: a Steady or its run folder.\n"
          "deployment_speed_m_s: airspeed for the filling time [m/s], above 0. None: that of the case\n"
          "  (payload.deployment_speed_m_s). Without it the speed of the run, or {:g} times its computed\n"
          "  rate of descent, but at least {:g} m/s.\n"
          "flight: run folder of a flight of this parachute, whose coefficient in descent replaces the\n"
          "  axial one.\n\n"
          "Returns an ExportedParachute: areas in [m2], lengths in [m], masses in [kg], times in [s].\n"
          "Raises Error for a speed that is not above 0, for a folder without a finished run, and for the\n"
          "flight of another parachute.",
          deployment_over_descent, least_deployment_speed)
          .c_str());
}

}  // namespace ripstop::python
