#include "ripstop/case/payload.h"

#include "ripstop/case/assemble.h"
#include "ripstop/flight/atmosphere.h"

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

}  // namespace ripstop
