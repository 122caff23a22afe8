// A steady run in the formats of flight simulators: `ripstop export`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/run/flight/finished_flight.h"
#include "ripstop/run/steady/finished_steady.h"

namespace ripstop {

/// The parachute of a run in the quantities of other programs.
struct ExportedParachute {
  std::string title, run;
  double drag_area = 0, drag_area_uncertainty = 0;  // [m2]
  double nominal_diameter = 0, nominal_area = 0, drag_coefficient = 0;
  std::string drag_coefficient_on;  // the member that is its reference area
  std::string basis;                // "axial": of the steady run; "descent": of the flight
  std::optional<std::array<double, 2>> known_coefficient;  // the handbook's range, in descent
  double radius = 0, height = 0;  // of the open canopy, half the projected diameter and skirt to crown [m]
  double porosity = 0;            // open share of the surface as constructed
  double lag = 0;                 // from the trigger to the full drag area [s]
  std::string lag_from;
  double mass = 0;  // [kg]
  int gores = 0, line_count = 0;
  double line_length = 0, line_density = 0, cloth_density = 0;  // [m], [kg/m], [kg/m2]
  std::string line_material, cloth_material;
  double packed_volume = 0, packed_diameter = 0,
         packed_length = 0;  // [m3], [m], [m]: a cylinder twice as long as wide
};
template <Of<ExportedParachute> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("title", p.title);
  visit("run", p.run);
  visit("drag_area_m2", p.drag_area);
  visit("drag_area_uncertainty_m2", p.drag_area_uncertainty);
  visit("nominal_diameter_m", p.nominal_diameter);
  visit("nominal_area_m2", p.nominal_area);
  visit("drag_coefficient", p.drag_coefficient);
  visit("drag_coefficient_on", p.drag_coefficient_on);
  visit("drag_coefficient_basis", p.basis);
  visit("handbook_drag_coefficient", p.known_coefficient);
  visit("radius_m", p.radius);
  visit("height_m", p.height);
  visit("porosity", p.porosity);
  visit("lag_s", p.lag);
  visit("lag_from", p.lag_from);
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
}
std::string to_json(const ExportedParachute& parachute);

/// `deployment_speed` [m/s], for the filling time n D0 / v; absent: the run's own speed. The drag area is that of the run,
/// or of a `flight` of the same parachute. Throws Error(usage) for the flight of another one.
ExportedParachute exported(const FinishedSteady& run, std::optional<double> deployment_speed = {},
                           const std::optional<FinishedFlight>& flight = {});

/// Python: the arguments of RocketPy's Rocket.add_parachute (1.12), as a dictionary and a call. `trigger` is "apogee"
/// or a height above the ground in metres. Throws Error(usage) for another one.
std::string rocketpy_text(const ExportedParachute& parachute, const std::string& trigger);

/// A component database of OpenRocket with the parachute and its materials: an .orc file.
std::string openrocket_text(const ExportedParachute& parachute);

}  // namespace ripstop
