// How a payload descends under the parachute of a steady run or of a flight: `ripstop descent`.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/run/flight/finished_flight.h"
#include "ripstop/run/steady/finished_steady.h"

namespace ripstop::inline run {

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

/// The drag that carries the payload: of a steady run on the axis, or in descent of a flight.
struct CarryingRun {
  std::filesystem::path folder;
  Settings resolved;
  std::string title, basis;               // "axial" or "descent"
  double drag_area = 0, uncertainty = 0;  // [m2]; of it, relative
  double speed = 0, density = 0;          // [m/s], [kg/m3]
  double parachute_mass = 0;              // [kg]
  std::vector<std::string> warnings = {};
};
CarryingRun carrying_run(const FinishedSteady& run);
CarryingRun carrying_run(const FinishedFlight& flight);
/// Of the run in a folder, of either kind. Throws as finished_steady() and finished_flight().
CarryingRun carrying_run(const std::filesystem::path& folder);

struct Descent {
  std::string title, run;
  std::string basis;                                       // of the drag coefficient: "axial" or "descent"
  double drag_coefficient = 0;                             // on S0
  std::optional<std::array<double, 2>> known_coefficient;  // the handbook's, in descent
  double payload_mass = 0, parachute_mass = 0;             // [kg]
  double drag_area = 0, drag_area_uncertainty = 0;         // [m2]
  double run_speed = 0;                                    // at which the drag area was computed [m/s]
  double ground = 0;                                       // [m]
  std::vector<DescentRow> rows;
  std::vector<std::string> warnings;
};
template <Of<Descent> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("title", d.title);
  visit("run", d.run);
  visit("drag_coefficient_basis", d.basis);
  visit("drag_coefficient", d.drag_coefficient);
  visit("handbook_drag_coefficient", d.known_coefficient);
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
Descent run_descent(const CarryingRun& run, double payload_mass, const std::vector<double>& heights,
                    double ground = 0);
inline Descent run_descent(const FinishedSteady& run, double payload_mass, const std::vector<double>& heights,
                           double ground = 0) {
  return run_descent(carrying_run(run), payload_mass, heights, ground);
}

}  // namespace ripstop::inline run
