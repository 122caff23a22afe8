// Which parachute lets a payload down at a wanted rate: `ripstop size`.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/case.h"
#include "ripstop/core/members.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/run/descent/flown.h"
#include "ripstop/run/flight/flight.h"
#include "ripstop/run/opening/load.h"
#include "ripstop/run/steady/steady.h"

namespace ripstop::inline run {

/// The drag of a family as Ripstop has computed it: a row of examples/families.json.
struct FamilyDrag {
  std::string family, type;     // the example's folder, the word in [parachute]
  double drag_coefficient = 0;  // axial, on S0
  std::optional<std::array<double, 2>> handbook;
  double speed = 0, density = 0;        // of that run [m/s], [kg/m3]
  std::string made;                     // command and machine
  double projected_ratio = 0;           // projected over nominal diameter in that run
  std::optional<FlownDrag> flown = {};  // in descent, with the cloth of the example
};

/// Which coefficient sizes a parachute. safe: the smaller one of axial and flown, the latter less two standard errors, so
/// that the rate of descent is not above the wanted one by either of them.
enum class DragBasis { safe, axial, descent };
/// Throws Error(io) when the file is missing, Error(bad_data) when it is broken.
std::vector<FamilyDrag> family_drags();

/// Area of a drag coefficient: S0, or that of the circle of the open canopy, spill hole included.
enum class DragReference { nominal, projected };

struct SizeRequest {
  double payload_mass = 0;  // [kg]
  double descent_rate = 0;  // [m/s]
  std::string family = "flat-circular";
  double height = 0;              // above sea level, where the rate is wanted [m]
  std::optional<double> density;  // in place of the height [kg/m3]
  std::optional<double> drag_coefficient;
  std::optional<double> deployment_speed;  // for the opening load [m/s]; absent: 20 m/s, or 3 descent rates
  std::optional<std::string> line_material;
  double packing_density = packed_by_hand;  // [kg/m3]
  DragBasis basis = DragBasis::safe;
  DragReference drag_coefficient_on = DragReference::nominal;
};

/// One run of --verify.
struct SizeCheck {
  double nominal_diameter = 0, descent_rate = 0, drag_coefficient = 0;  // [m], [m/s], -
  std::string basis;                                                    // "axial" or "descent"
  std::optional<double> descent_rate_error;                             // of a flight [m/s]
};
template <Of<SizeCheck> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("nominal_diameter_m", c.nominal_diameter);
  visit("descent_rate_m_s", c.descent_rate);
  visit("drag_coefficient", c.drag_coefficient);
  visit("drag_coefficient_basis", c.basis);
  visit("descent_rate_standard_error_m_s", c.descent_rate_error);
}

/// Result of a run of --verify, on the axis or in flight.
struct VerifiedDescent {
  VerifiedDescent(const SteadyResult& run)  // NOLINT(google-explicit-constructor): either result
      : speed(run.speed),
        coefficient(run.drag_coefficient),
        usable(run.converged && run.usable.value_or(true)),
        warnings(run.warnings.value_or(std::vector<std::string>{})) {}
  /// Not usable without a mean.
  VerifiedDescent(const FlightResult& flight);  // NOLINT(google-explicit-constructor)
  double speed = 0, coefficient = 0;            // [m/s]
  std::optional<double> speed_error;            // standard error of a flight [m/s]
  bool usable = false;
  bool flown = false;
  std::vector<std::string> warnings;  // of the run
};

/// result.json of `ripstop size`, without its case file.
struct SizeResult {
  std::string family, type;
  double payload_mass = 0, descent_rate = 0;
  double height = 0, density = 0;  // of descent and opening, above sea level [m], [kg/m3]
  std::string air_source;
  double drag_coefficient = 0;
  std::string drag_basis, drag_source;                   // "axial", "descent" or "given"; where it comes from
  double axial_coefficient = 0;                          // of the family, in steady flow
  std::optional<double> flown_coefficient, flown_error;  // of the family, in descent
  std::optional<std::array<double, 2>> handbook_drag_coefficient;
  std::optional<std::array<double, 2>> handbook_diameter;  // that its range gives, the largest first [m]
  double nominal_diameter = 0, nominal_area = 0, vent_area = 0;  // [m], [m2]
  int gores = 0, line_count = 0;
  double line_length = 0;    // [m]
  std::string gores_source;  // why there are more gores than in the example; empty: there are as many
  std::string line_material, tape_material, tape_source, canopy_material;
  double parachute_mass = 0, cloth_mass = 0, tape_mass = 0, line_mass = 0;  // [kg]
  double packed_volume = 0;                                                 // [m3]
  double deployment_speed = 0;                                              // [m/s]
  double opening_load = 0, opening_load_low = 0;  // range of the methods that apply [N]
  std::optional<double> lowest_finite_mass_load,
      highest_finite_mass_load;  // without the infinite-mass load [N]
  double design_load = 0;        // as of run_load() [N]
  std::string design_load_from;
  std::string design_load_caution;  // as of run_load(); not in result.json
  double load_uncertainty = 0;      // of it, relative
  std::string load_uncertainty_from;
  double highest_design_load = 0;         // lines, riser, and tape or hem are chosen for it [N]
  std::optional<double> smallest_margin;  // of safety, of the weakest member under the highest design load
  std::string smallest_margin_member;
  double line_load_factor = 1;             // largest line load over an equal share
  std::optional<Margins> margins;          // of tape or hem, lines and riser under the design load
  std::optional<Margins> highest_margins;  // the same under the highest design load
  double line_used = 0;                    // utilisation of the weakest line under the highest design load
  double tape_used = 0;                    // the same of the tape, or of the hem in its place
  std::vector<SizeCheck> checks;
  std::vector<StageLoads> opening;                   // by every method
  std::vector<FlightRow> flight;                     // of that opening; not in result.json
  std::vector<std::string> warnings, load_warnings;  // all; those of the opening alone, not in result.json
  Case given;                                        // the parachute
  std::string case_text;                             // as a file, with comments
};
template <Of<SizeResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("family", r.family);
  visit("type", r.type);
  visit("payload_mass_kg", r.payload_mass);
  visit("descent_rate_m_s", r.descent_rate);
  visit("height_m", r.height);
  visit("density_kg_m3", r.density);
  visit("air_from", r.air_source);
  visit("drag_coefficient", r.drag_coefficient);
  visit("drag_coefficient_basis", r.drag_basis);
  visit("drag_coefficient_from", r.drag_source);
  visit("axial_drag_coefficient", r.axial_coefficient);
  visit("descent_drag_coefficient", r.flown_coefficient);
  visit("descent_drag_coefficient_standard_error", r.flown_error);
  visit("handbook_drag_coefficient", r.handbook_drag_coefficient);
  visit("handbook_diameter_m", r.handbook_diameter);
  visit("nominal_diameter_m", r.nominal_diameter);
  visit("nominal_area_m2", r.nominal_area);
  visit("vent_area_m2", r.vent_area);
  visit("gores", r.gores);
  visit("line_count", r.line_count);
  visit("gores_from", r.gores_source);
  visit("line_length_m", r.line_length);
  visit("line_material", r.line_material);
  visit("tape_material", r.tape_material);
  visit("tape_material_from", r.tape_source);
  visit("canopy_material", r.canopy_material);
  visit("parachute_mass_kg", r.parachute_mass);
  visit("cloth_mass_kg", r.cloth_mass);
  visit("tape_mass_kg", r.tape_mass);
  visit("line_mass_kg", r.line_mass);
  visit("packed_volume_m3", r.packed_volume);
  visit("deployment_speed_m_s", r.deployment_speed);
  visit("opening_load_n", r.opening_load);
  visit("opening_load_low_n", r.opening_load_low);
  visit("lowest_finite_mass_load_n", r.lowest_finite_mass_load);
  visit("highest_finite_mass_load_n", r.highest_finite_mass_load);
  visit("design_load_n", r.design_load);
  visit("design_load_from", r.design_load_from);
  visit("load_uncertainty", r.load_uncertainty);
  visit("load_uncertainty_from", r.load_uncertainty_from);
  visit("highest_design_load_n", r.highest_design_load);
  visit("smallest_margin_of_safety", r.smallest_margin);
  visit("smallest_margin_member", r.smallest_margin_member);
  visit("line_load_factor", r.line_load_factor);
  visit("margins", r.margins);
  visit("margins_under_highest_design_load", r.highest_margins);
  visit("line_used", r.line_used);
  visit("tape_used", r.tape_used);
  visit("checks", r.checks);
  visit("opening", r.opening);
  visit("warnings", r.warnings);
}
std::string to_json(const SizeResult& result);

/// The example of the family with all lengths in proportion. Throws Error(usage) for an unknown family, for
/// quantities that are not above 0, and if no size that a case file can describe has the descent rate.
SizeResult run_size(const SizeRequest& request);

/// Settings of a free flight of a sized parachute, on the flight's own cells.
Settings sized_flight(const Settings& sized, double duration_s);

/// Runs the case until its descent rate is the wanted one within `tolerance`, changing the diameter: v goes with
/// 1 / D_0. The rate of a flight is known to its standard error only, which widens the tolerance. Throws
/// Error(not_converged) when a run cannot be used or four of them do not get there.
void verify_size(const SizeRequest& request, SizeResult& result,
                 const std::function<VerifiedDescent(const Settings&, int run)>& fly,
                 double tolerance = 0.01);

}  // namespace ripstop::inline run
