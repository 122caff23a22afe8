// Payload of a parachute, and the mass of the parachute.
#pragma once

#include <optional>
#include <string>

#include "ripstop/case/settings.h"
#include "ripstop/parachute/cut.h"

namespace ripstop::inline cases {

/// Masses of a parachute's parts [kg].
struct PartMasses {
  double cloth = 0, tape = 0, lines = 0, riser = 0, total = 0;  // vent lines are lines too
};

/// Pieces, tapes and lines of the parachute.
CutPattern cut_pattern(const Settings& resolved);
/// Masses as cut: the one mass of a parachute. Hems, seam allowances, overlaps and line loops are part of the
/// flying mass.
Bill parachute_bill(const Settings& resolved, const Allowances& allowances = {},
                    double packing_density = packed_by_hand);
PartMasses parachute_masses(const Settings& resolved);
/// The total of parachute_masses() of a design of these materials [kg].
double parachute_mass(const Design& design, const PartMaterials& materials);
/// The total of parachute_masses() [kg].
double parachute_mass(const Settings& resolved);
/// parachute_mass() of every canopy of the case [kg].
double mass_of_canopies(const Settings& resolved);
/// Speed at which the usual drag of the canopies' family carries payload.mass_kg: start value of the iteration
/// for the speed [m/s].
double payload_first_speed(const Case& given, double density);
/// The middle of the family's range on the nominal area.
double usual_drag_coefficient(const Design& parachute);
/// Deployment speed: so many times the descent rate, but at least so many m/s (assumed).
constexpr double deployment_over_descent = 3, least_deployment_speed = 20;
double usual_deployment_speed(double descent_rate);
struct DeploymentSpeed {
  double speed = 0;  // [m/s]
  std::string from;  // "payload.deployment_speed_m_s of the case"
};
/// Airspeed at line stretch, for all commands: `asked`, else payload.deployment_speed_m_s; nothing without both.
std::optional<DeploymentSpeed> deployment_speed(const PayloadKeys& payload, std::optional<double> asked = {});
/// Of `payload` [kg] and its canopies, whose drag carries both [N].
double suspended_weight(const Settings& resolved, double payload);

}  // namespace ripstop::inline cases
