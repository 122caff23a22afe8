// One free flight in memory: the computation of `ripstop fly` without folder and terminal.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/flying.h"
#include "ripstop/core/members.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/fsi/flight_summary.h"
#include "ripstop/run/flight/flight_bodies.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/inflation.h"
#include "ripstop/run/run_folder.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// How a flight continues an inflation: the same quantities at the end of that and in its own first step.
struct Handover {
  double time = 0;                                   // since deployment [s]
  std::optional<double> deployment_speed;            // airspeed at deployment [m/s]
  std::optional<std::string> deployment_speed_from;  // both are absent in results of earlier versions
  bool same_flow = false;  // cells and boundaries are those of the inflation; else interpolated
  double height_lost = 0, opening_speed = 0;     // by the payload until then [m], its speed then [m/s]
  double path_angle = 0;                         // of its path below the horizon then [deg]
  double opening_peak = 0;                       // peak load of the inflation [N]
  double load_before = 0, load_after = 0;        // on the riser [N]
  double drag_before = 0, drag_after = 0;        // of the air on the canopy [N]
  double elastic_before = 0, elastic_after = 0;  // energy of cloth and lines [J]
};
template <Of<Handover> T, class Visit>
void each_member(T& h, Visit&& visit) {
  visit("time_s", h.time);
  visit("deployment_speed_m_s", h.deployment_speed);
  visit("deployment_speed_from", h.deployment_speed_from);
  visit("same_flow", h.same_flow);
  visit("height_lost_m", h.height_lost);
  visit("speed_m_s", h.opening_speed);
  visit("path_angle_deg", h.path_angle);
  visit("opening_peak_load_n", h.opening_peak);
  visit("load_before_n", h.load_before);
  visit("load_after_n", h.load_after);
  visit("drag_before_n", h.drag_before);
  visit("drag_after_n", h.drag_after);
  visit("elastic_energy_before_j", h.elastic_before);
  visit("elastic_energy_after_j", h.elastic_after);
}

/// Of a flight of a cluster.
struct FlightCluster {
  int canopies = 0;
  double first_spread = 0;              // at the start [deg]
  std::optional<double> factor;         // C_D0 in descent over that of one canopy, where the case gives that
  std::optional<ClusterMotion> motion;  // absent as the means of the flight
  double pierced = 0;                   // largest share of edges of cloth that pierce cloth, of all shapes
};
template <Of<FlightCluster> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("canopies", c.canopies);
  visit("first_spread_angle_deg", c.first_spread);
  visit("cluster_factor", c.factor);
  visit("motion", c.motion);
  visit("pierced_edges", c.pierced);
}

/// The numbers of one flight: result.json.
struct FlightResult {
  std::string title;
  std::optional<std::string> inputs_hash;  // of a run in a folder: that of its run.json
  std::string ended_by;  // "duration", "ground", "standard error", or the failure with its time
  double duration = 0;   // [s]
  double payload_mass = 0, parachute_mass = 0;  // [kg]
  /// Absent for a flight that failed or is too short for a mean.
  std::optional<double> descent, descent_error;            // [m/s]
  std::optional<double> coefficient, coefficient_error;    // C_D0 in descent: 2 M g / (rho V_v^2 S0)
  std::optional<std::array<double, 2>> known_coefficient;  // the handbook's range of the family, low and high
  std::optional<double> glide, glide_error;
  std::optional<double> oscillation, oscillation_error, largest, largest_error;  // [deg]
  std::optional<double> period, period_error;                                    // [s]
  std::optional<double> roundness;                                // of the path of the tilt: 0 plane, 1 cone
  std::optional<double> mean_angle, mean_attack, largest_attack;  // [deg]
  int peaks = 0;                                                  // half-swings counted
  double start_up = 0;                                            // until then nothing counts [s]
  std::optional<double> axial_speed;  // at which the drag of the canopy on the axis is the weight [m/s]
  std::optional<double>
      axial_coefficient;             // C_D0 on the axis (tunnel); absent, as the speed, after an inflation
  std::optional<Handover> handover;  // from an inflation
  std::optional<FlightCluster> cluster;
  std::optional<std::vector<FlightBody>>
      bodies;                             // of a case with rigid bodies; absent as the means of the flight
  double reference_area = 0;              // S0, of all canopies [m2]
  double density = 0;                     // at the start [kg/m3]
  std::optional<std::string> air_source;  // absent in results of earlier versions
  double largest_load = 0;                // of the lines on the payload [N]
  double load_factor = 0;                 // that over the payload's weight
  double distance = 0, height_lost = 0;   // of the payload over the ground [m]
  double energy_residual = 0, momentum_residual = 0;  // of the whole flight
  double air_momentum_residual = 0;  // largest momentum gap of a step of the air over the weight
  double mass_defect = 0;            // largest of a step of the air
  double cells_across = 0;           // of the inflated canopy
  StressPeak stress;                 // highest of all shapes
  std::optional<Margins> margins;
  long long flow_steps = 0, cloth_steps = 0;
  std::vector<std::string> warnings;
  bool usable = true;
};
template <Of<FlightResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("ended_by", r.ended_by);
  visit("duration_s", r.duration);
  visit("payload_mass_kg", r.payload_mass);
  visit("parachute_mass_kg", r.parachute_mass);
  visit("rate_of_descent_m_s", r.descent, or_null);
  visit("rate_of_descent_standard_error_m_s", r.descent_error, or_null);
  visit("descent_drag_coefficient", r.coefficient, or_null);
  visit("descent_drag_coefficient_standard_error", r.coefficient_error, or_null);
  visit("known_drag_coefficient", r.known_coefficient);
  visit("glide_ratio", r.glide, or_null);
  visit("glide_ratio_standard_error", r.glide_error, or_null);
  visit("mean_oscillation_deg", r.oscillation, or_null);
  visit("mean_oscillation_standard_error_deg", r.oscillation_error, or_null);
  visit("largest_oscillation_deg", r.largest, or_null);
  visit("largest_oscillation_standard_error_deg", r.largest_error, or_null);
  visit("oscillation_period_s", r.period, or_null);
  visit("oscillation_period_standard_error_s", r.period_error, or_null);
  visit("oscillation_roundness", r.roundness, or_null);
  visit("mean_angle_deg", r.mean_angle, or_null);
  visit("mean_angle_of_attack_deg", r.mean_attack, or_null);
  visit("largest_angle_of_attack_deg", r.largest_attack, or_null);
  visit("half_swings", r.peaks);
  visit("start_up_time_s", r.start_up);
  visit("axial_speed_m_s", r.axial_speed);
  visit("axial_drag_coefficient", r.axial_coefficient);
  visit("reference_area_m2", r.reference_area);
  visit("density_kg_m3", r.density);
  visit("air_from", r.air_source);
  visit("largest_line_force_n", r.largest_load);
  visit("load_factor", r.load_factor);
  visit("distance_m", r.distance);
  visit("height_lost_m", r.height_lost);
  visit("energy_residual", r.energy_residual);
  visit("momentum_residual", r.momentum_residual);
  visit("air_momentum_residual", r.air_momentum_residual);
  visit("mass_defect", r.mass_defect);
  visit("cells_across", r.cells_across);
  visit("max_von_mises_n_m", r.stress.von_mises);
  visit("max_von_mises_on", r.stress.patch);
  visit("max_cloth_strain", r.stress.strain);
  visit("margins", r.margins);
  visit("flow_steps", r.flow_steps);
  visit("cloth_steps", r.cloth_steps);
  visit("warnings", r.warnings);
  visit("handover", r.handover);
  visit("cluster", r.cluster);
  visit("bodies", r.bodies);
  visit("usable", r.usable);
}
std::string to_json(const FlightResult& result);
/// Of a flight from the equilibrium on the axis whose mouth has partly closed.
std::optional<std::string> mouth_warning(const std::vector<FreeFlightRow>& rows);

/// Where a flight begins: the canopy in equilibrium on the axis, at the speed at which its drag is the weight, or the
/// end of an inflation.
struct FlightStart {
  double speed = 0;              // [m/s]
  double coefficient = 0;        // C_D0 on the axis
  std::vector<Vec3> shape;       // [m]
  std::vector<double> pressure;  // on its cells [Pa]
  std::optional<OpeningEnd> opening;
  bool same_flow = true;  // Handover::same_flow
};
template <Of<FlightStart> T, class Visit>
void each_member(T& start, Visit&& visit) {
  visit("speed", start.speed);
  visit("coefficient", start.coefficient);
  visit("shape", start.shape);
  visit("pressure", start.pressure);
  visit("opening", start.opening);
  visit("same_flow", start.same_flow);
}

/// Shapes that are due until a time since the start of the flight [s], without that of the start.
inline long long shapes_until(double time, const FlightSettings& settings) {
  return static_cast<long long>(time * settings.shapes_per_s * (1 + 1e-12));
}

/// All of a flight so far.
struct FlightHistory {
  std::vector<FreeFlightRow> rows;
  std::vector<CanopyRow> canopies;    // of a cluster: at every step a row for each canopy
  std::vector<FlightBodyRow> bodies;  // at every step a row for each rigid body
};

/// Observer of a flight; functions that are not overridden do nothing.
class FlightObserver {
 public:
  virtual ~FlightObserver() = default;
  virtual void warned(const std::string&) {}
  /// Of the equilibrium on the axis.
  virtual void starting(const SteadyProgress&, const SteadyState&) {}
  /// Of the inflation that comes first, with its folder; an empty one is a temporary folder.
  virtual InflationObserver& opening();
  virtual RunSettings opening_run() { return {}; }
  /// An earlier start, in place of the equilibrium that would be computed.
  virtual std::optional<FlightStart> earlier_start() { return {}; }
  virtual void started(const FlightStart&) {}
  /// Before the first step. An observer with an earlier state replaces state and history.
  virtual void begin(FreeFlight&, FreeFlightState&, FlightHistory&) {}
  /// After every step; `shape`: one is due.
  virtual void advanced(FreeFlight&, const FreeFlightState&, const FlightHistory&, bool /*shape*/) {}
  virtual void ended(FreeFlight&, const FreeFlightState&, const FlightHistory&, const FlightResult&) {}
};

struct FlightSolution {
  FlightResult result;
  FreeFlightState state;
  FlightHistory history;
};

/// The flight of the case's settings, which are those of flight_case(), or of continued_case() for a flight that
/// continues from the finished inflation in the folder `from`. Throws as FreeFlight, run_steady(), run_inflation_in()
/// and finished_opening().
FlightSolution run_flight(const Settings& resolved, int threads, FlightObserver& observer,
                          const std::filesystem::path& from = {});

/// Settings of a flight of the case: those of flight_case(), or of continued_case() with the inflation in `from`. Throws
/// Error(usage) for the inflation of another parachute.
Settings flight_settings(const Case& given, const std::filesystem::path& from = {});

}  // namespace ripstop::inline run
