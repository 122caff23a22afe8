// One case solved steady, in memory: the computation of `ripstop steady` without folder and terminal.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/canopy/stress.h"
#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/flow.h"
#include "ripstop/fsi/steady_loop.h"
#include "ripstop/run/margins.h"

namespace ripstop::inline run {

/// Axial forces that have to agree [N].
struct Ledger {
  double fluid_force = 0, nodal_load = 0, line_tension = 0, momentum_deficit = 0;
};
template <Of<Ledger> T, class Visit>
void each_member(T& ledger, Visit&& visit) {
  visit("fluid_force_n", ledger.fluid_force);
  visit("nodal_load_n", ledger.nodal_load);
  visit("line_tension_n", ledger.line_tension);
  visit("momentum_deficit_n", ledger.momentum_deficit);
}

template <Of<Measured> T, class Visit>
void each_member(T& row, Visit&& visit) {
  visit("nominal_speed_m_s", row.nominal_speed_m_s);
  visit("measured_speed_m_s", row.measured_speed_m_s);
  visit("density_kg_m3", row.density_kg_m3);
  visit("drag_n", row.drag_n);
  visit("printed_nonlinear_n", row.printed_nonlinear_n);
  visit("printed_linear_n", row.printed_linear_n);
}

/// Averages of an unsteady run and their uncertainty.
struct UnsteadyResult {
  WindowAverage watched;                 // the last watch
  std::optional<double> standard_error;  // of the mean drag [N]; absent: not known
  double strouhal = 0;  // of the side force's strongest frequency, with the inflated diameter
};
template <Of<UnsteadyResult> T, class Visit>
void each_member(T& u, Visit&& visit) {
  visit("drag_standard_error_n", u.standard_error, or_null);
  visit("strouhal", u.strouhal);
  visit("watched", u.watched);
}
/// Equilibrium of drag and weight of a run with a payload.
struct HeldPayload {
  double mass = 0, parachute_mass = 0;  // [kg]
  double weight = 0;                    // of both [N]
  double own_drag = 0;                  // of the payload itself [N]
  double drag_over_weight = 0;          // of both drags, 1 within payload_tolerance
  int speeds = 0;                       // that were tried
};
template <Of<HeldPayload> T, class Visit>
void each_member(T& p, Visit&& visit) {
  visit("mass_kg", p.mass);
  visit("parachute_mass_kg", p.parachute_mass);
  visit("weight_n", p.weight);
  visit("payload_drag_n", p.own_drag);
  visit("drag_over_weight", p.drag_over_weight);
  visit("speeds_tried", p.speeds);
}
/// The part of the box in which the flow was solved.
struct SolvedDomain {
  std::string part;                 // "quarter" or "full"
  std::string because;              // why the full one; empty for a quarter
  std::optional<double> asymmetry;  // of the shape in a quarter: mirror_gap() [m]
};
template <Of<SolvedDomain> T, class Visit>
void each_member(T& d, Visit&& visit) {
  visit("part", d.part);
  visit("reason", d.because);
  visit("canopy_asymmetry_m", d.asymmetry);
}
/// Loads on a rigid body of the case.
struct BodyResult {
  std::string name;
  double drag = 0, side = 0;                        // along the stream and across it [N]
  Vec3 moment;                                      // about the middle of its aft end [N m]
  double reference_area = 0, drag_coefficient = 0;  // [m2], -
  std::optional<double> standard_error;             // of the mean drag of an unsteady run [N]
};
template <Of<BodyResult> T, class Visit>
void each_member(T& b, Visit&& visit) {
  visit("name", b.name);
  visit("drag_n", b.drag);
  visit("side_force_n", b.side);
  visit("moment_n_m", b.moment);
  visit("reference_area_m2", b.reference_area);
  visit("drag_coefficient", b.drag_coefficient);
  visit("drag_standard_error_n", b.standard_error);
}
/// Loads on one canopy of a cluster.
struct ClusterCanopy {
  std::optional<double> size_ratio;  // over the largest canopy; absent: all are equal
  double azimuth_deg = 0;            // about the axis of the cluster, from x
  double drag = 0;                   // along the stream [N]
  double force = 0;                  // its magnitude, the load of the riser [N]
  double spreading_moment = 0;    // about the confluence, positive where it increases the spread angle [N m]
  double max_line_tension = 0;    // [N]
  double projected_diameter = 0;  // along its own axis [m]
};
template <Of<ClusterCanopy> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("size_ratio", c.size_ratio);
  visit("azimuth_deg", c.azimuth_deg);
  visit("drag_n", c.drag);
  visit("riser_load_n", c.force);
  visit("spreading_moment_n_m", c.spreading_moment);
  visit("max_line_tension_n", c.max_line_tension);
  visit("projected_diameter_m", c.projected_diameter);
}
/// Of a case with a cluster.
struct ClusterResult {
  double spread_angle_deg = 0;
  /// Mean over the canopies: the angle between the force at the centre of the skirt and the axis of the canopy,
  /// positive where the force is inclined outward and spreads the cluster; zero in equilibrium [deg].
  double force_angle_deg = 0;
  double gap = 0;                        // smallest distance between two canopies, at least [m]
  double difference = 0;                 // of the largest and smallest riser load on an area, over the mean
  std::optional<double> cluster_factor;  // C_D over that of one canopy, where the case gives that
  /// Of a run that searches for the equilibrium: its steady solutions in turn, the last one is that of the result.
  std::optional<std::vector<SpreadTrial>> search;
  std::vector<ClusterCanopy> canopies;
  Margins one_failed;  // of the canopies that remain when one fails and they carry the same load
};
template <Of<ClusterResult> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("spread_angle_deg", c.spread_angle_deg);
  visit("force_angle_deg", c.force_angle_deg);
  visit("gap_m", c.gap);
  visit("riser_load_difference", c.difference);
  visit("cluster_factor", c.cluster_factor);
  visit("spread_search", c.search);
  visit("canopies", c.canopies);
  visit("margins_one_failed", c.one_failed);
}
/// Of a search: largest mean force angle in equilibrium [deg], and number of solutions (assumed). The force angle of a
/// flow that does not come to rest changes by up to 1.5 degrees from one iteration to the next.
inline constexpr double equilibrium_tolerance = 0.5;
inline constexpr std::size_t most_spread_trials = 8;
/// The force of each canopy points along its axis.
bool in_equilibrium(const ClusterResult& cluster);
/// The search tried the allowed number of spread angles, and none of them is that of equilibrium.
bool search_failed(const ClusterResult& cluster);

/// Of the drag to the weight, relative; of the speed it is half. Half of the default tolerance on the change of drag:
/// the coupling does not resolve less.
inline constexpr double payload_tolerance = 2.5e-3;

/// The numbers of one run: result.json.
struct SteadyResult {
  std::string title;
  std::optional<std::string> inputs_hash;                       // of a run in a folder: that of its run.json
  double speed = 0, density = 0;                                // [m/s], [kg/m3]
  double approach_speed = 0;                                    // approach speed, fsi/approach.h [m/s]
  double drag = 0, drag_area = 0, drag_coefficient = 0;         // [N], [m2], -
  double reference_area = 0;                                    // S0 [m2]
  std::optional<std::array<double, 2>> known_drag_coefficient;  // Knacke's range of the type
  CanopySize size;
  double max_line_tension = 0;  // [N]
  StressPeak stress;
  int iterations = 0;
  double wall_time = 0;  // of the run, earlier parts of a resumed one included [s]
  bool converged = false;
  std::optional<FirstEstimate> first_estimate;  // absent where none was made
  double transfer_factor = 0, load_remainder = 0, axial_moment = 0, section_gap = 0;
  Ledger ledger;
  std::optional<SolvedDomain> domain;  // absent in results of earlier versions
  std::optional<UnsteadyResult> unsteady;
  std::optional<HeldPayload> payload;                // of a case with one
  std::optional<std::vector<BodyResult>> bodies;     // of a case with rigid bodies
  std::optional<ClusterResult> cluster;              // of a case with a cluster
  std::optional<Margins> margins;                    // absent in results of earlier versions
  std::optional<Measured> measured;                  // the case's row for this speed
  std::optional<std::vector<std::string>> warnings;  // absent likewise, as is `usable`
  std::optional<bool> usable;                        // false: a quality limit that must hold does not
  SteadyIteration last;                              // a row of iterations.csv; not in result.json
};
template <Of<SteadyResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("inputs_hash", r.inputs_hash);
  visit("speed_m_s", r.speed, in_table);
  visit("approach_speed_m_s", r.approach_speed, in_table);
  visit("density_kg_m3", r.density, in_table);
  visit("drag_n", r.drag, in_table);
  visit("drag_area_m2", r.drag_area, in_table);
  visit("drag_coefficient", r.drag_coefficient, in_table);
  visit("reference_area_m2", r.reference_area, in_table);
  visit("known_drag_coefficient", r.known_drag_coefficient);
  visit("projected_diameter_m", r.size.projected_diameter, in_table);
  visit("projected_area_m2", r.size.projected_area);
  visit("skirt_diameter_m", r.size.skirt_diameter, in_table);
  visit("canopy_length_m", r.size.length, in_table);
  visit("max_line_tension_n", r.max_line_tension, in_table);
  visit("max_von_mises_n_m", r.stress.von_mises, in_table);
  visit("max_von_mises_at_m", r.stress.place);
  visit("max_von_mises_on", r.stress.patch);
  visit("max_cloth_strain", r.stress.strain);
  sewing_members(r.stress, visit);
  visit("coupling_iterations", r.iterations, in_table);
  visit("wall_time_s", r.wall_time, in_table);
  visit("converged", r.converged);
  visit("first_estimate", r.first_estimate);
  visit("transfer_factor", r.transfer_factor);
  visit("load_remainder", r.load_remainder);
  visit("axial_moment_n_m", r.axial_moment);
  visit("section_gap", r.section_gap);
  visit("ledger", r.ledger);
  visit("flow_domain", r.domain);
  visit("unsteady", r.unsteady);
  visit("payload", r.payload);
  visit("bodies", r.bodies);
  visit("cluster", r.cluster);
  visit("margins", r.margins);
  visit("measured", r.measured);
  visit("warnings", r.warnings);
  visit("usable", r.usable);
}
std::string to_json(const SteadyResult& result);
/// Throws Error(resources) when this machine has not the memory for a steady run of the case.
void require_steady_memory(const Settings& resolved);
/// Throws Error(bad_data) when `json` is no result of a steady run.
SteadyResult steady_result_from_json(const std::string& json);

/// A run under way, as its observers see it.
struct SteadyRun {
  const Settings& resolved;
  SteadySolver& solver;
  std::string engine;  // name and version
};

/// From one spread angle of a cluster to the next.
struct SteadyTurn {
  SpreadTrial from;
  double to = 0;  // [deg]
};

/// Observer of a run; functions that are not overridden do nothing.
class SteadyObserver {
 public:
  virtual ~SteadyObserver() = default;
  /// Before the first iteration. An observer with an earlier state puts it in place of the cold start, and
  /// restores the flow that belongs to it.
  virtual void begin(const SteadyRun&, SteadyState&) {}
  /// The run starts from this result on coarser cells.
  virtual void solved_coarse(const SteadyRun&, const SteadyResult&) {}
  /// Failures that did not stop the run.
  virtual void warned(const std::string&) {}
  virtual void progress(const SteadyProgress&, const SteadyState&) {}
  virtual void iterated(const SteadyRun&, const SteadyState&, const FlowField&) {}
  /// The search for the spread angle of a cluster has a solution at one more angle, and continues at that of the state.
  virtual void turned(const SteadyTurn&) {}
  virtual void ended(const SteadyRun&, const SteadyState&, const SteadyResult&) {}
};

struct SteadySettings {
  int threads = 0;                    // of this run; 0: coupling.threads
  std::filesystem::path flow_folder;  // of an engine that writes files; empty: a temporary one
  std::filesystem::path hostfile;     // for MPI; empty: none
  /// In place of the canopy of the case (parachute/own_mesh.h); null: none. Coefficients refer to its cloth as cut.
  std::shared_ptr<const CanopyMesh> mesh = nullptr;
};

struct SteadySolution {
  SteadyResult result;
  SteadyState state;
  FlowField flow;  // round the final shape; empty when the observer's state was already the last
};

/// Runs to the end of the coupling; a converged result is not promised. Touches no file, but for an
/// engine's that needs them. Throws as SteadySolver and the flow engine do.
SteadySolution run_steady(const Settings& resolved, SteadyObserver& observer,
                          const SteadySettings& settings = {});

/// The same of a case.
inline SteadySolution run_steady(const Case& given, SteadyObserver& observer,
                                 const SteadySettings& settings = {}) {
  return run_steady(resolve(given), observer, settings);
}

/// For SteadyObserver::begin(): the shape in which a run of `other` ended, moved to this case's place, under
/// its pressure at this case's q. Another mesh starts cold. Returns whether the flow of that run fits too.
bool start_from(const Settings& other, const SteadyState& end, const SteadyRun& run, SteadyState& state);

}  // namespace ripstop::inline run
