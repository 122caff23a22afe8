#include "ripstop/core/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace ripstop {
namespace {

struct Ending {
  std::string_view key, unit;
};
// The longer ones first: the first that fits is taken.
constexpr Ending endings[] = {
    {"_pa_s2_m2", "Pa s²/m²"},
    {"_n_s2_m4", "N s²/m⁴"},
    {"_pa_s_m", "Pa s/m"},
    {"_n_per_m", "N/m"},
    {"_m_per_s", "m/s"},
    {"_per_m2", "1/m²"},
    {"_1_m2", "1/m²"},
    {"_n_s_m3", "N s/m³"},
    {"_kg_m3", "kg/m³"},
    {"_kg_m2", "kg/m²"},
    {"_per_m", "1/m"},
    {"_1_m", "1/m"},
    {"_kg_m", "kg/m"},
    {"_n_m2", "N/m²"},
    {"_m_s2", "m/s²"},
    {"_deg_s", "°/s"},
    {"_per_s", "1/s"},
    {"_pa_m", "Pa/m"},
    {"_n_s", "N s"},
    {"_n_m", "N/m"},
    {"_m_s", "m/s"},
    {"_pa_s", "Pa s"},
    {"_deg", "°"},
    {"_m2", "m²"},
    {"_m3", "m³"},
    {"_mm", "mm"},
    {"_ms", "ms"},
    {"_kg", "kg"},
    {"_hz", "Hz"},
    {"_pa", "Pa"},
    {"_n", "N"},
    {"_m", "m"},
    {"_s", "s"},
    {"_k", "K"},
    {"_j", "J"},
};

// "rate_of_descent_standard_error_m_s": standard error of the rate of descent.
constexpr std::pair<std::string_view, std::string_view> attributes[] = {
    {" standard error", "standard error of the"},
    {" uncertainty", "uncertainty of the"},
    {" from", "source of the"},
};

// Where the key's own words do not do.
const std::map<std::string_view, Wording>& known() {  // NOLINT(readability-function-size): a list
  static const std::map<std::string_view, Wording> words = {
      {"c_t", {"C_T", ""}},
      {"c_n", {"C_N", ""}},
      {"c_m", {"C_m", ""}},
      {"c_d", {"C_D", ""}},
      {"c_l", {"C_L", ""}},
      {"c_y", {"C_Y", ""}},
      {"c_t_standard_error", {"standard error of C_T", ""}},
      {"c_n_standard_error", {"standard error of C_N", ""}},
      {"c_m_standard_error", {"standard error of C_m", ""}},
      {"c_d_standard_error", {"standard error of C_D", ""}},
      {"c_l_standard_error", {"standard error of C_L", ""}},
      {"c_y_standard_error", {"standard error of C_Y", ""}},
      {"angles", {"coefficients over the angle of attack", ""}},
      {"trims", {"trim angles", ""}},
      {"reference_length_m", {"reference length D₀", "m"}},
      {"drag_coefficient", {"drag coefficient", ""}},
      {"computed_area_m2", {"finished cloth, without allowances", "m²"}},
      {"meshed_area_m2", {"cloth as meshed", "m²"}},
      {"resolved_cloth_nodes", {"cloth nodes for an error of the diameter below 1 %", ""}},
      {"printed_step_s", {"stable step by the estimate of [NFM]", "s"}},
      {"projected_over_nominal", {"projected over nominal diameter", ""}},
      {"steady_drag_returned", {"steady load over the given steady drag", ""}},
      {"drag_area_peak_m2", {"largest drag area of a time step", "m²"}},
      {"line_m", {"length of the reefing line", "m"}},
      {"line_peak_n", {"peak tension of the reefing line", "N"}},
      {"record_peak_load_n", {"peak load with the drag area of the computed opening", "N"}},
      {"used", {"utilisation", ""}},
      {"start_up_s", {"start-up time", "s"}},
      {"ledger", {"force balance", ""}},
      {"watched", {"averaging window", ""}},
      {"inputs_hash", {"hash of the inputs", ""}},
      {"drag_area_m2", {"drag area", "m²"}},
      {"reference_area_m2", {"reference area", "m²"}},
      {"known_drag_coefficient", {"drag coefficient in descent of the handbook (Knacke)", ""}},
      {"max_line_tension_n", {"maximum line tension", "N"}},
      {"max_von_mises_n_m", {"maximum von Mises stress, mean over 50 mm", "N/m"}},
      {"max_von_mises_at_m", {"position of the maximum stress (x, y, z)", "m"}},
      {"max_von_mises_on", {"part with the maximum stress", ""}},
      {"max_von_mises_time_s", {"time of the maximum stress", "s"}},
      {"max_cloth_strain", {"maximum cloth strain", ""}},
      {"max_principal_n_m", {"maximum principal stress, mean over 50 mm", "N/m"}},
      {"max_principal_direction", {"direction of the maximum principal stress (x, y, z)", ""}},
      {"max_warp_n_m", {"maximum yarn force, warp, mean over 50 mm", "N/m"}},
      {"max_weft_n_m", {"maximum yarn force, weft, mean over 50 mm", "N/m"}},
      {"wrinkled_share", {"share of the cloth that is wrinkled", ""}},
      {"slack_share", {"share of the cloth that is slack", ""}},
      {"transfer_factor", {"transfer factor: air load over the force of the pressures on the cloth", ""}},
      {"load_remainder", {"residual traction over the pressure on the cloth", ""}},
      {"axial_moment_n_m", {"moment about the axis", "N m"}},
      {"moment_n_m", {"moment about the centre of the aft end", "N m"}},
      {"spreading_moment_n_m", {"moment that increases the spread angle", "N m"}},
      {"first_spread_angle_deg", {"spread angle at the start", "°"}},
      {"contact_gap_m", {"distance of nodes below which canopies touch", "m"}},
      {"first_contact_s", {"time of the first contact of canopies", "s"}},
      {"contact_time_share", {"share of the time with contact of canopies", ""}},
      {"spread_search", {"solutions of the search for the spread angle", ""}},
      {"section_gap", {"largest section imbalance", ""}},
      {"cloth_hold_pa_m", {"regularisation of the cloth", "Pa/m"}},
      {"cloth_held", {"regularisation forces over the load", ""}},
      {"drag_deviation_n", {"standard deviation of the drag", "N"}},
      {"drag_left", {"estimated relative change of the drag if the flow were iterated further", ""}},
      {"drag_error_n", {"standard error of the drag", "N"}},
      {"enough", {"whether the required standard error is reached", ""}},
      {"in_time", {"whether the iteration has an averaging window", ""}},
      {"flow_averaged", {"number of averaged flow iterations; 0: none", ""}},
      {"printed_tolerance", {"right side of [NFM] Eq. 19", ""}},
      {"knock_down", {"strength reduction factor", ""}},
      {"swing_hz", {"dominant frequency of the side force", "Hz"}},
      {"swing_share", {"share of this frequency in the power of the side force", ""}},
      {"best_is_at_the_edge", {"whether the best value is at the edge of the range", ""}},
      {"certain", {"whether C_m on both sides differs from 0 by more than two standard errors", ""}},
      {"ended_by", {"reason for the end of the flight", ""}},
      {"line_used", {"utilisation of the weakest line under the highest design load", ""}},
      {"half_swings", {"number of half-swings", ""}},
      {"mass_defect", {"largest mass defect of the air in a step, over the mass flux of the stream", ""}},
      {"air_momentum_residual", {"largest residual of the momentum balance of the air, over the weight", ""}},
      {"speeds_tried", {"number of computed speeds", ""}},
      {"oscillation_roundness",
       {"ratio of the principal axes of the oscillation; 0: in a plane, 1: conical", ""}},
      {"fluid_force_n", {"air load", "N"}},
      {"nodal_load_n", {"cloth load (nodes)", "N"}},
      {"line_tension_n", {"line load", "N"}},
      {"momentum_deficit_n", {"momentum deficit", "N"}},
      {"printed_nonlinear_n", {"published nonlinear model", "N"}},
      {"printed_linear_n", {"published linear model", "N"}},
      {"nominal_speed_m_s", {"nominal speed", "m/s"}},
      {"peak_load_n", {"peak load", "N"}},
      {"low_pass_hz", {"low-pass cutoff", "Hz"}},
      {"low_pass_peak_load_n", {"peak load, low-passed", "N"}},
      {"low_pass_peak_time_s", {"time of the low-passed peak", "s"}},
      {"low_pass_overshoot", {"overshoot, low-passed", ""}},
      {"last_load_n", {"load at the end (mean over the last fifth)", "N"}},
      {"last_load_deviation", {"standard deviation of the load at the end, over its mean", ""}},
      {"overshoot", {"overshoot (peak over steady load)", ""}},
      {"steady_drag_asked_n", {"given steady drag", "N"}},
      {"damping_n_s_m3", {"damping", "N s/m³"}},
      {"quadratic_damping_n_s2_m4", {"quadratic damping", "N s²/m⁴"}},
      {"cloth_damping_least_share", {"smallest reduction factor of the cloth damping", ""}},
      {"cloth_damping_reduced_cells", {"share of cells with reduced cloth damping", ""}},
      {"line_damping_s", {"relative damping of lines and tape as a time", "s"}},
      {"cloth_damping_s", {"relative damping of the cloth as a time", "s"}},
      {"step_changes", {"reductions of the time step because of strain", ""}},
      {"start_strain", {"largest strain of the folded start", ""}},
      {"energy_residual", {"largest residual of the energy balance", ""}},
      {"contact_depth", {"largest compression of layers in contact", ""}},
      {"pierced_edges", {"share of edges that pierce cloth", ""}},
      {"start_up_time_s", {"end of the start-up of the flow, excluded from peaks and means", "s"}},
      {"start_up_peak_load_n", {"peak during the start-up of the flow", "N"}},
      {"knacke_load_n", {"infinite-mass opening load C_x C_D S₀ q", "N"}},
      {"knacke_drag_n", {"C_D S₀ q at the speed of deployment", "N"}},
      {"knacke_drag_from", {"source of C_D S₀ q", ""}},
      {"weakest_member", {"weakest member", ""}},
      {"applies", {"whether the method estimates this load", ""}},
      {"margin_of_safety", {"margin of safety", ""}},
      {"smallest_margin_of_safety", {"margin of safety of this member", ""}},
      {"smallest_margin_member", {"weakest member under the highest design load", ""}},
      {"opening_load_n", {"largest opening load of the applicable methods", "N"}},
      {"opening_load_low_n", {"smallest opening load of the applicable methods", "N"}},
      {"lowest_finite_mass_load_n", {"smallest opening load of the finite-mass methods", "N"}},
      {"highest_finite_mass_load_n", {"largest opening load of the finite-mass methods", "N"}},
      {"ledger_gap", {"largest difference of air load, cloth load and line load", ""}},
      {"momentum_deficit_gap", {"difference of momentum deficit and air load", ""}},
      {"momentum_residual", {"relative residual of the momentum balance", ""}},
      {"filling_caution", {"limit of the filling distance", ""}},
      {"gores_from", {"reason for more lines than the example has", ""}},
      {"tape_used", {"utilisation of tape or hem under the highest design load", ""}},
      {"highest_design_load_n", {"highest design load, with the uncertainty", "N"}},
      {"cells_across", {"flow cells across the inflated canopy", ""}},
      {"opening_force_coefficient", {"opening force coefficient C_x, computed", ""}},
      {"finite_mass_factor", {"finite-mass factor X₁", ""}},
      {"filling_distance_diameters", {"filling distance over nominal diameter", ""}},
      {"filled", {"whether the canopy has filled", ""}},
      {"container_left_s", {"time at which the canopy has left its container", "s"}},
      {"canopy_outside", {"share of the canopy's length outside the container at the end", ""}},
      {"area_growth_exponent", {"exponent of the area's growth over time", ""}},
      {"design_load_n", {"design load", "N"}},
      {"design_load_from", {"source of the design load", ""}},
      {"knacke_coefficient", {"opening force coefficient C_x of the handbook (Knacke)", ""}},
      {"knacke_source", {"source of Knacke's coefficient", ""}},
      {"printed_peak_n", {"peak, published model", "N"}},
      {"measured_peak_n", {"measured peak", "N"}},
      {"von_mises_n_per_m", {"von Mises stress", "N/m"}},
      {"von_mises_strip_n_per_m", {"von Mises stress, mean over a strip of 50 mm", "N/m"}},
      {"stress_max_n_per_m", {"first principal stress", "N/m"}},
      {"stress_min_n_per_m", {"second principal stress", "N/m"}},
      {"warp_n_per_m", {"force along the warp", "N/m"}},
      {"weft_n_per_m", {"force along the weft", "N/m"}},
      {"tautness", {"tautness (0 slack, 1 wrinkled, 2 taut)", ""}},
      {"strain_max", {"largest strain", ""}},
      {"pressure_inside_pa", {"pressure inside", "Pa"}},
      {"pressure_outside_pa", {"pressure outside", "Pa"}},
      {"pressure_difference_applied_pa", {"pressure difference on the cloth", "Pa"}},
      {"cp_load", {"cloth load", ""}},
      {"free_tension_n", {"tension below the skirt", "N"}},
      {"largest_tension_n", {"largest tension", "N"}},
  };
  return words;
}

}  // namespace

Wording in_words(const std::string& key) {
  const std::string name = key.substr(key.rfind('.') + 1);
  if (const auto found = known().find(name); found != known().end()) return found->second;
  Wording words{name, ""};
  for (const Ending& ending : endings) {
    if (!name.ends_with(ending.key) || name.size() == ending.key.size()) continue;
    words = {name.substr(0, name.size() - ending.key.size()), std::string(ending.unit)};
    break;
  }
  std::replace(words.text.begin(), words.text.end(), '_', ' ');
  for (const auto& [ending, beginning] : attributes)
    if (words.text.size() > ending.size() && words.text.ends_with(ending))
      return {fmt::format("{} {}", beginning, words.text.substr(0, words.text.size() - ending.size())),
              words.unit};
  return words;
}

std::string in_words(const std::string& key, const std::string& value) {
  if (key == "coupling.linear") return value == "true" ? "linear cloth" : "nonlinear cloth";
  const Wording words = in_words(key);
  if (value == "true" || value == "false") return (value == "true" ? "" : "no ") + words.text;
  return words.text + " " + value + (words.unit.empty() ? "" : " " + words.unit);
}

std::string rounded(double value, int digits) {
  if (!(std::fabs(value) >= std::pow(10, digits) - 0.5 && std::fabs(value) < 1e15))
    return fmt::format("{:.{}g}", value, digits);
  const double step = std::pow(10, std::floor(std::log10(std::fabs(value))) + 1 - digits);
  return fmt::format("{:.0f}", std::round(value / step) * step);
}

std::pair<std::string, std::string> rounded_apart(double value, double limit, int digits) {
  constexpr int all = 17;  // digits of a double
  std::pair<std::string, std::string> texts;
  do texts = {rounded(value, digits), rounded(limit, digits)};
  while (texts.first == texts.second && value != limit && ++digits <= all);
  return texts;
}

}  // namespace ripstop
