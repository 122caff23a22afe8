// Coefficients of a canopy over the angle of attack: the canopy keeps the shape of its steady run on the axis and stays
// on the cells, and the stream comes at the angle.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/flow/engines.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/projections.h"
#include "ripstop/flow/unsteady.h"
#include "ripstop/fsi/steady_state.h"
#include "ripstop/parachute/canopy_mesh.h"

namespace ripstop::inline run {

/// The largest angle of attack that a run takes [degrees], and the most angles.
inline constexpr double largest_angle = 90;
inline constexpr int most_angles = 200;

/// "0:40:5": from, to and step, "20": one angle. Rising [degrees]. Throws Error(usage) for another text, a step that is
/// not positive, angles that fall, lie outside 0 to `largest_angle` or are more than `most_angles`.
std::vector<double> angles_of_text(const std::string& text);
/// The same rules for a list. Throws Error(usage).
void check_angles(const std::vector<double>& angles);

/// The case with each angle as flow.angle_of_attack_deg. Throws Error(usage) for a case with an angle of its own, a
/// wind tunnel, boundaries that a stream at an angle cannot have, cloth as porous cells, or an engine without far
/// field.
std::vector<Settings> stability_cases(const Case& given, const std::vector<double>& angles);

/// The canopy as the flow sees it.
struct RigidCanopy {
  std::vector<Triangle> surface;
  Vec3 confluence;   // [m]
  double width = 0;  // projected diameter [m]
};
/// Nodes of a steady run of `resolved`.
RigidCanopy rigid_canopy(const Settings& resolved, const std::vector<Vec3>& shape);

/// The mesh of that run with the vent and the confluence fixed where they are in `state`: the axis keeps its direction.
CanopyMesh restrained_mesh(const Settings& resolved, const SteadyState& state);

/// Cells for all angles up to the widest one: `across` of them over the projected diameter, in a core that contains the
/// canopy and one diameter of its wake at any of the angles. Far field on all six faces, four and a half widths away.
FlowProblem stability_flow(const Settings& at_angle, const RigidCanopy& canopy, int across, double widest);

/// Reference quantities of coefficients: density, S0 and D0.
Reference stability_reference(const Settings& resolved);

/// Mean loads on a rigid body of the case at one angle.
struct StabilityBody {
  std::string name;
  double drag = 0;                       // along the stream [N]
  std::optional<double> standard_error;  // of it; absent where the flow is steady [N]
  Vec3 force;                            // in the axes of the canopy, z from the confluence to the canopy [N]
  Vec3 moment;                           // about the middle of its aft end, likewise [N m]
};
template <Of<StabilityBody> T, class Visit>
void each_member(T& b, Visit&& visit) {
  visit("name", b.name);
  visit("drag_n", b.drag);
  visit("drag_standard_error_n", b.standard_error, or_null);
  visit("force_n", b.force);
  visit("moment_n_m", b.moment);
}

/// The numbers of one angle. Coefficients refer to S0 and D0, the moment is about the confluence. A standard error is
/// absent where the flow is steady.
struct StabilityRow {
  double angle = 0;                  // of attack [degrees]
  double c_t = 0, c_n = 0, c_m = 0;  // C_T, C_N, C_m: flow/projections.h
  std::optional<double> c_t_error, c_n_error, c_m_error;
  double c_d = 0, c_l = 0, c_y = 0;  // drag, lift and side force on the stream's axes
  std::optional<double> c_d_error, c_l_error, c_y_error;
  double time = 0, start_up = 0;      // of the averaging window, and the part that was discarded [s]
  int steps = 0;                      // in time, or iterations
  bool enough = false;                // the standard error of the drag, or the residual, was reached
  std::optional<double> mass_defect;  // of a flow in time: largest of a step after the start-up
  std::optional<std::vector<StabilityBody>> bodies;  // of a case with rigid bodies
};
template <Of<StabilityRow> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("angle_deg", r.angle);
  visit("c_t", r.c_t);
  visit("c_n", r.c_n);
  visit("c_m", r.c_m);
  visit("c_t_standard_error", r.c_t_error, or_null);
  visit("c_n_standard_error", r.c_n_error, or_null);
  visit("c_m_standard_error", r.c_m_error, or_null);
  visit("c_d", r.c_d);
  visit("c_l", r.c_l);
  visit("c_y", r.c_y);
  visit("c_d_standard_error", r.c_d_error, or_null);
  visit("c_l_standard_error", r.c_l_error, or_null);
  visit("c_y_standard_error", r.c_y_error, or_null);
  visit("time_s", r.time);
  visit("start_up_s", r.start_up);
  visit("steps", r.steps);
  visit("enough", r.enough);
  visit("mass_defect", r.mass_defect, or_null);
  visit("bodies", r.bodies);
}

/// An angle at which C_m = 0.
struct Trim {
  double angle = 0;                      // [degrees]
  std::optional<double> standard_error;  // of the angle [degrees]; absent on the axis, by symmetry
  bool stable = false;                   // dC_m/dalpha < 0
  bool certain = false;  // C_m on each side of the angle differs from 0 by more than two standard errors
};
template <Of<Trim> T, class Visit>
void each_member(T& t, Visit&& visit) {
  visit("angle_deg", t.angle);
  visit("standard_error_deg", t.standard_error, or_null);
  visit("stable", t.stable);
  visit("certain", t.certain);
}

/// Trim angles of rows with rising angles: between two rows by linear interpolation of C_m. A row at 0 degrees is a
/// trim by the symmetry of the canopy, and the next row decides whether it is stable.
std::vector<Trim> trims_of(const std::vector<StabilityRow>& rows);

/// result.json of `ripstop stability`.
struct StabilityResult {
  std::string title;
  double speed = 0, density = 0;                    // [m/s], [kg/m3]
  double reference_area = 0, reference_length = 0;  // S0 [m2], D0 [m]
  double projected_diameter = 0;                    // of the rigid shape [m]
  int cells_across = 0;                             // the projected diameter
  int cells = 0;                                    // of the flow
  std::vector<StabilityRow> rows;                   // of the angles that have ended
  std::vector<Trim> trims;
  std::vector<double> trim_angles, stable_trim_angles;  // [degrees]
  std::vector<std::string> warnings;
  bool usable = true;  // false: a row, or the steady run on the axis, is beyond a limit of quality
};
template <Of<StabilityResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("speed_m_s", r.speed);
  visit("density_kg_m3", r.density);
  visit("reference_area_m2", r.reference_area);
  visit("reference_length_m", r.reference_length);
  visit("projected_diameter_m", r.projected_diameter);
  visit("cells_across", r.cells_across);
  visit("flow_cells", r.cells);
  visit("angles", r.rows);
  visit("trims", r.trims);
  visit("trim_angles_deg", r.trim_angles);
  visit("stable_trim_angles_deg", r.stable_trim_angles);
  visit("warnings", r.warnings);
  visit("usable", r.usable);
}
/// Fills trims and warnings from the rows.
void take_trims(StabilityResult& result);
std::string to_json(const StabilityResult& result);

/// Turns the stream of a flow in time from one velocity to another, over the time in which it passes `length`: the
/// velocity changes in the far field and, as in a frame that accelerates, in all of the air.
void turn_stream(Flow& flow, Vec3 from, Vec3 to, double length, double courant);

/// One angle [degrees] from an averaging window: means of the coefficients of the canopy, which is the first body, and
/// of the loads on the others, without the start-up.
StabilityRow row_of_record(const FlowRecord& record, const FlowProblem& problem, double angle,
                           const Reference& reference);
/// The same from a steady flow.
StabilityRow row_of_field(const FlowField& field, const FlowProblem& problem, double angle,
                          const Reference& reference);

}  // namespace ripstop::inline run
