// One opening in memory: the computation of `ripstop inflate` without folder and terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/opening.h"
#include "ripstop/core/members.h"
#include "ripstop/flight/deployment.h"
#include "ripstop/fsi/cluster_motion.h"
#include "ripstop/fsi/opening.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/run/margins.h"
#include "ripstop/run/opening/method_load.h"
#include "ripstop/run/opening/opening_bodies.h"

namespace ripstop::inline run {

/// The numbers of one opening: result.json.
struct InflationResult {
  std::string title;
  std::optional<std::string> inputs_hash;  // of a run in a folder: that of its run.json
  double peak_load = 0, peak_time = 0;     // over every step after the start-up [N], [s]
  std::optional<double> start_up_time;  // of the air, which begins impulsively: until then no peak counts [s]
  std::optional<double> start_up_peak;  // over every step until then [N]
  std::optional<double> low_pass;       // cutoff [Hz]; absent, with its results: none given
  std::optional<double> smooth_peak;    // low-passed [N]
  std::optional<double> smooth_peak_time;  // [s]
  std::optional<double> smooth_overshoot;  // over the steady load
  InflationSummary summary;                // without the times that rest on a steady load where there is none
  std::optional<double> steady_load;       // absent: not settled, or of a payload, whose speed falls [N]
  std::optional<std::vector<StageSummary>> stages;  // of a reefed opening
  bool settled = false;                             // settled() of the summary
  std::optional<double> overshoot;                  // peak over steady load
  double impulse = 0;                               // [N s]
  std::optional<double> pressure;                   // uniform [Pa]
  std::optional<double> drag_area;                  // C_D S in the air, the largest of a step [m2]
  std::optional<double> added_mass;                 // of the canopy at the end [kg]
  std::optional<std::vector<OpeningBody>> bodies;   // of a coupled inflation with rigid bodies
  std::optional<Deployment> deployment;  // of a case with [deployment]: until the canopy leaves its bag
  /// Of a coupled inflation by its projected area, see filling_of(); under a uniform pressure the time at which the
  /// load first reaches the steady one.
  std::optional<double> filling_time;      // [s]
  std::optional<double> filling_distance;  // over the nominal diameter
  std::optional<double> growth_exponent;   // j of area = (t / t_f)^j
  std::optional<bool> filled;              // of a coupled inflation from a folded start
  std::optional<double> container_left;    // time at which the canopy has left its container [s]
  std::optional<double> outside;  // share of its length that has at the end; absent without container
  std::optional<double> end_speed, end_angle;  // of a payload that flies [m/s], of its path [deg]
  std::optional<double> height_lost;           // by it since deployment [m]
  LoadSource source;
  std::optional<double> steady_drag_returned;  // steady load over the drag that was asked for
  InflationSettings settings;
  ViscosityLimit viscosity_limit;
  int folds = 0;
  double inner_fold_radius = 0, outer_fold_radius = 0;  // [m]
  double start_strain = 0;
  std::vector<double> line_peaks;  // of each line over every step [N]; not in result.json
  double max_line_tension = 0;     // [N]
  StressPeak stress;
  double stress_time = 0;  // [s]
  std::optional<Margins> margins;
  double energy_residual = 0;  // largest |residual| of all frames after the first tenth of the work
  std::optional<double> momentum_residual;  // of the air: largest momentum gap of a step over the peak load
  std::optional<double> mass_defect;        // of the air: largest of a step after the start-up
  double contact_depth = 0, pierced = 0;    // largest of all frames, see InflationFrame
  std::optional<double> cells_across;       // of the air, across the inflated canopy
  std::optional<double> speed;              // airspeed at deployment [m/s]
  std::optional<std::string> speed_source;  // the key or option that gave it
  std::optional<double> height, density;    // at the start, above sea level [m], [kg/m3]
  std::optional<std::string> air_source;    // these five are absent in results of earlier versions
  OpeningEstimate estimate;
  std::optional<double> opening_force_coefficient;  // C_x of this opening: peak over C_D S q, infinite mass
  std::optional<double> finite_mass_factor;         // X_1 of this opening: peak over C_x C_D S q
  std::vector<MethodLoad> handbook;                 // of a payload: the same drop by the handbook methods
  std::optional<ClusterOpening> cluster;
  std::optional<std::vector<std::string>> warnings;  // absent in results of earlier versions, as is `usable`
  std::optional<bool> usable;                        // false: a quality limit that must hold does not
  long long steps = 0;
  int step_changes = 0;
};
template <Of<InflationResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("peak_load_n", r.peak_load);
  visit("peak_time_s", r.peak_time);
  visit("start_up_time_s", r.start_up_time);
  visit("start_up_peak_load_n", r.start_up_peak);
  visit("low_pass_hz", r.low_pass);
  visit("low_pass_peak_load_n", r.smooth_peak);
  visit("low_pass_peak_time_s", r.smooth_peak_time);
  visit("low_pass_overshoot", r.smooth_overshoot);
  visit("inflation_time_s", r.summary.inflation_time, or_null);
  visit("filling_time_s", r.filling_time);
  visit("filling_distance_diameters", r.filling_distance);
  visit("area_growth_exponent", r.growth_exponent);
  visit("filled", r.filled);
  visit("container_left_s", r.container_left);
  visit("canopy_outside", r.outside);
  visit("settling_time_s", r.summary.settling_time);
  visit("steady_load_n", r.steady_load, or_null);
  visit("last_load_n", r.summary.last_load);
  visit("last_load_deviation", r.summary.unsteadiness);
  visit("stages", r.stages);
  visit("settled", r.settled);
  visit("overshoot", r.overshoot, or_null);
  visit("impulse_n_s", r.impulse);
  visit("pressure_pa", r.pressure);
  visit("drag_area_peak_m2", r.drag_area);
  visit("added_mass_kg", r.added_mass);
  visit("bodies", r.bodies);
  visit("deployment", r.deployment);
  visit("speed_at_end_m_s", r.end_speed);
  visit("path_angle_at_end_deg", r.end_angle);
  visit("height_lost_m", r.height_lost);
  visit("pressure_from", r.source.text);
  visit("steady_drag_asked_n", r.source.steady_drag);
  visit("steady_drag_returned", r.steady_drag_returned);
  visit("damping_n_s_m3", r.settings.damping_n_s_m3);
  visit("quadratic_damping_n_s2_m4", r.settings.quadratic_damping_n_s2_m4);
  visit("line_damping_s", r.settings.line_damping_s);
  visit("cloth_damping_s", r.settings.cloth_damping_s);
  visit("cloth_damping_least_share", r.viscosity_limit.least_share);
  visit("cloth_damping_reduced_cells", r.viscosity_limit.reduced_cells);
  visit("folds", r.folds);
  visit("inner_fold_radius_m", r.inner_fold_radius);
  visit("outer_fold_radius_m", r.outer_fold_radius);
  visit("start_strain", r.start_strain);
  visit("max_line_tension_n", r.max_line_tension);
  visit("max_von_mises_n_m", r.stress.von_mises);
  visit("max_von_mises_at_m", r.stress.place);
  visit("max_von_mises_on", r.stress.patch);
  visit("max_von_mises_time_s", r.stress_time);
  sewing_members(r.stress, visit);
  visit("max_cloth_strain", r.stress.strain);
  visit("margins", r.margins);
  visit("energy_residual", r.energy_residual);
  visit("momentum_residual", r.momentum_residual);
  visit("mass_defect", r.mass_defect);
  visit("contact_depth", r.contact_depth);
  visit("pierced_edges", r.pierced);
  visit("cells_across", r.cells_across);
  visit("speed_m_s", r.speed);
  visit("speed_from", r.speed_source);
  visit("height_m", r.height);
  visit("density_kg_m3", r.density);
  visit("air_from", r.air_source);
  visit("knacke_load_n", r.estimate.load, or_null);
  visit("knacke_coefficient", r.estimate.coefficient);
  visit("knacke_drag_n", r.estimate.drag, or_null);
  visit("knacke_drag_from", r.estimate.drag_from);
  visit("knacke_source", r.estimate.source);
  visit("opening_force_coefficient", r.opening_force_coefficient);
  visit("finite_mass_factor", r.finite_mass_factor);
  visit("handbook", r.handbook);
  visit("steps", r.steps);
  visit("step_changes", r.step_changes);
  visit("measured_peak_n", r.settings.measured_peak_n);
  visit("measured_inflation_time_s", r.settings.measured_inflation_time_s);
  visit("printed_peak_n", r.settings.printed_peak_n);
  visit("cluster", r.cluster);
  visit("warnings", r.warnings);
  visit("usable", r.usable);
}
std::string to_json(const InflationResult& result);

/// All of an opening so far.
struct InflationHistory {
  std::vector<HistoryRow> rows;
  std::vector<InflationFrame> frames;
  std::vector<AirRow> air;             // a step of the air each; none under a uniform pressure
  std::vector<OpeningBodyRow> bodies;  // of the rigid bodies in these steps
  std::vector<CanopyRow> canopies;     // of a cluster: after every block a row for each canopy
};

/// Observer of an opening; functions that are not overridden do nothing.
class InflationObserver {
 public:
  virtual ~InflationObserver() = default;
  virtual void warned(const std::string&) {}
  /// Before the first block. An observer with an earlier state puts it, and its history, in place of the
  /// folded start.
  virtual void begin(const Opening&, InflationState&, InflationHistory&) {}
  /// After every block, with its rows the last of the history; with `frame` where one ends.
  virtual void advanced(const Opening&, const InflationState&, const InflationHistory&,
                        const InflationFrame* /*frame*/) {}
  virtual void ended(const Opening&, const InflationState&, const InflationHistory&, const InflationResult&) {
  }
};

struct InflationSolution {
  InflationResult result;
  InflationState state;
  InflationHistory history;
};

/// Warnings of an opening before the computation: a start at the rate of descent, and cells of the flow that are too
/// coarse for the canopy.
std::vector<std::string> opening_warnings(const Settings& resolved, const Opening& solver);

/// How long cloth and air of an opening will take on one thread, about, at the step that it begins with [s].
double opening_seconds(const Opening& solver, const InflationState& start);

/// A coupled inflation has the flow engine of the case; others are left unchanged.
InflationProblem with_engine(const Settings& resolved, InflationProblem problem);

/// The whole opening of the case under the pressure, or in the air, of `problem`. Throws as Opening.
InflationSolution run_inflation(const Settings& resolved, const LoadSource& source, InflationProblem problem,
                                InflationObserver& observer);

}  // namespace ripstop::inline run
