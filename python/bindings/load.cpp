// load(): opening and snatch loads for a payload mass, with the trajectory as a table.
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
  add_class<HardwareNeed>(module, "HardwareNeed", "Strength that each part of the hardware needs.");
  add_class<StageLoads>(module, "StageLoads", "Opening loads of one stage by all methods.");
  add_class<SnatchChange>(module, "SnatchChange", "Snatch load with one part changed.");
  add_class<SnatchResult>(module, "Snatch", "Snatch load at line stretch.");
  py::class_<LoadResult> type =
      add_result<LoadResult>(module, "Load", "Opening loads for a payload mass by several methods.");
  type.def_property_readonly(
      "flight", [](const py::object& self) { return table_of(self.cast<const LoadResult&>().flight, self); },
      "Trajectory of the payload after line stretch, with the columns of trajectory.csv.");
  type.def_property_readonly(
      "record_flight",
      [](const py::object& self) { return table_of(self.cast<const LoadResult&>().record_flight, self); },
      "Trajectory with the drag area of a computed opening; empty without one.");
  module.def(
      "load",
      [](PyCase given, double mass, std::optional<double> speed, std::optional<double> height,
         std::optional<double> ground, double angle, const Reefing& reefing,
         const std::optional<SteadySource>& steady, const std::optional<Path>& opening,
         std::optional<double> drag, std::optional<double> opening_coefficient,
         std::optional<double> filling_constant, std::optional<double> filling_exponent,
         std::optional<double> snatch_speed, std::optional<double> packed,
         std::optional<double> payload_drag_area, std::optional<double> measured_load,
         const std::optional<Path>& out) {
        LoadRequest r;
        r.payload_mass = mass, r.height = height, r.ground = ground, r.path_angle = angle;
        r.drag_coefficient = drag, r.opening_coefficient = opening_coefficient;
        r.filling_constant = filling_constant, r.filling_exponent = filling_exponent;
        r.snatch_speed = snatch_speed, r.packed_drag_area = packed, r.payload_drag_area = payload_drag_area;
        r.measured_load = measured_load;
        take_speed(given.settings(), speed, r);
        if (opening) r.opening = *opening;
        return load(given, r, steady, reefing, out);
      },
      py::arg("case"), py::arg("payload_mass_kg"), py::arg("speed_m_s") = py::none(), py::kw_only(),
      py::arg("height_m") = py::none(), py::arg("ground_m") = py::none(), py::arg("path_angle_deg") = 90.0,
      py::arg("reefing") = Reefing(), py::arg("steady") = py::none(), py::arg("opening") = py::none(),
      py::arg("drag_coefficient") = py::none(), py::arg("opening_coefficient") = py::none(),
      py::arg("filling_constant") = py::none(), py::arg("filling_exponent") = py::none(),
      py::arg("snatch_speed_m_s") = py::none(), py::arg("packed_drag_area_m2") = py::none(),
      py::arg("payload_drag_area_m2") = py::none(), py::arg("measured_load_n") = py::none(),
      py::arg("out") = py::none(),
      "Estimates opening and snatch loads for a payload [kg] by several methods: ripstop load.\n\n"
      "speed_m_s: airspeed at line stretch (None: payload.deployment_speed_m_s of the case).\n"
      "height_m: height above sea level at line stretch, with the standard atmosphere there (None: air of "
      "the case).\n"
      "ground_m: height of the ground, where the flight ends (None: 0 with height_m, else none).\n"
      "path_angle_deg: angle of the flight path below the horizon.\n"
      "measured_load_n: measured opening load at this state, which becomes the design load.\n"
      "reefing: stages (share of the drag area, seconds), in order.\n"
      "steady: a Steady or its run folder, for the drag coefficient.\n"
      "opening: run folder of an opening.\n"
      "out: folder for the files of the result. None: no files.\n\n"
      "Values that are None are taken from the case or from data of the canopy family. Loads are in [N].");
}

}  // namespace ripstop::python
