#include "ripstop/case/deployment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "ripstop/case/payload.h"
#include "ripstop/core/checked_int.h"
#include "ripstop/core/error.h"
#include "ripstop/core/units.h"
#include "ripstop/parachute/cross.h"
#include "ripstop/parachute/fold.h"

namespace ripstop::inline cases {
namespace {

// Usual values of an empty [deployment] (assumed).
constexpr double bag_share = 0.1, wrap_share = 0.03, pilot_share = 0.05;  // of the parachute's mass
constexpr double pilot_area = 0.015;                                      // of S0
constexpr double longest_packed_share = 0.9;                              // of the canopy's length
constexpr double above_smallest_radius = 1.12;                            // of the folded skirt

double canopy_length(const Design& design) {
  return 0.5 * nominal_diameter(design);
}

double rigging_length(const Design& design) {
  return design.lines.length_m + design.riser.length_m;
}

void take_container(const Settings& resolved, const PartMasses& masses, PackedParachute& p) {
  const DeploymentKeys& keys = *resolved.deployment();
  const bool bag = keys.container == DeploymentKeys::Container::bag;
  const double weight = p.canopy_mass * standard_gravity;
  p.bag_mass = keys.mass_kg.value_or((bag ? bag_share : wrap_share) * masses.total);
  p.bag_drag_area = keys.drag_area_m2.value_or(std::pow(parachute_bill(resolved).packed_volume, 2.0 / 3));
  p.strip_force = keys.strip_force_n.value_or(bag ? weight : 0.5 * weight);
  p.line_force = keys.line_force_n.value_or(p.lines_mass * standard_gravity);
}

void take_extraction(const Settings& resolved, const PartMasses& masses, PackedParachute& p) {
  const DeploymentKeys& keys = *resolved.deployment();
  const bool thrown = keys.relative_speed_m_s || keys.ejection_impulse_n_s;
  const double area =
      keys.pilot_drag_area_m2.value_or(thrown ? 0 : pilot_area * nominal_area(resolved.parachute()));
  p.bag_drag_area += area;
  p.bag_mass += keys.pilot_mass_kg.value_or(area > 0 ? pilot_share * masses.total : 0);
  const double packed = p.bag_mass + p.canopy_mass + p.lines_mass;
  p.relative_speed = keys.relative_speed_m_s.value_or(keys.ejection_impulse_n_s.value_or(0) *
                                                      (1 / packed + 1 / p.payload_mass));
  if (!p.lines_first && !(p.bag_mass > 0))
    throw Error(ExitCode::usage,
                "deployment.order = \"canopy-first\" needs a pilot chute that pulls the canopy out: give "
                "deployment.pilot_mass_kg and deployment.pilot_drag_area_m2");
}

/// A container as long as the stretched canopy, or as the lines that are stowed on it, is none.
void check_length(const DeploymentKeys& keys, const Design& design) {
  if (!keys.length_m) return;
  const double canopy = longest_packed_share * canopy_length(design), lines = rigging_length(design);
  const auto refuse = [&](const char* what, double limit) {
    throw Error(ExitCode::usage,
                fmt::format("deployment.length_m = {:g}: must be at most {:.4g} m, {}; or leave it out",
                            *keys.length_m, limit, what));
  };
  if (*keys.length_m > lines)
    refuse("the length of lines and riser (parachute.lines.length_m), which lie on it", lines);
  if (*keys.length_m > canopy) refuse("nine tenths of the canopy's length from skirt to vent", canopy);
}

// The smallest mean radius of the folded skirt [m], with C its circumference and N the number of folds. A strip of
// width C / (2 N) reaches from the inner to the outer folds. The inner ones of gores are at least at the radius
// s C / (2 pi) with s = least_inner_share, those of disks and cylinders on the axis: C (1 / (4 N) + s / (2 pi)).
// A cross folds along the middle of its arms, of width W. Of m lines from corner to corner of an arm, the outermost are
// at W / 2 from the fold, and the innermost on it (m odd) or at W / (2 (m - 1)).
double inner_radius(const Design& design) {
  const bool gores = design.canopy.family().type != std::string_view("disk-gap-band");
  return gores ? least_inner_share * skirt_circumference(design) / (2 * std::numbers::pi) : 0;
}

double smallest_radius(const Design& design, int folds) {
  if (const Cross* cross = design.canopy.as<Cross>()) {
    const int per_arm = design.lines.count / 4;
    const double innermost = per_arm % 2 == 1 ? 0 : cross->arm_width_m / (2 * std::max(1, per_arm - 1));
    return 0.5 * (0.5 * cross->arm_width_m + innermost);
  }
  return inner_radius(design) + skirt_circumference(design) / (4.0 * folds);
}

}  // namespace

void close_mouth(const Design& design, InflationSettings& inflation) {
  const double wanted = experience(design).closed_mouth * nominal_diameter(design),
               round = skirt_circumference(design);
  const int lines = design.lines.count;
  if (inflation.folds == 0 && !inflation.initial_radius_m && !design.canopy.as<Cross>()) {
    // Half the width of a strip.
    const double half = std::max(wanted / above_smallest_radius - inner_radius(design), 0.1 * wanted);
    inflation.folds = lines * std::max(1, checked_int(std::ceil(round / (4 * half * lines)), 1, 1000,
                                                      [] { return std::string("folds of a closed mouth"); }));
  }
  if (!inflation.initial_radius_m)
    inflation.initial_radius_m =
        std::max(wanted, above_smallest_radius *
                             smallest_radius(design, inflation.folds > 0 ? inflation.folds : lines));
}

std::vector<SnatchPart> stretching_parts(const Settings& resolved) {
  const Design& design = resolved.parachute();
  const PartMaterials& materials = resolved.materials();
  std::vector<SnatchPart> parts = {
      {"the lines", materials.line.coefficients_n, design.lines.count, design.lines.length_m}};
  if (design.riser.length_m > 0)
    parts.push_back({"the riser", materials.riser.coefficients_n, 1, design.riser.length_m});
  for (const auto& [name, part] : resolved.hardware())
    if (part.stiffness_n)
      parts.push_back({name, {*part.stiffness_n}, part.strands, part.length_m.value_or(0)});
  return parts;
}

PackedParachute packed_parachute(const Settings& resolved) {
  const Design& design = resolved.parachute();
  const DeploymentKeys& keys = *resolved.deployment();
  const PartMasses masses = parachute_masses(resolved);
  PackedParachute p;
  p.speed = resolved.flow().speed_m_s, p.density = resolved.flow().density_kg_m3;
  p.payload_mass = std::numeric_limits<double>::infinity();
  if (resolved.inflation().mass == InflationSettings::Mass::payload) {
    if (!resolved.payload().mass_kg)
      throw Error(ExitCode::usage, "inflation.mass = \"payload\" needs payload.mass_kg");
    p.payload_mass = *resolved.payload().mass_kg;
    p.payload_drag_area = resolved.payload().drag_area_m2;
    p.gravity = standard_gravity * std::sin(resolved.inflation().flight_angle_deg * std::numbers::pi / 180);
  }
  p.canopy_mass = masses.cloth + masses.tape, p.canopy_length = canopy_length(design);
  p.lines_mass = masses.lines + masses.riser;
  p.lines = stretching_parts(resolved);
  p.lines_first = keys.order == DeploymentKeys::Order::lines_first;
  take_container(resolved, masses, p);
  take_extraction(resolved, masses, p);
  check_length(keys, design);
  return p;
}

std::optional<Deployment> deployment_of(const Settings& resolved) {
  if (!resolved.deployment() || resolved.inflation().air != AirModel::coupled) return {};
  return deploy_parachute(packed_parachute(resolved));
}

}  // namespace ripstop::inline cases
