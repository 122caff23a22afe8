#include "ripstop/case/payload.h"

#include "ripstop/case/assemble.h"
#include "ripstop/core/error.h"
#include "ripstop/flight/atmosphere.h"
#include "ripstop/flight/descent.h"

namespace ripstop {

double parachute_mass(const Case& given) {
  const CanopyMesh mesh = build_mesh(given.parachute, part_materials(given));
  double sum = 0;
  for (const double mass : mesh.mass) sum += mass;
  return sum;
}

double suspended_weight(const Case& given, double payload) {
  return (payload + parachute_mass(given)) * standard_gravity;
}

double payload_first_speed(const Case& given, double density) {
  if (!given.payload.mass_kg)
    throw Error(ExitCode::usage, "the case has neither flow.speed_m_s nor payload.mass_kg");
  constexpr double unknown = 0.75;  // C_D of families that the tables do not have (assumed)
  const KnownRange known = experience(given.parachute).drag_coefficient;
  const double coefficient = known.high > 0 ? 0.5 * (known.low + known.high) : unknown;
  return terminal_speed(*given.payload.mass_kg, coefficient * nominal_area(given.parachute), density);
}

}  // namespace ripstop
