// recovery() and fastest_deployment(): the questions of a recovery review.
#include "ripstop/run/descent/recovery.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "members.h"
#include "module.h"
#include "ripstop/run/opening/fastest.h"
#include "runs.h"

namespace ripstop::python {
namespace {

void add_fastest(py::module_& module) {
  add_result<FastestResult>(module, "FastestDeployment",
                            "Fastest safe deployment by every method of load().");
  module.def(
      "fastest_deployment",
      [](const PyCase& given, double mass, double margin, std::optional<double> height, double angle,
         const std::vector<std::pair<double, double>>& reefing, const std::optional<Path>& steady,
         const std::optional<Path>& opening, std::optional<double> drag,
         std::optional<double> filling_constant, std::optional<double> snatch_speed,
         std::optional<double> packed, const std::optional<Path>& out) {
        const py::gil_scoped_release release;
        LoadRequest r;
        r.payload_mass = mass, r.height = height, r.path_angle = angle;
        r.drag_coefficient = drag, r.filling_constant = filling_constant;
        r.snatch_speed = snatch_speed, r.packed_drag_area = packed;
        for (const auto& [share, duration] : reefing) r.reefing.push_back({share, duration});
        if (steady) r.steady = *steady;
        if (opening) r.opening = *opening;
        FastestResult result = run_fastest(given.settings(), r, margin);
        if (out) write_fastest(*out, result);
        return result;
      },
      py::arg("case"), py::arg("payload_mass_kg"), py::kw_only(), py::arg("margin") = 0.0,
      py::arg("height_m") = py::none(), py::arg("path_angle_deg") = 90.0,
      py::arg("reefing") = std::vector<std::pair<double, double>>(), py::arg("steady") = py::none(),
      py::arg("opening") = py::none(), py::arg("drag_coefficient") = py::none(),
      py::arg("filling_constant") = py::none(), py::arg("snatch_speed_m_s") = py::none(),
      py::arg("packed_drag_area_m2") = py::none(), py::arg("out") = py::none(),
      "Finds the largest airspeed [m/s] at line stretch at which every member keeps its margin of safety:\n"
      "ripstop load --fastest.\n\n"
      "margin: margin of safety that every member keeps.\n"
      "steady, opening: run folders that provide the drag area.\n\n"
      "Other arguments are those of load(). The attribute advice of the result names the speed to use.");
}

}  // namespace

void add_recovery(py::module_& module) {
  add_class<Ranged>(module, "Ranged", "A value with its range.");
  add_class<SafeSpeed>(module, "SafeSpeed", "Fastest safe deployment by one method.");
  add_class<RecoveryStage>(
      module, "RecoveryStage",
      "Part of a recovery from the opening of a parachute to the opening of the next one, or to the ground.");
  add_class<SectionEnergy>(module, "SectionEnergy", "Kinetic energy of one section at landing.");
  py::class_<RecoveryResult> type =
      add_result<RecoveryResult>(module, "Recovery", "Recovery of a rocket from apogee to the ground.");
  type.def_property_readonly(
      "trajectory",
      [](const py::object& self) { return table_of(self.cast<const RecoveryResult&>().rows, self); },
      "Trajectory since apogee, with the columns of trajectory.csv.");
  add_fastest(module);
  module.def(
      "recovery",
      [](const PyCase& main, const std::optional<PyCase>& drogue, double mass, double apogee,
         double main_height, double speed, double delay, double ground, std::optional<double> body_drag_area,
         bool drogue_released, const std::optional<Path>& steady, const std::optional<Path>& drogue_steady,
         const std::optional<Path>& opening, const std::optional<Path>& drogue_opening,
         std::optional<double> measured_load, std::optional<double> drogue_measured_load,
         const std::vector<double>& sections, std::optional<double> separation_speed,
         std::optional<double> bay_diameter, const std::optional<Path>& out) {
        const py::gil_scoped_release release;
        RecoveryRequest r;
        r.mass = mass, r.apogee = apogee, r.main_height = main_height, r.speed = speed, r.delay = delay;
        r.ground = ground, r.body_drag_area = body_drag_area, r.drogue_released = drogue_released;
        r.sections = sections, r.separation_speed = separation_speed, r.bay_diameter = bay_diameter;
        if (steady) r.main_steady = *steady;
        if (drogue_steady) r.drogue_steady = *drogue_steady;
        if (opening) r.main_opening = *opening;
        if (drogue_opening) r.drogue_opening = *drogue_opening;
        r.main_measured_load = measured_load, r.drogue_measured_load = drogue_measured_load;
        RecoveryResult result =
            run_recovery(main.settings(), drogue ? std::optional(drogue->settings()) : std::nullopt, r);
        if (out) write_recovery(*out, result);
        return result;
      },
      py::arg("main"), py::arg("drogue"), py::arg("mass_kg"), py::arg("apogee_m"), py::kw_only(),
      py::arg("main_height_m") = 300.0, py::arg("speed_m_s") = 20.0, py::arg("delay_s") = 0.0,
      py::arg("ground_m") = 0.0, py::arg("body_drag_area_m2") = py::none(),
      py::arg("drogue_released") = false, py::arg("steady") = py::none(),
      py::arg("drogue_steady") = py::none(), py::arg("opening") = py::none(),
      py::arg("drogue_opening") = py::none(), py::arg("measured_load_n") = py::none(),
      py::arg("drogue_measured_load_n") = py::none(), py::arg("sections_kg") = std::vector<double>(),
      py::arg("separation_speed_m_s") = py::none(), py::arg("bay_diameter_m") = py::none(),
      py::arg("out") = py::none(),
      "Computes the recovery of a rocket under drogue and main, from apogee to the ground: ripstop "
      "recovery.\n\n"
      "main, drogue: cases. Without a drogue (None) the main opens at apogee.\n"
      "mass_kg: mass that descends, without the parachutes.\napogee_m, main_height_m: heights above the "
      "ground of apogee and of the opening of the main.\n"
      "speed_m_s: horizontal airspeed at apogee.\ndelay_s: time from apogee to the first opening.\n"
      "ground_m: height of the ground above sea level.\n"
      "steady, drogue_steady: run folders with the drag areas.\n"
      "opening, drogue_opening: run folders with computed openings.\n"
      "measured_load_n, drogue_measured_load_n: opening loads measured at the speeds of these openings.\n"
      "sections_kg: masses of the sections of the rocket, for their kinetic energy at landing.\n"
      "separation_speed_m_s: speed at which two sections part, for the load on the shock cord in "
      "[hardware].\n"
      "bay_diameter_m: inner diameter of the parachute bay, for the length of the packed parachute.\n"
      "out: folder for the files of the result. None: no files.\n\n"
      "The wind is that of [flight.wind] of the main's case.");
}

}  // namespace ripstop::python
