// The nonlinear model compared with the linear one, which uses only K_1 of every law, and the causes of their
// difference.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ripstop/canopy/shape.h"
#include "ripstop/core/members.h"
#include "ripstop/run/sweep/sweep.h"

namespace ripstop::inline run {

/// The case as it is; with K_1 alone for every material; and for the cloth, the lines and the tape, if there is one,
/// in turn.
/// Throws Error(usage) for a case that is linear itself.
SweepAxis linear_models(const Settings& resolved);

template <Of<Strains> T, class Visit>
void each_member(T& strains, Visit&& visit) {
  visit("mean", strains.mean);
  visit("largest", strains.largest);
}

struct ComparedModel {
  std::string model;
  double drag = 0, drag_area = 0;                                 // [N], [m2]
  double drag_difference = 0;                                     // to the first model's, relative
  double projected_diameter = 0, skirt_diameter = 0, length = 0;  // [m]
  double profile_change = 0;  // greatest of the half diameter of any row of nodes, to the first model's [m]
  int iterations = 0;
  double wall_time = 0;                   // [s]
  std::map<std::string, Strains> strain;  // of each part
  std::vector<ProfileRing> profile;       // not in result.json
};
template <Of<ComparedModel> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("model", m.model);
  visit("drag_n", m.drag);
  visit("drag_area_m2", m.drag_area);
  visit("drag_difference", m.drag_difference);
  visit("projected_diameter_m", m.projected_diameter);
  visit("skirt_diameter_m", m.skirt_diameter);
  visit("canopy_length_m", m.length);
  visit("largest_profile_change_m", m.profile_change);
  visit("coupling_iterations", m.iterations);
  visit("wall_time_s", m.wall_time);
  visit("strain", m.strain);
}

/// result.json of `ripstop compare`.
struct Comparison {
  std::string title;
  double speed = 0;  // [m/s]
  double drag_tolerance = 0;
  std::vector<ComparedModel> models;  // in the order of linear_models()
  // Where the linear model's difference of drag comes from.
  double beyond_sum = 0;                               // of each material's alone [N]
  double by_projected_area = 0, by_drag_per_area = 0;  // ln of the drags' ratio, in two parts
  std::optional<double> measured_drag, printed_nonlinear, printed_linear;  // [N]
  std::vector<std::string> warnings;                                       // of the runs
};
template <Of<Comparison> T, class Visit>
void each_member(T& c, Visit&& visit) {
  visit("title", c.title);
  visit("speed_m_s", c.speed);
  visit("drag_tolerance", c.drag_tolerance);
  visit("models", c.models);
  visit("beyond_sum_n", c.beyond_sum);
  visit("by_projected_area", c.by_projected_area);
  visit("by_drag_per_projected_area", c.by_drag_per_area);
  visit("measured_drag_n", c.measured_drag);
  visit("printed_nonlinear_n", c.printed_nonlinear);
  visit("printed_linear_n", c.printed_linear);
  visit("warnings", c.warnings);
}
std::string to_json(const Comparison& comparison);

/// Of a sweep over linear_models() in which every run has a result; `end_of` gives a point's last state.
Comparison compare_models(const std::vector<SweepPoint>& points, const std::vector<SweepRow>& rows,
                          const std::function<SteadyState(std::size_t point)>& end_of);

/// profile.csv, profile.svg, profile.png and result.json: the first two models.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace ripstop::inline run
