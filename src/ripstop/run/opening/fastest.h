// The fastest safe deployment: the largest speed at line stretch at which the weakest member keeps its margin, by every
// method of run_load(): `ripstop load --fastest`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"
#include "ripstop/run/opening/load.h"

namespace ripstop::inline run {

struct SafeSpeed {
  std::string method;
  /// Absent: the margin is kept up to fastest_deployment or, with an `unsafe_at`, at no speed.
  std::optional<double> speed;            // [m/s]
  std::optional<double> lowest, highest;  // with loads that are larger or smaller by their uncertainty [m/s]
  std::optional<double> unsafe_at;        // lowest speed of the search, where the margin is not kept [m/s]
  double load = 0;                        // at that speed [N]
  std::string member;                     // the weakest
  std::string note;                       // of the method at that speed
  bool applies = false;                   // the method, at that speed
};
template <Of<SafeSpeed> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("method", s.method);
  visit("speed_m_s", s.speed);
  visit("lowest_m_s", s.lowest);
  visit("highest_m_s", s.highest);
  visit("unsafe_at_m_s", s.unsafe_at);
  visit("load_n", s.load);
  visit("weakest_member", s.member);
  visit("applies", s.applies);
  visit("note", s.note);
}

/// Largest speed of the search [m/s]: Mach 0.8 at sea level, up to which the coefficients are valid.
inline constexpr double fastest_deployment = 270;

/// result.json of `ripstop load --fastest`.
struct FastestResult {
  std::string title;
  double payload_mass = 0, parachute_mass = 0, path_angle = 0;  // [kg], [kg], below the horizon [deg]
  double height = 0, density = 0;                               // above sea level [m], [kg/m3]
  std::string air_source;
  double margin = 0;            // of safety that every member keeps
  double load_uncertainty = 0;  // relative
  std::string load_uncertainty_from;
  std::string design_method;        // of `methods`: whose lowest speed is the answer
  std::string design_load_caution;  // of the load; empty: none
  bool cloth_checked = false;       // under its load in a computed opening; not in result.json
  std::string advice;               // which speed to use, and why the methods differ
  std::vector<SafeSpeed> methods;
  std::optional<SnatchResult> snatch;  // at the speed of the advice; absent: no speed difference is given
  std::vector<std::string> warnings;

  const SafeSpeed& design() const;
};
template <Of<FastestResult> T, class Visit>
void each_member(T& r, Visit&& visit) {
  visit("title", r.title);
  visit("payload_mass_kg", r.payload_mass);
  visit("parachute_mass_kg", r.parachute_mass);
  visit("path_angle_deg", r.path_angle);
  visit("height_m", r.height);
  visit("density_kg_m3", r.density);
  visit("air_from", r.air_source);
  visit("margin_of_safety", r.margin);
  visit("load_uncertainty", r.load_uncertainty);
  visit("load_uncertainty_from", r.load_uncertainty_from);
  visit("design_method", r.design_method);
  visit("design_load_caution", r.design_load_caution);
  visit("advice", r.advice);
  visit("methods", r.methods);
  visit("snatch", r.snatch);
  visit("warnings", r.warnings);
}
std::string to_json(const FastestResult& result);

/// The speed of `request` is not used. The load of a method is the largest of all reefed stages and of the full opening;
/// speeds are found by bisection. The uncertainty of a load is that of the drag area and the scatter of repeated
/// openings (opening_scatter), as independent parts. Lines, riser and hardware also have to carry the snatch load at that
/// speed (snatch_of()), which is taken without an uncertainty. The design method is a coupled opening that has filled,
/// else infinite mass or a larger load of the computed opening. `known` replaces load_uncertainty() of the drag
/// coefficient, and the canopy carries at least `least_load` [N], a function of the speed [m/s]. Throws Error(usage) as
/// run_load(), for a margin below 0, and for a parachute in which no strength of lines, tape, riser and hardware is
/// known.
FastestResult run_fastest(const Settings& resolved, const LoadRequest& request, double margin = 0,
                          std::optional<LoadUncertainty> known = {},
                          const std::function<double(double)>& least_load = {});

/// result.json.
void write_fastest(const std::filesystem::path& folder, const FastestResult& result);

}  // namespace ripstop::inline run
