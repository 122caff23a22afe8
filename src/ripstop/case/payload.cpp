#include "ripstop/case/payload.h"

#include <algorithm>

#include "ripstop/case/cluster.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"

namespace ripstop::inline cases {

CutPattern cut_pattern(const Settings& resolved) {
  CutPattern pattern = cut_pattern(resolved.parachute());
  if (!resolved.materials().tape) pattern.tapes.clear();
  return pattern;
}

Bill parachute_bill(const Settings& resolved, const Allowances& allowances, double packing_density) {
  return bill_of(cut_pattern(resolved), resolved.parachute(), resolved.materials(), allowances,
                 packing_density);
}

double parachute_mass(const Design& design, const PartMaterials& materials) {
  return bill_of(cut_pattern(design), design, materials, {}, packed_by_hand).mass;
}

PartMasses parachute_masses(const Settings& resolved) {
  PartMasses masses;
  for (const BillRow& row : parachute_bill(resolved).rows) {
    double& part = row.kind == BillPart::cloth  ? masses.cloth
                   : row.kind == BillPart::tape ? masses.tape
                   : row.kind == BillPart::line ? masses.lines
                                                : masses.riser;
    part += row.mass, masses.total += row.mass;
  }
  return masses;
}

double parachute_mass(const Settings& resolved) {
  return parachute_masses(resolved).total;
}

double mass_of_canopies(const Settings& resolved) {
  if (equal_canopies(resolved.written())) return canopy_count(resolved.written()) * parachute_mass(resolved);
  double mass = 0;
  for (int k = 0; k < canopy_count(resolved.written()); ++k)
    mass += parachute_mass(canopy_settings(resolved, k));
  return mass;
}

double suspended_weight(const Settings& resolved, double payload) {
  return (payload + mass_of_canopies(resolved)) * standard_gravity;
}

double payload_first_speed(const Case& given, double density) {
  if (!given.payload.mass_kg)
    throw Error(ExitCode::usage,
                "the case has neither flow.speed_m_s nor payload.mass_kg; write one of them");
  const double canopies =
      area_ratio(given) * usual_drag_coefficient(given.parachute) * nominal_area(given.parachute);
  return terminal_speed(*given.payload.mass_kg, canopies + given.payload.drag_area_m2, density);
}

double usual_drag_coefficient(const Design& parachute) {
  constexpr double unknown = 0.75;  // of families that the tables do not have (assumed)
  const KnownRange known = experience(parachute).drag_coefficient;
  return known.high > 0 ? 0.5 * (known.low + known.high) : unknown;
}

double usual_deployment_speed(double descent_rate) {
  return std::max(least_deployment_speed, deployment_over_descent * descent_rate);
}

std::optional<DeploymentSpeed> deployment_speed(const PayloadKeys& payload, std::optional<double> asked) {
  if (asked) return DeploymentSpeed{*asked, "given"};
  if (!payload.deployment_speed_m_s) return {};
  return DeploymentSpeed{*payload.deployment_speed_m_s, "payload.deployment_speed_m_s of the case"};
}

}  // namespace ripstop::inline cases
