// The snatch load of `ripstop load`, and its change with length and stiffness of every part that stretches.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/case/settings.h"
#include "ripstop/core/members.h"

namespace ripstop::inline run {

struct LoadRequest;
struct LoadResult;

/// Snatch load with one part changed [N]; absent: lines or riser would break.
struct SnatchChange {
  std::string part;
  std::optional<double> half_length, double_length, half_stiffness, double_stiffness;
};
template <Of<SnatchChange> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("part", c.part);
  visit("half_length_n", c.half_length);
  visit("double_length_n", c.double_length);
  visit("half_stiffness_n", c.half_stiffness);
  visit("double_stiffness_n", c.double_stiffness);
}

struct SnatchResult {
  double speed_difference = 0, load = 0;  // [m/s], [N]
  std::optional<double> time, stretch;    // [s], [m]; absent: from the deployment in one dimension
  double line_load = 0;                   // of one line [N]
  std::optional<double> line_margin;      // its strength over that
  std::optional<double>
      riser_margin;  // strength of the riser over the snatch load; absent: there is no riser
  std::string from;
  std::string model;  // in words
  /// By [deployment] of the case, where the request gives another speed difference.
  std::optional<double> other_load, other_speed_difference;
  std::vector<SnatchChange> changes;

  double largest() const { return std::max(load, other_load.value_or(0)); }
};
template <Of<SnatchResult> T, class Visit>
void each_member(T& s, Visit&& visit) {
  visit("speed_difference_m_s", s.speed_difference);
  visit("load_n", s.load);
  visit("time_s", s.time);
  visit("stretch_m", s.stretch);
  visit("line_load_n", s.line_load);
  visit("line_margin", s.line_margin);
  visit("riser_margin", s.riser_margin);
  visit("speed_difference_from", s.from);
  visit("model", s.model);
  visit("deployment_load_n", s.other_load);
  visit("deployment_speed_difference_m_s", s.other_speed_difference);
  visit("changes", s.changes);
}

/// Models of a snatch load, in words.
inline constexpr const char
    *energy_model = "energy of two masses; the whole canopy reaches the speed of the payload at line stretch",
    *deployment_model = "deployment in one dimension; the canopy leaves its container after line stretch";

/// In words: both loads and their models. Only of a result with the other load.
std::string two_snatch_loads(const SnatchResult& snatch);

/// At the speed difference of the request, at that which the drag area of the packed canopy causes, or by the
/// [deployment] of the case at the speed of the request; nothing where none of them is given. Throws Error(usage) as
/// snatch_load() and deploy_parachute().
std::optional<SnatchResult> snatch_of(const Settings& resolved, const LoadRequest& request,
                                      const LoadResult& result);

/// Largest tension when two sections of a rocket part at `speed` [m/s] and the shock cord stops them: the parts of
/// [hardware] that stretch, in series [N]. `sections`: masses in their order along the rocket [kg]; they part where the
/// energy is largest. Nothing where no part stretches. Throws Error(usage) as snatch_load().
std::optional<double> separation_load(const Settings& resolved, const std::vector<double>& sections,
                                      double speed);

}  // namespace ripstop::inline run
