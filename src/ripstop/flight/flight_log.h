// Drag area over height, deployments and opening loads from the records of a flight.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/core/members.h"

namespace ripstop::inline flight {

/// Samples of one sensor, times ascending; a dropped sample is left out.
struct SensorRecord {
  std::vector<double> time, value;  // [s], SI
};

/// All records have one clock. The acceleration is the specific force that an accelerometer measures, its magnitude:
/// g at rest.
struct FlightRecords {
  SensorRecord height;                              // above the ground [m]
  std::optional<SensorRecord> acceleration, force;  // [m/s2], of the riser [N]
};

struct FlightLogSetup {
  double mass = 0;                         // that descends, parachute included [kg]
  double mass_uncertainty = 0;             // one standard deviation [kg]
  double ground = 0;                       // above sea level [m]
  double body_drag_area = 0;               // of everything but the canopies [m2]
  std::optional<double> nominal_diameter;  // for filling distances [m]
};

/// A part of the descent under one drag area, where drag is weight.
struct DescentPhase {
  double begin = 0, end = 0;                               // of the part used [s]
  double from_height = 0, to_height = 0;                   // above the ground [m]
  double speed = 0;                                        // mean [m/s]
  std::optional<double> drag_area, drag_area_uncertainty;  // of the canopies, one standard deviation [m2]
  std::string problem;                                     // why there is no drag area; empty: there is one
};
template <Of<DescentPhase> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("begin_s", p.begin);
  visit("end_s", p.end);
  visit("from_height_m", p.from_height);
  visit("to_height_m", p.to_height);
  visit("speed_m_s", p.speed);
  visit("drag_area_m2", p.drag_area);
  visit("drag_area_uncertainty_m2", p.drag_area_uncertainty);
  visit("problem", p.problem);
}

struct LoggedDeployment {
  double time = 0, height = 0;                           // [s], above the ground [m]
  double speed_before = 0, speed_after = 0;              // [m/s]
  std::optional<double> peak_load;                       // [N]
  std::optional<double> filling_time, filling_distance;  // [s], nominal diameters
  std::string problem;  // why load or filling time are not known; empty: they are
};
template <Of<LoggedDeployment> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("time_s", d.time);
  visit("height_m", d.height);
  visit("speed_before_m_s", d.speed_before);
  visit("speed_after_m_s", d.speed_after);
  visit("peak_load_n", d.peak_load);
  visit("filling_time_s", d.filling_time);
  visit("filling_distance", d.filling_distance);
  visit("problem", d.problem);
}

struct DragAreaAtHeight {
  double height = 0, drag_area = 0, uncertainty = 0;  // [m], [m2], one standard deviation [m2]
};
template <Of<DragAreaAtHeight> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("height_m", p.height);
  visit("drag_area_m2", p.drag_area);
  visit("drag_area_uncertainty_m2", p.uncertainty);
}

struct FlightLog {
  double highest_time = 0, highest = 0;  // [s], above the ground [m]
  double height_noise = 0;               // standard deviation of one sample [m]
  std::vector<DescentPhase> phases;
  std::vector<LoggedDeployment> deployments;  // those that slow the descent by a fifth at least
  std::vector<DragAreaAtHeight> drag_areas;   // in shorter parts of the phases
  std::vector<std::string> notes;
};

/// With y(h) the integral of sqrt(rho/rho_0) dh, a body at its terminal speed has
///
///   -dy/dt = s = sqrt(2 m g / (rho_0 C_D S)),
///
/// whatever the density does: a straight line whose slope is fitted to the heights of a phase. Neither noise nor a lag of
/// the barometer bias it. A deployment is a place where the slope after it is at most four fifths of that before it and
/// the difference exceeds five standard errors. Throws Error(bad_data) for a record without a descent of ten seconds.
FlightLog analyse_flight(const FlightRecords& records, const FlightLogSetup& setup);

}  // namespace ripstop::inline flight
