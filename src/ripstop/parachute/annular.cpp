#include "ripstop/parachute/annular.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {
namespace {

/// Half an ellipse (a cos t, b sin t), t from 0 to pi, and its length from t = 0.
class HalfEllipse {
 public:
  HalfEllipse(double a, double b) : a_(a) {
    // Midpoint rule; the integrand has the period pi, so that the whole length converges faster than any power.
    const double step = std::numbers::pi / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double t = (i + 0.5) * step;
      lengths_.push_back(lengths_.back() + step * std::hypot(a * std::sin(t), b * std::cos(t)));
    }
  }
  double length() const { return lengths_.back(); }
  /// a cos t at the distance `s` along the arc.
  double across(double s) const {
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, s);
    const double share = (s - *(next - 1)) / (*next - *(next - 1));
    const double t = std::numbers::pi / pieces * (double(next - lengths_.begin()) - 1 + share);
    return a_ * std::cos(t);
  }

 private:
  static constexpr int pieces = 4000;
  double a_;
  std::vector<double> lengths_{0};
};

}  // namespace

void describe(Fields& fields, Annular& canopy) {
  fields
      .number("outer_diameter_m", canopy.outer_diameter_m, from(0.01).up_to(100),
              "Constructed diameter of the outer edge (the skirt).")
      .required();
  fields
      .number("vent_diameter_m", canopy.vent_diameter_m, above(0).up_to(100),
              "Constructed diameter of the inner edge (the vent).")
      .required();
  fields.number(
      "crown_ratio", canopy.crown_ratio, from(0.1).up_to(2),
      "Height of the crown above both edges over half the width of the ring, as cut: 1 for a meridian "
      "that is half a circle, less for a flatter one (assumed).");
  fields.number(
      "apex_line_ratio", canopy.apex_line_ratio, from(0.3).up_to(1.5),
      "Length of the apex lines, from the confluence to the edge of the vent, over the length of the "
      "suspension lines. There is one for every suspension line, of the same material (assumed).");
}

void check_shape(const Annular& canopy, const Design& design, Findings& findings) {
  check_vent(canopy.vent_diameter_m, canopy.outer_diameter_m, false, design, findings);
  if (!findings.sound(shape_keys(design)) || !findings.sound({"parachute.lines.length_m"})) return;
  const double least = 0.5 * canopy.vent_diameter_m / design.lines.length_m;
  if (canopy.apex_line_ratio <= least)
    findings.add("parachute.apex_line_ratio", canopy.apex_line_ratio, fmt::format("above {:.3g}", least),
                 fmt::format("the apex lines are too short to meet on the axis; they must be longer than the "
                             "radius of the vent, {:.6g} m",
                             0.5 * canopy.vent_diameter_m));
}

GorePattern gore_pattern(const Annular& canopy, int gores) {
  const double mean_radius = 0.25 * (canopy.outer_diameter_m + canopy.vent_diameter_m);
  const double half_width = 0.25 * (canopy.outer_diameter_m - canopy.vent_diameter_m);
  const HalfEllipse meridian(half_width, canopy.crown_ratio * half_width);
  GorePattern pattern;
  pattern.gores = gores;
  pattern.nominal_area = 2 * std::numbers::pi * mean_radius * meridian.length();
  pattern.apex_line_ratio = canopy.apex_line_ratio;
  pattern.strips = {strip_on(
      "gore", [&](double s) { return mean_radius + meridian.across(s); }, 0, meridian.length(), gores)};
  pattern.strips[0].crown = static_cast<int>(pattern.strips[0].stations.size()) / 2;
  return pattern;
}

Experience experience(const Annular&) {
  return {.projected_ratio = {},
          .drag_coefficient = {0.85, 0.95},
          .opening_coefficient = 1.4,
          .opening_source = knacke_transcribed,
          .cloth_nodes = 1500,
          .closed_mouth = 0.1};
}

constinit const CanopyFamily Annular::family = family_of<Annular>("annular", "annular");

}  // namespace ripstop::inline parachute
