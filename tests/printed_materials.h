// The materials of [NFM] Table 3, for tests that build a mesh without the material library.
#pragma once

#include "ripstop/parachute/build.h"

namespace ripstop {

inline PartMaterials printed_materials() {
  PartMaterials m;
  m.canopy.name = "f-111";
  m.canopy.coefficients_n_m = {30006, -18936};
  m.canopy.tested_strain = 0.33;
  m.canopy.areal_density_kg_m2 = 0.0407;
  m.line.coefficients_n = {211895, 489633};
  m.line.linear_density_kg_m = 2e-3;
  m.riser = m.line;
  m.tape.coefficients_n_m = {3064.2, 68823.4};
  m.tape.width_m = 0.02;
  m.tape.linear_density_kg_m = 6e-3;
  return m;
}

}  // namespace ripstop
