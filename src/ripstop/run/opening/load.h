// The load when a parachute opens behind a given mass, by every method side by side: `ripstop load`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/flight/opening_load.h"
#include "ripstop/flight/trajectory.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/method_load.h"
#include "ripstop/run/opening/opening_record.h"
#include "ripstop/run/opening/snatch.h"

namespace ripstop::inline run {

/// A reefed stage: held at a share of the open drag area until so long after line stretch or the disreef before.
struct ReefedStage {
  double share = 0;     // of the open canopy's drag area
  double duration = 0;  // [s]
};

/// The request; absent values follow from the case and from data of the family.
struct LoadRequest {
  double payload_mass = 0;  // [kg]
  double speed = 0;         // through the air at line stretch [m/s]
  std::string speed_source = "given";
  std::optional<double> height;  // above sea level there [m]; absent: opening_air() of the case
  /// Above sea level, where the flight ends [m]. Absent: sea level, or with the air of the case nowhere.
  std::optional<double> ground;
  double path_angle = 90;  // of the flight path at line stretch, below the horizon [deg]
  std::optional<double> drag_coefficient, opening_coefficient, filling_constant, filling_exponent;
  double impulse_integral = 0.5;  // I_F of momentum_impulse_load()
  std::vector<ReefedStage> reefing;
  std::optional<double> snatch_speed;  // difference of the speeds at line stretch [m/s]
  std::optional<double>
      packed_drag_area;  // of the packed canopy with its pilot, to find that difference [m2]
  std::optional<double> payload_drag_area;  // [m2]; absent: the case's
  std::filesystem::path steady, opening;    // folders of runs to take the drag area from; empty: none
  std::filesystem::path filling_from;  // of a computed opening whose n and exponent are taken; empty: none
  /// The trajectory continues to the steady descent or the ground, and the snatch load is computed; else the opening
  /// alone.
  bool descent = true;
  std::optional<double> measured_load;  // of an opening of this parachute at this speed and mass [N]
};

/// A row of trajectory.csv.
template <Of<FlightRow> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("time_s", row.state.time);
  visit("distance_m", row.state.distance);
  visit("range_m", row.state.range);
  visit("height_m", row.state.height);
  visit("speed_m_s", row.state.speed);
  visit("path_angle_deg", row.state.path_angle);
  visit("drag_area_m2", row.drag_area);
  visit("force_n", row.force);
  visit("density_kg_m3", row.density);
}

struct StageLoads {
  double begin = 0, speed = 0, height = 0, density = 0;          // of the stage [s], [m/s], [m], [kg/m3]
  double path_angle = 0;                                         // at its begin, below the horizon [deg]
  double drag_area_before = 0, drag_area = 0, filling_time = 0;  // [m2], [m2], [s]
  double filling_constant = 0;                                   // n at this speed
  double ballistic_parameter = 0, mass_ratio = 0;
  std::string outside;  // why the handbook's filling does not apply; empty: it does; not in result.json
  std::string caution;  // limit of the filling distance of applicable methods; empty: none
  std::vector<MethodLoad> methods;
  /// Of the methods that apply, the infinite-mass load where none does; (highest - lowest) / mean.
  double highest = 0, lowest = 0, spread = 0;
};
template <Of<StageLoads> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("begin_s", s.begin);
  visit("speed_m_s", s.speed);
  visit("height_m", s.height);
  visit("density_kg_m3", s.density);
  visit("path_angle_deg", s.path_angle);
  visit("drag_area_before_m2", s.drag_area_before);
  visit("drag_area_m2", s.drag_area);
  visit("filling_time_s", s.filling_time);
  visit("filling_constant", s.filling_constant);
  visit("filling_caution", s.caution);
  visit("ballistic_parameter", s.ballistic_parameter);
  visit("mass_ratio", s.mass_ratio);
  visit("methods", s.methods);
  visit("highest_n", s.highest);
  visit("lowest_n", s.lowest);
  visit("spread", s.spread);
}

/// result.json of `ripstop load`.
struct LoadResult {
  std::string title;
  double payload_mass = 0, parachute_mass = 0;  // [kg]
  double speed = 0, path_angle = 0;             // at line stretch [m/s], below the horizon [deg]
  std::string speed_source;
  double height = 0, density = 0;  // there, above sea level [m], [kg/m3]
  std::string air_source;
  double nominal_diameter = 0, reference_area = 0;  // [m], [m2]
  double drag_coefficient = 0, opening_coefficient = 0, filling_constant = 0, filling_exponent = 0;
  double ludtke_exponent = 0;
  double drag_uncertainty = 0;         // of the drag coefficient, relative
  double design_drag_coefficient = 0;  // C_D of the infinite-mass load
  std::string drag_source, opening_source, filling_source;
  std::vector<StageLoads> stages;
  double design_load = 0;           // by the rule of docs/theory/opening-load.md, without its uncertainty [N]
  std::string design_load_from;     // measured, computed or infinite mass
  std::string design_load_caution;  // where a computed opening can have more; empty: none
  std::string heavy_payload;        // its first sentence; not in result.json
  std::string design_method;        // of a stage, whose load this is; empty: measured
  double load_uncertainty = 0;      // of the design load, relative
  std::string load_uncertainty_from;
  double highest_design_load = 0;         // design load with its uncertainty [N]
  double required_load = 0;               // of hardware: highest design load or larger snatch load [N]
  HardwareNeed hardware;                  // under it
  std::optional<double> smallest_margin;  // of safety, of the weakest member under the highest design load
  std::string smallest_margin_member;
  double line_load_factor =
      1;                // largest line load over an equal share, of the family or the computed opening
  MemberShares shares;  // of a computed opening that is the design; not in result.json
  // Of tape or hem under the design load; of the others under this or a larger snatch load.
  std::optional<Margins> margins;
  std::optional<Margins> highest_margins;  // the same with the highest design load
  double peak_load = 0, peak_time = 0;     // of the trajectory [N], [s]
  std::optional<double> record_peak_load;  // of the trajectory with a computed opening's drag area [N]
  std::string
      record_limit;  // why it does not replace a larger design load; empty: it does; not in result.json
  std::optional<SnatchResult> snatch;
  double steady_speed = 0, steady_time = 0, steady_drop = 0;  // where the descent is steady [m/s], [s], [m]
  bool steady_reached = false;
  std::vector<std::string> warnings;
  std::vector<std::string> opening_warnings;  // of these, on a measured or computed load; not in result.json
  std::vector<FlightRow> flight, record_flight;  // not in result.json: trajectory.csv
};
template <Of<LoadResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("payload_mass_kg", r.payload_mass);
  visit("parachute_mass_kg", r.parachute_mass);
  visit("speed_m_s", r.speed);
  visit("speed_from", r.speed_source);
  visit("path_angle_deg", r.path_angle);
  visit("height_m", r.height);
  visit("density_kg_m3", r.density);
  visit("air_from", r.air_source);
  visit("nominal_diameter_m", r.nominal_diameter);
  visit("reference_area_m2", r.reference_area);
  visit("drag_coefficient", r.drag_coefficient);
  visit("drag_coefficient_from", r.drag_source);
  visit("drag_coefficient_uncertainty", r.drag_uncertainty);
  visit("design_drag_coefficient", r.design_drag_coefficient);
  visit("opening_coefficient", r.opening_coefficient);
  visit("opening_coefficient_from", r.opening_source);
  visit("filling_constant", r.filling_constant);
  visit("filling_exponent", r.filling_exponent);
  visit("ludtke_exponent", r.ludtke_exponent);
  visit("filling_from", r.filling_source);
  visit("stages", r.stages);
  visit("design_load_n", r.design_load);
  visit("design_load_from", r.design_load_from);
  visit("design_load_caution", r.design_load_caution);
  visit("design_method", r.design_method);
  visit("load_uncertainty", r.load_uncertainty);
  visit("load_uncertainty_from", r.load_uncertainty_from);
  visit("highest_design_load_n", r.highest_design_load);
  visit("required_load_n", r.required_load);
  visit("required_hardware", r.hardware);
  visit("smallest_margin_of_safety", r.smallest_margin);
  visit("smallest_margin_member", r.smallest_margin_member);
  visit("line_load_factor", r.line_load_factor);
  visit("margins", r.margins);
  visit("margins_under_highest_design_load", r.highest_margins);
  visit("peak_load_n", r.peak_load);
  visit("peak_time_s", r.peak_time);
  visit("record_peak_load_n", r.record_peak_load);
  visit("snatch", r.snatch);
  visit("steady_speed_m_s", r.steady_speed);
  visit("steady_time_s", r.steady_time);
  visit("steady_drop_m", r.steady_drop);
  visit("steady_reached", r.steady_reached);
  visit("warnings", r.warnings);
}
std::string to_json(const LoadResult& result);

/// C_D on the nominal area: that of a `request`, of its steady run or flight, of the case (inflation.drag_coefficient), the
/// middle of the handbook's range, or the value computed by Ripstop for the family. Throws Error(usage) if none is
/// known.
struct DragCoefficient {
  double value = 0;
  std::string from;
  double uncertainty = 0;  // relative
  std::string basis;       // "axial", "descent" or "given"
};
/// Relative uncertainty of a drag coefficient whose own is smaller or not known (assumed; the rates of descent of a flight
/// on two grids differ by 4 %, hence its coefficients by 8 %: docs/guide/fly.md).
inline constexpr double usual_drag_uncertainty = 0.1;
DragCoefficient opening_drag_coefficient(const Settings& resolved, const LoadRequest& request);

/// The speed of the request: `given`, else payload.deployment_speed_m_s of the case. Throws Error(usage) without both.
void take_speed(const Settings& resolved, const std::optional<double>& given, LoadRequest& request);

/// Relative uncertainty of an opening load: of the drag area and of the scatter of repeated openings (opening_scatter), as
/// independent parts.
struct LoadUncertainty {
  double value = 0;
  std::string from;
};
LoadUncertainty load_uncertainty(const DragCoefficient& drag);

/// On a path downwards, the speed at line stretch below which the weight along the path exceeds the drag of the open
/// canopy, so that the payload still accelerates; else 0 [m/s]. Arguments: [kg], [m2], [kg/m3], [deg].
double slowest_opening(double mass, double drag_area, double density, double path_angle);

/// Data of the runs in the folders of a request. They do not depend on its speed.
struct LoadInputs {
  DragCoefficient drag;
  std::optional<ComputedFilling> filling;  // of LoadRequest::filling_from
  std::optional<OpeningRecord> opening;    // of LoadRequest::opening
  std::vector<std::string> warnings;       // of all of these runs
};
/// Reads the folders and verifies their checksums. Throws as opening_drag_coefficient(), computed_filling(),
/// opening_record() and warnings_of_used().
LoadInputs load_inputs(const Settings& resolved, const LoadRequest& request);

/// Throws Error(usage) for quantities that are not above 0, a descent rate above the deployment speed, stages
/// that do not grow, and inputs that load_inputs() and standard_air() refuse.
LoadResult run_load(const Settings& resolved, const LoadRequest& request);
/// The same with inputs that have been read: for the loads at several speeds.
LoadResult run_load(const Settings& resolved, const LoadRequest& request, const LoadInputs& inputs);

/// result.json, trajectory.csv, force.png and speed.png.
void write_load(const std::filesystem::path& folder, const LoadResult& result);

}  // namespace ripstop::inline run
