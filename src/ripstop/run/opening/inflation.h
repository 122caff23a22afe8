// One opening in memory: what `ripstop inflate` does beneath its folder and its terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/opening.h"
#include "ripstop/core/members.h"
#include "ripstop/fsi/opening_estimate.h"
#include "ripstop/fsi/summary.h"
#include "ripstop/run/margins.h"

namespace ripstop {

/// The numbers of one opening: result.json.
struct InflationResult {
  std::string title;
  std::optional<std::string> inputs_hash;  // of a run in a folder: that of its run.json
  double peak_load = 0, peak_time = 0;     // over every step [N], [s]
  std::optional<double> low_pass;          // cutoff [Hz]; absent, as what follows from it: none asked for
  std::optional<double> smooth_peak;       // low-passed [N]
  std::optional<double> smooth_peak_time;  // [s]
  std::optional<double> smooth_overshoot;  // over the steady load
  InflationSummary summary;
  std::optional<std::vector<StageSummary>> stages;  // of a reefed opening
  bool settled = false;                             // the steady load is one: settled() of the summary
  double overshoot = 0;                             // peak over steady load
  double impulse = 0;                               // [N s]
  std::optional<double> pressure;                   // uniform [Pa]
  std::optional<double> drag_area;                  // C_D S in the air, the largest of a step [m2]
  std::optional<double> added_mass;                 // of the canopy at the end [kg]
  std::optional<double> end_speed, end_angle;       // of a payload that flies [m/s], of its path [deg]
  std::optional<double> height_lost;                // by it since deployment [m]
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
  double break_load = 0;   // of the cloth [N/m]; 0: unknown; not in result.json
  std::optional<Margins> margins;
  std::optional<double> cloth_margin;  // break load over the higher of both yarns' forces
  double energy_residual = 0;          // largest |residual| of all frames after the first tenth of the work
  double contact_depth = 0, pierced = 0;  // largest of all frames, see InflationFrame
  OpeningEstimate estimate;
  long long steps = 0;
  int step_changes = 0;
};
template <Of<InflationResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("peak_load_n", r.peak_load);
  visit("peak_time_s", r.peak_time);
  visit("low_pass_hz", r.low_pass);
  visit("low_pass_peak_load_n", r.smooth_peak);
  visit("low_pass_peak_time_s", r.smooth_peak_time);
  visit("low_pass_overshoot", r.smooth_overshoot);
  visit("inflation_time_s", r.summary.inflation_time, or_null);
  visit("filling_time_s", r.summary.filling_time);
  visit("settling_time_s", r.summary.settling_time);
  visit("steady_load_n", r.summary.steady_load);
  visit("steady_load_deviation", r.summary.unsteadiness);
  visit("stages", r.stages);
  visit("settled", r.settled);
  visit("overshoot", r.overshoot);
  visit("impulse_n_s", r.impulse);
  visit("pressure_pa", r.pressure);
  visit("drag_area_peak_m2", r.drag_area);
  visit("added_mass_kg", r.added_mass);
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
  visit("cloth_margin", r.cloth_margin);
  visit("margins", r.margins);
  visit("energy_residual", r.energy_residual);
  visit("contact_depth", r.contact_depth);
  visit("pierced_edges", r.pierced);
  visit("knacke_load_n", r.estimate.load);
  visit("knacke_coefficient", r.estimate.coefficient);
  visit("knacke_source", r.estimate.source);
  visit("steps", r.steps);
  visit("step_changes", r.step_changes);
  visit("measured_peak_n", r.settings.measured_peak_n);
  visit("measured_inflation_time_s", r.settings.measured_inflation_time_s);
  visit("printed_peak_n", r.settings.printed_peak_n);
}
std::string to_json(const InflationResult& result);

/// All of an opening so far.
struct InflationHistory {
  std::vector<HistoryRow> rows;
  std::vector<InflationFrame> frames;
  std::vector<AirRow> air;  // a step of the air each; none under a uniform pressure
};

/// Told of an opening as it goes; what it is not interested in, it leaves out.
class InflationObserver {
 public:
  virtual ~InflationObserver() = default;
  virtual void warned(const std::string&) {}
  /// Before the first block. An observer that knows an earlier state puts it, and its history, in the place
  /// of the folded start.
  virtual void begin(const Inflation&, InflationState&, InflationHistory&) {}
  /// After every block, with its rows the last of the history; with `frame` where one ends.
  virtual void advanced(const Inflation&, const InflationState&, const InflationHistory&,
                        const InflationFrame* /*frame*/) {}
  virtual void ended(const Inflation&, const InflationState&, const InflationHistory&,
                     const InflationResult&) {}
};

struct InflationSolution {
  InflationResult result;
  InflationState state;
  InflationHistory history;
};

/// How long an opening will take on one thread, about, at the step that it begins with [s].
double opening_seconds(const Inflation& solver, const InflationState& start);

/// An opening in its own air has the case's flow engine; others are left as they are.
InflationProblem with_engine(const Case& given, InflationProblem problem);

/// The whole opening of the case under the pressure, or in the air, of `problem`. Throws as Inflation.
InflationSolution run_inflation(const Case& given, const LoadSource& source, InflationProblem problem,
                                InflationObserver& observer);

}  // namespace ripstop
