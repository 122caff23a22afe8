// How a payload descends under the parachute of a steady run: `ripstop descent`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/run/steady/finished_steady.h"

namespace ripstop {

struct DescentRow {
  double height = 0, density = 0;           // above sea level [m], [kg/m3]
  double speed = 0, speed_uncertainty = 0;  // [m/s]
  std::optional<double> time;               // from there to the ground [s]; absent on the ground and below
  std::optional<double> time_uncertainty;   // [s]
};
template <Of<DescentRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("height_m", row.height);
  visit("density_kg_m3", row.density);
  visit("speed_m_s", row.speed);
  visit("speed_uncertainty_m_s", row.speed_uncertainty);
  visit("time_to_ground_s", row.time);
  visit("time_uncertainty_s", row.time_uncertainty);
}

struct Descent {
  std::string title, run;
  double payload_mass = 0, parachute_mass = 0;      // [kg]
  double drag_area = 0, drag_area_uncertainty = 0;  // [m2]
  double run_speed = 0;                             // at which the drag area was computed [m/s]
  double ground = 0;                                // [m]
  std::vector<DescentRow> rows;
  std::vector<std::string> warnings;
};
template <Of<Descent> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("title", d.title);
  visit("run", d.run);
  visit("payload_mass_kg", d.payload_mass);
  visit("parachute_mass_kg", d.parachute_mass);
  visit("drag_area_m2", d.drag_area);
  visit("drag_area_uncertainty_m2", d.drag_area_uncertainty);
  visit("run_speed_m_s", d.run_speed);
  visit("ground_m", d.ground);
  visit("heights", d.rows);
  visit("warnings", d.warnings);
}
std::string to_json(const Descent& descent);

/// Uses the drag area of the run at every height, in the standard atmosphere; the drag carries payload and
/// parachute. Throws Error(usage) for a mass that is not above 0 and for heights outside the atmosphere.
Descent run_descent(const FinishedSteady& run, double payload_mass, const std::vector<double>& heights,
                    double ground = 0);

}  // namespace ripstop
