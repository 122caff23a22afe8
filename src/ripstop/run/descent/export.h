// Steady runs in the formats of flight simulators, as one parachute or as drogue and main: `ripstop export`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/run/flight/finished_flight.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/steady/finished_steady.h"

namespace ripstop::inline run {

/// The parachute of a run in the quantities of other programs.
struct ExportedParachute {
  std::string title, run;
  double drag_area = 0, drag_area_uncertainty = 0;  // [m2]
  /// Normal distribution for a dispersion analysis. Its mean is the middle of the range in descent, which is that of
  /// `ripstop recovery`. Its standard deviation is a quarter of the width of this range (assumed) [m2].
  double drag_area_mean = 0, drag_area_deviation = 0;
  double nominal_diameter = 0, nominal_area = 0, drag_coefficient = 0;
  std::string drag_coefficient_on;  // the member that is its reference area
  std::string basis;                // "axial": of the steady run; "descent": of the flight
  std::optional<std::array<double, 2>> known_coefficient;  // the handbook's range, in descent
  double radius = 0, height = 0;  // of the open canopy, half the projected diameter and skirt to crown [m]
  double porosity = 0;            // open share of the surface as constructed
  double deployment_speed = 0;    // for the lag [m/s]
  std::string deployment_speed_from;
  bool speed_assumed = false;  // not in result.json
  double lag = 0;              // from the trigger to the full drag area [s]
  std::string lag_from;
  double lag_deviation = 0;  // standard deviation [s]
  double mass = 0;           // [kg]
  int gores = 0, line_count = 0;
  double line_length = 0, line_density = 0, cloth_density = 0;  // [m], [kg/m], [kg/m2]
  std::string line_material, cloth_material;
  double packed_volume = 0, packed_diameter = 0,
         packed_length = 0;  // [m3], [m], [m]: a cylinder twice as long as wide, or as wide as the bay
  std::vector<std::string> warnings = {};  // of run and flight
};
template <Of<ExportedParachute> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("title", p.title);
  visit("run", p.run);
  visit("drag_area_m2", p.drag_area);
  visit("drag_area_uncertainty_m2", p.drag_area_uncertainty);
  visit("drag_area_mean_m2", p.drag_area_mean);
  visit("drag_area_deviation_m2", p.drag_area_deviation);
  visit("nominal_diameter_m", p.nominal_diameter);
  visit("nominal_area_m2", p.nominal_area);
  visit("drag_coefficient", p.drag_coefficient);
  visit("drag_coefficient_on", p.drag_coefficient_on);
  visit("drag_coefficient_basis", p.basis);
  visit("handbook_drag_coefficient", p.known_coefficient);
  visit("radius_m", p.radius);
  visit("height_m", p.height);
  visit("porosity", p.porosity);
  visit("deployment_speed_m_s", p.deployment_speed);
  visit("deployment_speed_from", p.deployment_speed_from);
  visit("lag_s", p.lag);
  visit("lag_from", p.lag_from);
  visit("lag_deviation_s", p.lag_deviation);
  visit("mass_kg", p.mass);
  visit("gores", p.gores);
  visit("line_count", p.line_count);
  visit("line_length_m", p.line_length);
  visit("line_density_kg_m", p.line_density);
  visit("line_material", p.line_material);
  visit("cloth_density_kg_m2", p.cloth_density);
  visit("cloth_material", p.cloth_material);
  visit("packed_volume_m3", p.packed_volume);
  visit("packed_diameter_m", p.packed_diameter);
  visit("packed_length_m", p.packed_length);
  visit("warnings", p.warnings);
}
std::string to_json(const ExportedParachute& parachute);

/// `deployment_speed` [m/s], for the filling time n D0 / v; absent: that of the case, else the run's own speed, or of a run
/// that has computed its rate of descent usual_deployment_speed(), for which `ripstop size` designs. The drag area is that of the run,
/// or of a `flight` of the same parachute. Throws Error(usage) for the flight of another one.
ExportedParachute exported(const FinishedSteady& run, std::optional<double> deployment_speed = {},
                           const std::optional<FinishedFlight>& flight = {});

/// The packed parachute fills a bay of this inner diameter [m].
void pack_into_bay(double diameter, ExportedParachute& parachute);

/// One parachute of a recovery, with its deployment.
struct ExportedStage {
  ExportedParachute parachute;
  std::string trigger = "apogee";  // or a height above the ground in metres
  std::vector<ReefedStage> reefing = {};
};
template <Of<ExportedStage> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("trigger", s.trigger);
  visit("parachute", s.parachute);
}

/// One parachute, or drogue and main in the order of their opening.
struct ExportedRecovery {
  std::vector<ExportedStage> stages;
  bool drogue_released = false;  // when the main opens; else it remains attached, and its drag area is added
};
template <Of<ExportedRecovery> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("stages", r.stages);
  visit("drogue_released", r.drogue_released);
}
std::string to_json(const ExportedRecovery& recovery);
/// Of its parachutes, and of a drogue with more drag area than the main.
std::vector<std::string> warnings_of(const ExportedRecovery& recovery);

/// Python: the arguments of RocketPy's Rocket.add_parachute and of StochasticParachute, and functions that add them.
/// RocketPy uses the drag area of the parachute that opened last, so that of a drogue which remains attached is added to
/// that of the main. A reefed stage is a parachute of its own; a disreef is triggered by the time since its trigger.
/// Throws Error(usage) for a trigger that is none, and for a reefed stage shorter than its filling time.
std::string rocketpy_text(const ExportedRecovery& recovery);
std::string rocketpy_text(const ExportedParachute& parachute, const std::string& trigger);

/// A component database of OpenRocket with the parachutes and their materials: an .orc file.
std::string openrocket_text(const ExportedRecovery& recovery);
std::string openrocket_text(const ExportedParachute& parachute);

/// A design of OpenRocket, an .ork file: a body tube with the parachutes and their deployment events. OpenRocket adds the
/// drag areas of all devices that are open; a disreef is therefore a second device with the rest of the drag area. The
/// delay of a device is its filling time. Throws as rocketpy_text(), and for a drogue that is released.
std::string openrocket_design(const ExportedRecovery& recovery);

}  // namespace ripstop::inline run
