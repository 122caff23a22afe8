// Recovery of a rocket from apogee to the ground under one or two parachutes: `ripstop recovery`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/flight/wind.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/fastest.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

struct RecoveryRequest {
  double mass = 0;                       // that descends, without the parachutes [kg]
  double apogee = 0;                     // above the ground [m]
  double main_height = 300;              // above the ground, at which the main opens; used with a drogue [m]
  double speed = 20;                     // through the air at apogee, horizontal (assumed) [m/s]
  double delay = 0;                      // of the first opening after apogee [s]
  double ground = 0;                     // above sea level [m]
  std::optional<double> body_drag_area;  // [m2]; absent: payload.drag_area_m2 of the main's case
  bool drogue_released = false;          // when the main opens; else it remains attached
  double packing_density = packed_by_hand;             // [kg/m3]
  std::optional<double> bay_diameter;                  // inner, of the airframe [m]
  std::vector<double> sections;                        // masses of separate parts at landing [kg]
  std::optional<double> separation_speed;              // at which two of them part; needs two masses [m/s]
  std::filesystem::path main_steady, drogue_steady;    // runs that provide the drag areas; empty: none
  std::filesystem::path main_opening, drogue_opening;  // computed openings; empty: none
  std::optional<double> main_measured_load, drogue_measured_load;  // at the speed of the opening [N]
};

/// A value, and its range with the smallest and largest drag coefficients of all parachutes (DescentDrag).
struct Ranged {
  double value = 0, low = 0, high = 0;
};
template <Of<Ranged> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("value", r.value);
  visit("low", r.low);
  visit("high", r.high);
}

/// From the opening of one parachute to the next opening or the ground.
struct RecoveryStage {
  std::string name, title;                                                // "drogue" or "main"; of its case
  double drag_coefficient = 0, drag_uncertainty = 0, reference_area = 0;  // on S0, relative, [m2]
  std::string drag_source, drag_basis;                                    // "axial", "descent" or "given"
  DescentDrag descent_drag;                                               // range in descent
  double time = 0, height = 0,
         path_angle = 0;    // of the opening [s], above the ground [m], below the horizon [deg]
  double density = 0;       // there, of the standard atmosphere [kg/m3]
  Ranged speed;             // through the air at the opening [m/s]
  double filling_time = 0;  // [s]
  double lowest_load = 0, highest_load = 0;  // of the methods that apply [N]
  std::optional<double> lowest_finite_mass_load,
      highest_finite_mass_load;                            // without the infinite-mass load [N]
  double design_load = 0;                                  // [N]
  double lowest_design_load = 0, highest_design_load = 0;  // with the ranges of drag, speed and scatter [N]
  double load_uncertainty = 0;  // of its upper end, relative: at one speed, or `of_trajectory`
  bool of_trajectory = false;   // the upper end is the largest force of a trajectory; not in result.json
  std::string load_uncertainty_from;
  std::string design_load_from;
  std::optional<double> snatch_load;      // by [deployment] of the case, at the highest speed [N]
  std::optional<double> separation_load;  // of two sections, on the stretching hardware of its case [N]
  HardwareNeed hardware;                  // under the largest of design load, snatch load and separation load
  std::optional<Margins> margins;         // the same
  std::string design_load_caution;        // where a computed opening can have more; empty: none
  std::optional<SafeSpeed>
      safe;                  // by the method of the design load; absent: the load is measured at one speed
  Ranged descent_rate;       // at the end [m/s]
  Ranged duration, drift;    // [s], with the wind [m]
  double mass = 0;           // of the parachute [kg]
  double packed_volume = 0;  // [m3]
  std::optional<double> bay_length;  // of the packed parachute in the bay [m]
};
template <Of<RecoveryStage> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("stage", s.name);
  visit("title", s.title);
  visit("drag_coefficient", s.drag_coefficient);
  visit("drag_coefficient_uncertainty", s.drag_uncertainty);
  visit("drag_coefficient_from", s.drag_source);
  visit("drag_coefficient_basis", s.drag_basis);
  visit("lowest_drag_coefficient", s.descent_drag.low);
  visit("highest_drag_coefficient", s.descent_drag.high);
  visit("drag_coefficient_range_from", s.descent_drag.from);
  visit("reference_area_m2", s.reference_area);
  visit("time_s", s.time);
  visit("height_m", s.height);
  visit("path_angle_deg", s.path_angle);
  visit("density_kg_m3", s.density);
  visit("speed_m_s", s.speed);
  visit("filling_time_s", s.filling_time);
  visit("lowest_load_n", s.lowest_load);
  visit("highest_load_n", s.highest_load);
  visit("lowest_finite_mass_load_n", s.lowest_finite_mass_load);
  visit("highest_finite_mass_load_n", s.highest_finite_mass_load);
  visit("design_load_n", s.design_load);
  visit("lowest_design_load_n", s.lowest_design_load);
  visit("highest_design_load_n", s.highest_design_load);
  visit("load_uncertainty", s.load_uncertainty);
  visit("load_uncertainty_from", s.load_uncertainty_from);
  visit("design_load_from", s.design_load_from);
  visit("design_load_caution", s.design_load_caution);
  visit("snatch_load_n", s.snatch_load);
  visit("separation_load_n", s.separation_load);
  visit("required_hardware", s.hardware);
  visit("margins", s.margins);
  visit("fastest_safe_deployment", s.safe);
  visit("descent_rate_m_s", s.descent_rate);
  visit("duration_s", s.duration);
  visit("drift_m", s.drift);
  visit("parachute_mass_kg", s.mass);
  visit("packed_volume_m3", s.packed_volume);
  visit("bay_length_m", s.bay_length);
}

struct SectionEnergy {
  double mass = 0;  // [kg]
  Ranged energy;    // [J]
};
template <Of<SectionEnergy> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("mass_kg", s.mass);
  visit("energy_j", s.energy);
}

/// A row of trajectory.csv.
struct RecoveryRow {
  FlightRow flight;
  double drift = 0;  // with the wind since apogee [m]
  int open = 0;      // parachutes that have opened
};
template <Of<RecoveryRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  each_member(row.flight, visit);
  visit("drift_m", row.drift);
  visit("opened_parachutes", row.open);
}

/// result.json of `ripstop recovery`.
struct RecoveryResult {
  std::string title;
  double mass = 0, total_mass = 0;  // without and with parachutes [kg]
  double apogee = 0, ground = 0;    // [m]
  Wind wind;                        // profile over height
  double apogee_wind = 0;           // speed at apogee [m/s]
  std::vector<RecoveryStage> stages;
  Ranged time;                   // from apogee to the ground [s]
  Ranged drift;                  // with the wind [m]
  double range = 0;              // along the flight path in still air [m]
  Ranged landing_speed, energy;  // at least that of the open canopy [m/s], of the total mass [J]
  std::vector<SectionEnergy> sections;
  std::vector<std::string> warnings;
  std::vector<RecoveryRow> rows;  // not in result.json: trajectory.csv
};
template <Of<RecoveryResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("mass_kg", r.mass);
  visit("total_mass_kg", r.total_mass);
  visit("apogee_m", r.apogee);
  visit("ground_m", r.ground);
  visit("wind_m_s", r.wind.speed_m_s);
  visit("wind_reference_height_m", r.wind.reference_height_m);
  visit("wind_exponent", r.wind.exponent);
  visit("apogee_wind_m_s", r.apogee_wind);
  visit("stages", r.stages);
  visit("time_s", r.time);
  visit("drift_m", r.drift);
  visit("range_m", r.range);
  visit("landing_speed_m_s", r.landing_speed);
  visit("energy_j", r.energy);
  visit("sections", r.sections);
  visit("warnings", r.warnings);
}
std::string to_json(const RecoveryResult& result);

/// A point mass from apogee to the ground: body alone during the delay, then with the first parachute, then with the
/// main. Opening loads are those of run_load() at the speed, height and path of the flight. The design load of a stage
/// is at least the largest force on its canopy along the trajectory. The upper end of its range is the load at the
/// highest speed plus the uncertainty: the range of the coefficient and the scatter of openings, as independent parts;
/// the lower end likewise. The fastest safe deployment has the same uncertainty. A measured load or a computed opening
/// replaces the handbook as in run_load(); a measured load is scaled to the speeds of the range with their squares, and
/// has no fastest safe deployment; one below the largest force of the trajectory is not used. The canopies follow the
/// wind at once. Wind: [flight.wind] of the main's case. Throws Error(usage) as run_load(), and for a main that opens
/// above the apogee.
RecoveryResult run_recovery(const Settings& main, const std::optional<Settings>& drogue,
                            const RecoveryRequest& request);

/// result.json, trajectory.csv, height.png, speed.png and report.html.
void write_recovery(const std::filesystem::path& folder, const RecoveryResult& result);

}  // namespace ripstop::inline run
