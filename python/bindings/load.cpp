// load(): opening and snatch loads behind a mass, with the way of the payload as a table.
#include "ripstop/run/opening/load.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "runs.h"

namespace ripstop::python {
namespace {

using Reefing = std::vector<std::pair<double, double>>;

LoadResult load(const PyCase& given, LoadRequest request, const std::optional<SteadySource>& steady,
                const Reefing& reefing, const std::optional<Path>& out) {
  const py::gil_scoped_release release;
  for (const auto& [share, duration] : reefing) request.reefing.push_back({share, duration});
  if (steady) {
    const FinishedSteady run = finished(*steady);
    if (!run.folder.empty())
      request.steady = run.folder;
    else if (!request.drag_coefficient)
      request.drag_coefficient = run.result.drag_area / nominal_area(given.given.parachute);
  }
  LoadResult result = run_load(given.settings(), request);
  if (out) write_load(*out, result);
  return result;
}

}  // namespace

void add_load(py::module_& module) {
  add_class<StageLoads>(module, "StageLoads", "The opening of one stage, by every method.");
  add_class<SnatchResult>(module, "Snatch", "The snatch load when the lines come taut.");
  py::class_<LoadResult> type =
      add_result<LoadResult>(module, "Load", "Opening loads behind a mass, method by method.");
  type.def_property_readonly(
      "flight", [](const py::object& self) { return table_of(self.cast<const LoadResult&>().flight, self); },
      "The payload's way from line stretch on, with the columns of trajectory.csv.");
  type.def_property_readonly(
      "record_flight",
      [](const py::object& self) { return table_of(self.cast<const LoadResult&>().record_flight, self); },
      "The same under the drag area of a computed opening; empty without one.");
  module.def(
      "load",
      [](PyCase given, double mass, double speed, std::optional<double> height, double ground, double angle,
         const Reefing& reefing, const std::optional<SteadySource>& steady,
         const std::optional<Path>& opening, std::optional<double> drag,
         std::optional<double> opening_coefficient, std::optional<double> filling_constant,
         std::optional<double> filling_exponent, std::optional<double> snatch_speed,
         std::optional<double> packed, std::optional<double> payload_drag_area,
         std::optional<double> measured_load, const std::optional<Path>& out) {
        LoadRequest r;
        r.payload_mass = mass, r.speed = speed, r.height = height, r.ground = ground, r.path_angle = angle;
        r.drag_coefficient = drag, r.opening_coefficient = opening_coefficient;
        r.filling_constant = filling_constant, r.filling_exponent = filling_exponent;
        r.snatch_speed = snatch_speed, r.packed_drag_area = packed, r.payload_drag_area = payload_drag_area;
        r.measured_load = measured_load;
        if (opening) r.opening = *opening;
        return load(given, r, steady, reefing, out);
      },
      py::arg("case"), py::arg("payload_mass_kg"), py::arg("speed_m_s"), py::kw_only(),
      py::arg("height_m") = py::none(), py::arg("ground_m") = 0.0, py::arg("path_angle_deg") = 90.0,
      py::arg("reefing") = Reefing(), py::arg("steady") = py::none(), py::arg("opening") = py::none(),
      py::arg("drag_coefficient") = py::none(), py::arg("opening_coefficient") = py::none(),
      py::arg("filling_constant") = py::none(), py::arg("filling_exponent") = py::none(),
      py::arg("snatch_speed_m_s") = py::none(), py::arg("packed_drag_area_m2") = py::none(),
      py::arg("payload_drag_area_m2") = py::none(), py::arg("measured_load_n") = py::none(),
      py::arg("out") = py::none(),
      "Opening and snatch loads behind a payload [kg], method by method: ripstop load.\n\n"
      "speed_m_s: through the air at line stretch; height_m: above sea level there (None: that of the case\n"
      "  where it is above the ground, else 1000 m above it); path_angle_deg: below the horizon.\n"
      "measured_load_n: an opening load that you have measured there; it becomes the design load.\n"
      "reefing: stages (share of the drag area, seconds), in order.\n"
      "steady: a Steady or the folder of one, for the drag coefficient; opening: the folder of an opening.\n"
      "What is None follows from the case and from what is known of its family. Loads in [N].\n"
      "out: a folder for the result's files. None: nothing is written.");
}

}  // namespace ripstop::python
